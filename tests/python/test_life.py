"""A deformer that goes through a long random life always moves as a copy, and as a new one that was made from its body."""

import os
import pickle
import random

import chainmail
import numpy as np
import pytest

FAMILY = {row["name"]: row["family"] for row in chainmail.methods()}
MESHES = {
    "grid": lambda: chainmail.make_grid(6, 5),
    "cloth": lambda: chainmail.make_cloth(5, 5, space_dimension=3),
    "block": lambda: chainmail.make_block(4, 3, 3),
    "tetra": lambda: chainmail.make_tetra(4, 3, 3, spacing=0.5),
}
# Far from rest, they go to other answers.
FOLLOW_THE_PATH = {"neo-hookean", "corotational", "arap", "xpbd", "projective", "quasi-newton", "neo-hookean-xpbd"}
STEPS = int(os.environ.get("CHAINMAIL_LIFE_STEPS", "400"))


class Life:
    """The steps draw their numbers before they act, so that they act alike on two deformers."""

    def __init__(self, mesh, seed):
        self.random = random.Random(seed)
        self.mesh = mesh
        self.plane = mesh.space_dimension == 2
        self.methods = [name for name in FAMILY if self.works(name)]
        self.deformer = chainmail.Deformer(mesh, "natural-queue")
        self.kept = self.deformer.body.snapshot()

    def works(self, method):
        try:
            chainmail.Deformer(self.mesh, method)
            return True
        except chainmail.Error:
            return False

    def vector(self, size):
        by = [self.random.uniform(-size, size) for _ in range(3)]
        return (by[0], by[1], 0 if self.plane else by[2])

    def some(self, count, most):
        return sorted(self.random.sample(range(count), self.random.randint(1, most)))

    def drag(self, may_relax):
        elements = self.some(self.mesh.element_count, 3)
        ways = [self.vector(1.5) for _ in range(self.random.randint(1, 3))]
        degrees = self.random.choice([0, 10, -25]) if len(elements) > 1 else 0
        threads = self.random.randint(1, 2)
        relaxes, scheme = may_relax and self.random.random() < 0.5, self.random.choice(["mean", "link", "equilibrium"])

        def act(deformer, _kept):
            deformer.set_threads(threads)
            free = [e for e in elements if not deformer.body.is_pinned(e)]
            if not free:
                return []
            handle, results = deformer.grab(free), []
            for way in ways:
                turn = chainmail.Rotation((0, 0, 1), degrees if len(free) > 1 else 0)
                try:
                    result = deformer.move(handle, handle.after(way, turn))
                    counts = (result.checked, result.moved) if FAMILY[deformer.method] == "chainmail" else ()
                    results.append((counts, result.stopped, result.remark[:25]))
                except chainmail.Error as error:
                    results.append(str(error))
            if relaxes and results and not isinstance(results[-1], str):
                deformer.relax(3, scheme=scheme)
            return results

        return act

    def change(self):
        links, elements = self.some(self.mesh.link_count, 3), self.some(self.mesh.element_count, 2)
        value, method = self.random.random(), self.random.choice(self.methods)
        softness = chainmail.LinkSoftness(
            compression=0.5 + value / 2, stretch=1 + value, shear=value / 3, lateral=value, stiffness=1 + value
        )
        moved = self.deformer.body.positions()
        moved[:, : 2 if self.plane else 3] += 0.02 * value
        return self.random.choice(
            [
                lambda one, kept: one.body.cut(links),
                lambda one, kept: one.body.uncut(links),
                lambda one, kept: one.body.pin(elements),
                lambda one, kept: one.body.unpin(elements),
                lambda one, kept: one.body.set_softness(softness),
                lambda one, kept: one.body.set_softness(softness, links),
                lambda one, kept: one.body.clear_softness(links),
                lambda one, kept: one.body.set_energy(["isotropic", "axial", "corotated"][len(links) - 1]),
                lambda one, kept: one.body.set_frame(chainmail.Rotation((0, 0, 1), 40 * value)),
                lambda one, kept: one.body.set_frame_of_object(),
                lambda one, kept: one.body.set_elasticity(chainmail.Elasticity(young=1 + value, poisson=0.45 * value)),
                lambda one, kept: one.set_method(method),
                lambda one, kept: one.body.reset(),
                lambda one, kept: one.body.set_positions(moved),
                lambda one, kept: one.body.restore(kept),
                lambda one, kept: one.release(),
            ]
        )

    def renewed(self, whole):
        """Elements that wait for relaxation, and what a method keeps between moves, are not part of the body."""
        if whole:
            return pickle.loads(pickle.dumps((self.deformer, self.kept)))
        body, kept = pickle.loads(pickle.dumps((self.deformer.body, self.kept)))
        return chainmail.Deformer(body, self.deformer.method), kept

    def step(self):
        whole = self.random.random() < 0.5
        fresh, kept = self.renewed(whole)
        assert facts_of(fresh.body) == facts_of(self.deformer.body)
        assert np.array_equal(fresh.body.positions(), self.deformer.body.positions())
        act = self.drag(whole) if self.random.random() < 0.5 else self.change()
        said = outcome_of(act, self.deformer, self.kept)
        again = outcome_of(act, fresh, kept)
        if not whole and self.deformer.method in FOLLOW_THE_PATH:
            return
        assert again == said
        assert facts_of(fresh.body) == facts_of(self.deformer.body)
        assert fresh.method == self.deformer.method
        self.compare(fresh.body.positions(), self.deformer.body.positions(), whole)
        if self.random.random() < 0.1:
            self.kept = self.deformer.body.snapshot()

    def compare(self, fresh, lived, whole):
        size = np.abs(lived - self.mesh.rest_positions()).max()
        tolerance = 1e-9 if whole else tolerance_of(self.deformer.method)  # corotated links turn by Newton's method
        if tolerance == 0:
            assert np.array_equal(fresh, lived)
        else:
            assert np.abs(fresh - lived).max() <= tolerance * (1 + size)


def outcome_of(act, deformer, kept):
    try:
        return act(deformer, kept)
    except chainmail.Error as error:
        return str(error)


def facts_of(body):
    return (
        body.softness, body.energy, body.elasticity, body.frame, body.cuts().tolist(), body.pins().tolist(),
        {name: numbers.tolist() for name, numbers in body.link_softness().items()},
    )  # fmt: skip


def tolerance_of(method):
    """Methods of elasticity end within a tolerance; Exact rounds a repaired state."""
    return 1e-5 if FAMILY[method] != "chainmail" else 1e-12 if method == "exact" else 0


@pytest.mark.parametrize("kind", MESHES)
def test_each_step_is_that_of_a_new_deformer(kind):
    seed = int(os.environ.get("CHAINMAIL_LIFE_SEED", random.randrange(10**6)))
    print(f"CHAINMAIL_LIFE_SEED={seed}")  # shown if the test fails
    life = Life(MESHES[kind](), seed)
    for _ in range(STEPS):
        life.step()
