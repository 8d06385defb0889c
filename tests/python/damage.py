"""Damages pickles and states at random, and uses what they still make: python damage.py bytes|states SEED ROUNDS.

Prints how many objects were made. A signal is a finding; the last line of the error output names its round.
"""

import faulthandler
import io
import os
import pickle
import pickletools
import random
import resource
import sys

import chainmail
import numpy as np

MEMORY = 4 << 30  # so that a damaged size raises MemoryError


def samples():
    """Returns small objects of all kinds that are pickled."""
    found = [
        chainmail.make_line(4),
        chainmail.make_cloth(4, 3, space_dimension=3),
        chainmail.make_tetra(3, 2, 2),
        chainmail.make_mesh(
            np.random.default_rng(1).normal(size=(8, 3)), hexahedra=[range(8)], triangles=[[0, 1, 2]], links=[[0, 6]]
        ),
    ]
    turn = chainmail.Rotation((0, 0, 1), 5)
    result = chainmail.Deformer(found[0]).move(0, (-3,))
    return found + [result, turn, chainmail.LinkSoftness(), chainmail.Elasticity(), chainmail.Drag("d", [0], [(1, 1, 1)])]


class Loader(pickle.Unpickler):
    """Makes nothing but the objects of these pickles."""

    def find_class(self, module, name):
        known = module == "chainmail._core" or (module, name) in {
            ("copyreg", "__newobj__"), ("copy_reg", "__newobj__"), ("_codecs", "encode"), ("__builtin__", "bytes"),
        }  # fmt: skip
        if not known:
            raise pickle.UnpicklingError(name)
        return super().find_class(module, name)


def damaged_bytes(chance, data):
    data = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 5))):
        at = chance.randrange(len(data))
        kind = chance.randrange(6)
        if kind < 2:
            data[at] ^= 1 << chance.randrange(8)
        elif kind == 2:
            data[at] = chance.choice((0, 1, 127, 128, 255))
        elif kind == 3:
            del data[at : at + chance.randrange(1, 9)]
        elif kind == 4:
            end = at + chance.randrange(1, 40)
            data[at:at] = data[at:end]
        else:
            other = chance.randrange(len(data))
            data[at : at + 8] = data[other : other + 8]
        if not data:
            return b"N."
    return bytes(data)


def is_affordable(data):
    """False if Python's own reader would take gigabytes for a place in its memo, before it sees that there is no such
    object. A sanitizer has no limit of memory."""
    try:
        return all(one.name not in ("PUT", "LONG_BINPUT") or int(at) < 1 << 20 for one, at, _ in pickletools.genops(data))
    except Exception:
        return True  # what came before is affordable


NUMBERS = (0, 1, -1, 2, 3, 7, 2**31 - 1, 2**31, 2**32 - 2, 2**32 - 1, 2**32, 2**63, np.nan, np.inf, 1e-320, 1e300, 0.5)


def damaged(chance, value):
    """Returns another value in place of a part of a state."""
    kind = chance.randrange(8)
    if isinstance(value, np.ndarray) and kind < 7:
        array = value.copy()
        if kind == 0 and array.size:
            array.flat[chance.randrange(array.size)] = chance.choice([n for n in NUMBERS if fits(n, array.dtype)])
        elif kind == 1 and array.size:
            array.flat[chance.randrange(array.size)] += array.dtype.type(1)
        elif kind == 2:
            array = array.ravel()[: chance.randrange(array.size + 1)]
        elif kind == 3:
            array = np.concatenate([array.ravel(), array.ravel()[: chance.randrange(9)]])
        elif kind == 4:
            array = chance.choice((array.astype(float), array.astype(np.int8), array[::-1], array[::2], array.T))
        elif kind == 5 and array.size:
            one, other = chance.randrange(array.size), chance.randrange(array.size)
            array.flat[one], array.flat[other] = array.flat[other], array.flat[one]
        return array if kind == 6 or chance.randrange(4) == 0 else packed(array)
    if isinstance(value, (tuple, list)) and value and kind < 6:
        parts = list(value)
        parts[chance.randrange(len(parts))] = damaged(chance, chance.choice(parts))
        return type(value)(parts)
    if isinstance(value, bool) and kind < 4:
        return not value
    return chance.choice((*NUMBERS, None, True, "", "float", "exact", "link", (), [], {}, [0], np.zeros((2, 2)), b"x"))


def fits(number, dtype):
    return dtype.kind == "f" or (number == number and abs(number) < 2**31 and number == int(number) >= 0)


def packed(array):
    """Returns the bytes in which a state has an array."""
    return (b"d" if array.dtype.kind == "f" else b"I") + array.tobytes()


def numbers_of(value):
    """Returns the numbers in the bytes of a state."""
    return np.frombuffer(value[1:], float if value[:1] == b"d" else np.uint32) if isinstance(value, bytes) else value


def damaged_state(chance, one):
    state = one.__getstate__()
    if isinstance(state, tuple):
        return damaged(chance, state)
    for _ in range(chance.choice((1, 1, 2, 4))):
        name = chance.choice(list(state))
        if chance.randrange(20) == 0:
            del state[name]
        else:
            state[name] = damaged(chance, numbers_of(state[name]))
        if not state:
            break
    return state


def attempt(work):
    try:
        return work()
    except (Exception, RecursionError):
        return None


def use(one):
    """Calls everything that may reach what a state has damaged."""
    if isinstance(one, chainmail.Mesh):
        attempt(one.rest_lengths)
        for name in ("left", "boundary"):
            attempt(lambda: one.side(name))
        for method in ("natural-queue", "exact", "3d", "arap", "bem", "neo-hookean"):
            deformer = attempt(lambda: chainmail.Deformer(one, method))
            for work in (
                lambda: deformer.move(0, (0.1, 0.1)), lambda: deformer.relax(2), deformer and deformer.body.positions,
                lambda: chainmail.violation(deformer.body), lambda: chainmail.elastic_energy(deformer.body),
            ):  # fmt: skip
                attempt(work)
    if isinstance(one, chainmail.Drag):
        attempt(lambda: chainmail.compare(chainmail.Body(chainmail.make_line(4)), [one], repetitions=1))
    attempt(lambda: repr(one))
    attempt(lambda: pickle.dumps(one))


def main(kind, seed, rounds):
    faulthandler.enable()
    if "asan" not in os.environ.get("LD_PRELOAD", ""):  # it takes terabytes of addresses
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    chance = random.Random(seed)
    found = samples()
    data = [pickle.dumps(one, protocol) for one in found for protocol in (0, 2, 5)]
    made = 0
    for number in range(rounds):
        print(f"\rround {number}", end="", file=sys.stderr, flush=True)
        if kind == "bytes":
            one = damaged_bytes(chance, chance.choice(data))
            one = attempt(lambda: Loader(io.BytesIO(one)).load()) if is_affordable(one) else None
        else:
            source = chance.choice(found)
            one = type(source).__new__(type(source))
            one = one if attempt(lambda: one.__setstate__(damaged_state(chance, source)) or True) else None
        if one is not None:
            made += 1
            use(one)
    print(f"{made} objects in {rounds} rounds")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
