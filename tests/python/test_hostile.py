"""Damaged pickles, arrays and objects: an exception, never a signal."""

import contextlib
import itertools
import resource
import signal
import subprocess
import sys
from pathlib import Path

import chainmail
import numpy as np
import pytest

SEED = 20260101
ROUNDS = 1500


@pytest.mark.parametrize("kind", ["bytes", "states"])
def test_damaged_pickles(kind):
    """Every object that a damaged pickle still makes can be used. `python damage.py bytes SEED ROUNDS` does more."""
    program = Path(__file__).with_name("damage.py")
    print(f"seed {SEED}, {ROUNDS} rounds")
    done = subprocess.run(
        [sys.executable, program, kind, str(SEED), str(ROUNDS)], capture_output=True, text=True, timeout=240
    )
    assert done.returncode == 0, f"seed {SEED}, " + done.stderr.split("\r")[-1]
    assert int(done.stdout.split()[0]) > 50  # so many objects were made, and used


def state_of(one, **changes):
    return {**one.__getstate__(), **changes}


def packed(part):
    """Returns the bytes in which a state has an array."""
    if not isinstance(part, (np.ndarray, list, tuple)):
        return part
    array = np.asarray(part)
    return b"d" + array.astype(float).tobytes() if array.dtype.kind == "f" else b"I" + array.astype(np.uint32).tobytes()


def made(one, state):
    state = {name: packed(part) for name, part in state.items()} if isinstance(state, dict) else state
    return type(one).__new__(type(one)).__setstate__(state)


MESH = chainmail.make_tetra(3, 3, 3)
ROWS = np.frombuffer(MESH.__getstate__()["first_entry"][1:], np.uint32)
NEIGHBOURS = np.frombuffer(MESH.__getstate__()["neighbours"][1:], np.uint32)
BAD_MESHES = {
    "no element": dict(rest=np.zeros((0, 1))),
    "half an element": dict(rest=np.zeros((80, 1))),
    "a coordinate that is no number": dict(rest=np.full((81, 1), np.nan)),
    "one coordinate that is no number": dict(rest=np.where(np.arange(81) == 7, np.nan, MESH.rest_positions().ravel())),
    "a coordinate beyond all": dict(rest=np.full((81, 1), 1e200)),
    "rows that descend": dict(first_entry=ROWS[::-1]),
    "rows that wrap around": dict(first_entry=[0, 4, 2**32 - 2, 3], neighbours=[0, 1, 2]),
    "no rows": dict(first_entry=[]),
    "a neighbour out of range": dict(neighbours=np.full(NEIGHBOURS.shape, 10**6)),
    "a neighbour that is the element": dict(neighbours=np.zeros(NEIGHBOURS.shape, int)),
    "a negative neighbour": dict(neighbours=np.full(NEIGHBOURS.shape, -1)),
    "a corner out of range": dict(tetrahedra=[0, 1, 2, 27]),
    "half a cell": dict(tetrahedra=[0, 1, 2]),
    "a polygon that does not end": dict(polygons=[4, 0, 1, 2]),
    "a polygon of nothing": dict(polygons=[0]),
    "a corner of a polygon out of range": dict(polygons=[3, 0, 1, 99]),
    "an empty lattice": dict(lattice=[0, 0, 0]),
    "a lattice of another size": dict(lattice=[2, 3, 3]),
    "a lattice elsewhere": dict(lattice=[3, 3, 3], spacing=2.0),
    "a lattice without a spacing": dict(lattice=[3, 3, 3], spacing=np.nan),
    "a lattice that is none": dict(lattice=7),
    "a lattice of two axes": dict(lattice=[3, 3]),
    "no space": dict(space_dimension=0),
    "space below none": dict(space_dimension=-3),
    "too much space": dict(space_dimension=2**40),
    "a plane": dict(space_dimension=2),
    "softness of no link": dict(own_links=[10**6], own_softness=[0.8, 1.2, 0.1, 1, 1, -1]),
    "a link twice": dict(own_links=[3, 3], own_softness=2 * [0.8, 1.2, 0.1, 1, 1, -1]),
    "softness out of range": dict(own_links=[0], own_softness=[0.8, -1, 0.1, 1, 1, -1]),
    "arrays of text": dict(rest="abc"),
    "half a number": dict(rest=b"d" + bytes(81 * 8 - 1)),
    "bytes of no kind": dict(rest=bytes(81 * 8)),
    "text that is no UTF-8": dict(remark="\udc80"),
    "ids that are text": dict(neighbours="abc"),
    "arrays of floats": dict(triangles=[0.5, 1, 2]),
    "a remark that is none": dict(remark=5),
}


@pytest.mark.parametrize("bad", BAD_MESHES)
def test_a_damaged_mesh_is_refused(bad):
    with pytest.raises(chainmail.Error) as raised:
        made(MESH, state_of(MESH, **BAD_MESHES[bad]))
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("name", [5, "\udc80", b"rest", None])
def test_a_part_without_a_name_is_refused(name):
    with pytest.raises(chainmail.Error, match="state of a mesh: one of its parts is damaged"):
        made(MESH, {**MESH.__getstate__(), name: 3})


def test_an_untouched_state_is_taken():
    again = chainmail.Mesh.__new__(chainmail.Mesh)
    again.__setstate__(MESH.__getstate__())
    assert np.array_equal(again.links, MESH.links)


def test_objects_that_no_constructor_has_seen():
    """pybind11 lets them exist, and gave their methods memory that nobody had written."""
    program = (
        "import chainmail\n"
        "kinds = [one for one in vars(chainmail).values() if type(one).__name__ == 'pybind11_type']\n"
        "assert len(kinds) > 10\n"
        "for kind in kinds:\n"
        "    one = kind.__new__(kind)\n"
        "    for name in dir(kind):\n"
        "        if name in ('__class__', '__new__', '__init__', '__dict__', '__subclasshook__', '__init_subclass__'):\n"
        "            continue\n"
        "        for arguments in ((), (0,), (one,), (chainmail.make_line(3),)):\n"
        "            try:\n"
        "                found = getattr(one, name)\n"
        "                found(*arguments)\n"
        "            except Exception:\n"
        "                pass\n"
        "print('alive')\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (done.stdout, done.returncode) == ("alive\n", 0), done.stderr
    for kind in (chainmail.Mesh, chainmail.Body, chainmail.Deformer, chainmail.LinkSoftness):
        with pytest.raises(TypeError, match="is not initialised"):
            repr(kind.__new__(kind))


def test_none_is_no_object():
    program = (
        "import chainmail\n"
        "for wrong in (lambda: chainmail.Deformer(None), lambda: chainmail.Body(None), lambda: chainmail.Handle(None, 0),\n"
        "              lambda: chainmail.Deformer(chainmail.Body(chainmail.make_line(3)), None),\n"
        "              lambda: chainmail.compare(None), lambda: chainmail.violation(None)):\n"
        "    try:\n"
        "        wrong()\n"
        "    except TypeError:\n"
        "        print('TypeError')\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (done.stdout, done.returncode) == ("TypeError\n" * 6, 0), done.stderr


# Lengths that no object has. Nothing takes memory for them.
ENDLESS = np.broadcast_to(np.float32(0), (10**11, 3))
ENDLESS_IDS = np.broadcast_to(np.uint32(0), (10**11, 2))
ENDLESS_CALLS = {
    "positions": lambda body: chainmail.make_mesh(ENDLESS, [[0, 1]]),
    "links": lambda body: chainmail.make_mesh([[0, 0], [1, 0]], ENDLESS_IDS),
    "new positions": lambda body: body.set_positions(ENDLESS),
    "other positions": lambda body: chainmail.distance(body, ENDLESS),
    "ids": lambda body: body.pin(ENDLESS_IDS[:, 0]),
    "a range of ids": lambda body: body.pin(range(10**11)),
    "numbers": lambda body: body.set_link_softness(stretch=ENDLESS[:, 0]),
    "a handle": lambda body: chainmail.Handle(body, ENDLESS_IDS[:, 0]),
    "a target": lambda body: chainmail.Deformer(body).move(0, ENDLESS[:, 0]),
    "a target without an end": lambda body: chainmail.Deformer(body).move(0, itertools.count()),
    "a line": lambda body: chainmail.Deformer(body).split(ENDLESS),
    "elements of a drag": lambda body: chainmail.Drag("drag", ENDLESS_IDS[:, 0], [(1, 0)]),
    "motions": lambda body: chainmail.Drag("drag", [0], ENDLESS),
    "drags": lambda body: chainmail.compare(body, [chainmail.Drag("drag", [0], [(1, 0, 0)])] * 10**6),
    "sweeps": lambda body: chainmail.compare(body, sweeps=ENDLESS_IDS[:, 0]),
    "methods": lambda body: chainmail.ramp(ENDLESS_IDS[:, 0]),
    "sweeps of a study": lambda body: chainmail.study(MESH, sweeps=ENDLESS_IDS[:, 0]),
    "a solution": lambda body: chainmail.reference_solution(body, ENDLESS_IDS[:, 0]),
}


@pytest.mark.parametrize("call", ENDLESS_CALLS)
def test_lengths_are_checked_before_memory_is_taken(call):
    """With little memory left, so that taking it fails this test and not the machine."""
    before = resource.getrlimit(resource.RLIMIT_AS)
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + 2**29, before[1]))
    try:
        with pytest.raises(chainmail.Error):
            ENDLESS_CALLS[call](chainmail.Body(MESH))
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def test_control_c_ends_a_copy():
    """The timer's signal comes while numbers are copied, which would take longer."""

    def interrupt(*_):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.02)
    try:
        with pytest.raises(KeyboardInterrupt):
            chainmail.Body(MESH).pin(ENDLESS_IDS[: 10**8, 0])
    finally:
        signal.signal(signal.SIGALRM, before)


def in_range(body):
    assert np.isfinite(body.positions()).all()


def test_no_position_is_not_a_number():
    """Numbers that overflow are refused where they arise: searches would use them as places in memory."""
    for degrees in (1e300, -1e308):
        body = chainmail.Body(MESH)
        with pytest.raises(chainmail.Error, match="rotation is not finite"):
            body.set_frame(chainmail.Rotation((0, 0, 1), degrees))
        in_range(body)
    with pytest.raises(chainmail.Error, match="mesh: a coordinate is out of the range of the precision; use double"):
        chainmail.Body(chainmail.make_line(3, spacing=1e80), "float")


@pytest.mark.parametrize("method", [row["name"] for row in chainmail.methods() if row["family"] == "elastic"])
def test_a_body_beyond_measure(method):
    body = chainmail.Body(MESH)
    body.pin(MESH.side("right"))
    body.set_elasticity(chainmail.Elasticity(iterations=20))
    body.set_positions(MESH.rest_positions() * 1e300)
    deformer = chainmail.Deformer(body, method)
    for name, target in ((method, (-1e305, 0, 1e304)), ("exact", (-0.3, 0, 0))):
        deformer.set_method(name)
        with contextlib.suppress(chainmail.Error):
            deformer.move(0, target)
        in_range(body)


@pytest.mark.parametrize("size, error", [("3", TypeError), (2.5, TypeError), (None, TypeError), (2**32 + 3, chainmail.Error),
                                         (2**70, chainmail.Error)])
def test_sizes_that_are_none(size, error):
    with pytest.raises(error):
        chainmail.make_line(size)


def test_an_exception_of_the_caller_is_not_hidden():
    class Array:
        def __array__(self, *_, **__):
            raise KeyError("of the caller")

    with pytest.raises(KeyError, match="of the caller"):
        chainmail.make_mesh(Array(), [[0, 1]])
