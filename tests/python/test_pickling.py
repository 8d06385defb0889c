"""Pickles and copies: what continues as the original would, in this process and in others."""

import copy
import multiprocessing
import pickle

import chainmail
import numpy as np
import pytest

from study_helpers import Occupied, finish_drag, violation_of

PROTOCOLS = range(pickle.HIGHEST_PROTOCOL + 1)
COPIERS = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    **{f"protocol {p}": lambda one, p=p: pickle.loads(pickle.dumps(one, p)) for p in PROTOCOLS},
}
MESHES = {
    "line": lambda: chainmail.make_line(9),
    "grid": lambda: chainmail.make_grid(6, 5),
    "cloth": lambda: chainmail.make_cloth(6, 5, space_dimension=3),
    "block": lambda: chainmail.make_block(4, 3, 3),
    "tetra": lambda: chainmail.make_tetra(4, 3, 3, spacing=0.3),
    "arrays": lambda: chainmail.make_mesh(
        np.random.default_rng(5).normal(size=(5, 3)), [[3, 4]], tetrahedra=[[0, 1, 2, 3]], triangles=[[2, 3, 4]]
    ),
}
METHODS = [row["name"] for row in chainmail.methods()]


@pytest.mark.parametrize("copier", COPIERS)
@pytest.mark.parametrize("kind", MESHES)
def test_meshes(kind, copier):
    mesh = MESHES[kind]()
    again = COPIERS[copier](mesh)
    assert (again == mesh) == (copier in ("copy", "deepcopy"))  # a mesh does not change, so its copy is the same
    assert np.array_equal(again.rest_positions(), mesh.rest_positions())
    for name in ("links", "triangles", "tetrahedra", "hexahedra"):
        assert np.array_equal(getattr(again, name), getattr(mesh, name))
    assert (again.lattice, again.is_grid, again.axes) == (mesh.lattice, mesh.is_grid, mesh.axes)


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_values(protocol):
    turn = chainmail.Rotation((0, 0, 1), 30)
    deformer = chainmail.Deformer(chainmail.make_cloth(5, 5))
    result = deformer.move(0, (-3, -2))
    for value in (turn, chainmail.Pose((1, 2), turn), chainmail.LinkSoftness(stretch=1.5), chainmail.Elasticity(young=3)):
        assert pickle.loads(pickle.dumps(value, protocol)) == value
        assert copy.deepcopy(value) == value and copy.copy(value) == value
    again = pickle.loads(pickle.dumps(result, protocol))
    assert (again.moved, again.checked, again.stopped) == (result.moved, result.checked, result.stopped)
    assert again.reached == result.reached and again.remark == result.remark
    deformer.relax(20, scheme="equilibrium")
    certificate = deformer.certificate()
    again = pickle.loads(pickle.dumps(certificate, protocol))
    assert (again.residual, again.iterations, again.energy_gap) == (
        certificate.residual, certificate.iterations, certificate.energy_gap)  # fmt: skip


def prepared_body(precision="double"):
    """A body in which nothing has its standard value."""
    deformer = chainmail.Deformer(chainmail.make_cloth(7, 6), precision=precision)
    body = deformer.body
    body.set_softness(chainmail.LinkSoftness(stretch=1.3, lateral=0.5))
    body.set_link_softness([3, 5, 8], shear=[0.2, 0.3, 0.2])
    body.set_energy("axial")
    body.set_elasticity(chainmail.Elasticity(poisson=0.4, iterations=300))
    body.set_frame(chainmail.Rotation((0, 0, 1), 25))
    body.cut([4, 11])
    body.pin([41, 40])
    deformer.move(0, (-3, -2.5))
    return body


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("copier", COPIERS)
def test_bodies(copier, precision):
    body = prepared_body(precision)
    again = COPIERS[copier](body)
    assert np.array_equal(again.positions(), body.positions())
    assert (again.precision, again.energy) == (body.precision, body.energy)
    assert (again.softness, again.elasticity, again.frame) == (body.softness, body.elasticity, body.frame)
    for name, numbers in body.link_softness().items():
        assert np.array_equal(again.link_softness()[name], numbers)
    assert again.cuts().tolist() == [4, 11] and again.pins().tolist() == [40, 41]
    again.unpin([41])
    again.uncut([4])
    assert body.is_pinned(41) and body.is_cut(4)


@pytest.mark.parametrize("copier", [COPIERS[name] for name in ("deepcopy", "protocol 5")])
def test_what_belongs_together_stays_together(copier):
    deformer = chainmail.Deformer(chainmail.make_cloth(7, 6))
    mesh, body, handle, snapshot = deformer.body.mesh, deformer.body, deformer.grab([0, 1]), deformer.body.snapshot()
    for order in ([0, 1, 2, 3, 4], [4, 3, 2, 1, 0], [3, 0, 4, 1, 2]):
        parts = [mesh, body, deformer, handle, snapshot]
        found = dict(zip(order, copier([parts[i] for i in order])))
        assert found[2].body is found[1] and found[1].mesh == found[0]
        found[2].move(found[3], found[3].after((-2, -1)))
        assert found[1].position(0) == (-2, -1, 0)
        found[1].restore(found[4])
        assert np.array_equal(body.positions(), body.mesh.rest_positions())


def test_a_handle_keeps_its_pose_and_its_shape():
    deformer = chainmail.Deformer(chainmail.make_cloth(7, 6))
    handle = deformer.grab([0, 1, 7])
    deformer.move(handle, handle.after((-1, -2), chainmail.Rotation((0, 0, 1), 40)))
    for copier in COPIERS.values():
        again = copier(handle)
        assert again.elements.tolist() == [0, 1, 7]
        assert (again.grabbed, again.pose) == (handle.grabbed, handle.pose)


def mesh_for(method):
    facts = next(row for row in chainmail.methods() if row["name"] == method)
    if facts["needs_grid"]:
        return chainmail.make_block(5, 4, 3)
    return chainmail.make_tetra(5, 4, 3)


def begun(method, precision, many, turned):
    """A deformer in the middle of a drag."""
    deformer = chainmail.Deformer(mesh_for(method), method, precision)
    body = deformer.body
    body.set_softness(chainmail.LinkSoftness(stretch=1.3, compression=0.7, lateral=0.6))
    if next(row for row in chainmail.methods() if row["name"] == method)["family"] == "chainmail":
        body.set_link_softness([3, 5, 8], shear=[0.2, 0.3, 0.2])
        body.cut([7, 20])
    body.set_elasticity(chainmail.Elasticity(poisson=0.35, iterations=40))
    if turned:
        body.set_frame(chainmail.Rotation((1, 2, 3), 25))
    body.pin(body.mesh.side("right"))
    handle = deformer.grab([0, 1, 5] if many else [0])
    deformer.set_tracing(True)
    deformer.set_threads(2)
    for step in range(1, 4):
        rotation = chainmail.Rotation((0, 0, 1), 4.3 * step) if many else chainmail.Rotation((0, 0, 1), 0)
        deformer.move(handle, handle.after((-0.31 * step, 0.17 * step, -0.11 * step), rotation))
    return deformer, handle


def continued(deformer, handle, scheme):
    """Continues a drag, and returns all positions on the way."""
    seen = []
    many = len(handle.elements) > 1
    for step in range(4):
        rotation = chainmail.Rotation((0, 1, 1), 5.7 * step) if many else chainmail.Rotation((0, 0, 1), 0)
        deformer.move(handle, handle.after((-0.93 + 0.23 * step, 0.41, 0.07 * step), rotation))
        seen.append(deformer.body.positions())
        seen.append(deformer.moved())
        deformer.relax(2, scheme=scheme)
        seen.append(deformer.body.positions())
    deformer.move(2, (2.3, 0.4, 0.1))
    seen.append(deformer.body.positions())
    deformer.body.uncut(deformer.body.cuts())
    deformer.body.unpin(deformer.body.pins()[:2])
    deformer.release()
    deformer.move(1, (1.3, -0.4, 0.1))
    seen.append(deformer.body.positions())
    return seen


def assert_equal(one, other):
    assert len(one) == len(other)
    for at, (a, b) in enumerate(zip(one, other)):
        assert np.array_equal(a, b), at


@pytest.mark.parametrize("copier", ["copy", "deepcopy", "protocol 0", "protocol 5"])
@pytest.mark.parametrize("many", [False, True])
@pytest.mark.parametrize("method", METHODS)
def test_a_deformer_continues_as_the_original(method, many, copier):
    deformer, handle = begun(method, "double", many, turned=False)
    deformer.relax(1)
    if copier == "copy":
        again, its_handle = copy.copy(deformer), copy.copy(handle)
    else:
        again, its_handle = COPIERS[copier]((deformer, handle))
    assert again.body is not deformer.body and again.method == method
    assert np.array_equal(again.body.positions(), deformer.body.positions())
    assert np.array_equal(again.trace(), deformer.trace()) and np.array_equal(again.moved(), deformer.moved())
    assert_equal(continued(again, its_handle, "mean"), continued(deformer, handle, "mean"))


@pytest.mark.parametrize("many", [False, True])
@pytest.mark.parametrize("method", [row["name"] for row in chainmail.methods() if row["family"] == "chainmail"])
@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("scheme", ["mean", "link", "equilibrium"])
def test_relaxation_continues(scheme, precision, method, many):
    deformer, handle = begun(method, precision, many, turned=precision == "float")
    deformer.relax(1, scheme=scheme)
    again, its_handle = pickle.loads(pickle.dumps((deformer, handle)))
    one, other = deformer.relax(40, scheme=scheme), again.relax(40, scheme=scheme)
    assert one == other and np.array_equal(again.body.positions(), deformer.body.positions())
    assert_equal(continued(again, its_handle, scheme), continued(deformer, handle, scheme))


@pytest.mark.parametrize("energy", ["isotropic", "axial", "corotated", "material"])
def test_relaxation_of_each_energy_continues(energy):
    deformer, _ = begun("natural-queue", "double", False, turned=False)
    deformer.body.set_energy(energy)
    deformer.relax(3)
    again = pickle.loads(pickle.dumps(deformer))
    assert deformer.relax(40) == again.relax(40)
    assert np.array_equal(again.body.positions(), deformer.body.positions())


# These take up the handle again, with other last digits.
REGRABS = {"exact", "ffd"}


@pytest.mark.parametrize("many", [False, True])
@pytest.mark.parametrize("method", [name for name in METHODS if name not in REGRABS])
def test_a_pickle_does_not_change_the_original(method, many):
    (deformer, handle), (control, other) = (begun(method, "double", many, False) for _ in range(2))
    pickle.dumps(deformer)
    assert_equal(continued(deformer, handle, "link"), continued(control, other, "link"))


def test_control_points_are_carried():
    deformer = chainmail.Deformer(chainmail.make_tetra(5, 4, 3), "ffd")
    deformer.move(0, (-1, -1, 0))
    deformer.move_control_point(5, (0.3, 0.2, 0.1))
    before = deformer.control_points()
    again = pickle.loads(pickle.dumps(deformer))
    assert np.array_equal(deformer.control_points(), before) and np.array_equal(again.control_points(), before)
    for each in (deformer, again):
        each.move_control_point(9, (0.3, 0.9, 0.1))
    assert np.array_equal(again.body.positions(), deformer.body.positions())


def test_a_copy_before_the_first_move_and_of_a_copy():
    for method in METHODS:
        deformer = chainmail.Deformer(mesh_for(method), method)
        deformer.body.pin(deformer.body.mesh.side("right"))
        deformer = copy.deepcopy(copy.deepcopy(deformer))
        deformer.move(0, (-0.3, 0.2, 0.1))
        once = copy.deepcopy(deformer)
        twice = pickle.loads(pickle.dumps(copy.deepcopy(deformer)))
        for each in (deformer, once, twice):
            each.move(0, (-0.5, 0.1, -0.1))
        assert np.array_equal(once.body.positions(), deformer.body.positions()), method
        assert np.array_equal(twice.body.positions(), deformer.body.positions()), method


def test_a_job_is_not_carried():
    deformer = chainmail.Deformer(chainmail.make_tetra(5, 4, 3), "fem")
    deformer.body.pin(deformer.body.mesh.side("right"))
    job = chainmail.Job()
    job.cancel()
    deformer.set_job(job)
    again = pickle.loads(pickle.dumps(deformer))
    with pytest.raises(chainmail.Cancelled):
        deformer.move(0, (-0.3, 0, 0))
    assert again.move(0, (-0.3, 0, 0)).moved > 0


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_what_cannot_be_pickled_says_so(protocol):
    deformer = chainmail.Deformer(chainmail.make_tetra(4, 3, 3))
    deformer.body.pin(deformer.body.mesh.side("right"))
    deformer.move(0, (-0.3, 0, 0))
    for one, words in (
        (chainmail.Job(), "Job: it belongs to the work of this process; make another one"),
        (chainmail.reference_solution(deformer.body, 0), "ReferenceSolution: it belongs to a mesh of this process"),
    ):
        for refused in (lambda: pickle.dumps(one, protocol), lambda: copy.copy(one), lambda: copy.deepcopy(one)):
            with pytest.raises(chainmail.Error, match=words):
                refused()


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_a_pool_of_processes(start):
    """Workers get meshes, bodies, deformers and handles, and return them."""
    deformers = [begun("exact", "double", True, turned=False) for _ in range(3)]
    bodies = [prepared_body(), chainmail.Body(chainmail.make_line(4))]
    with multiprocessing.get_context(start).Pool(2) as pool:
        moved = pool.map_async(finish_drag, deformers).get(120)
        violations = pool.map_async(violation_of, bodies).get(120)
        meshes = pool.starmap_async(chainmail.make_grid, [(3, 4), (5, 6)]).get(120)
    assert [mesh.element_count for mesh in meshes] == [12, 30]
    assert violations == [chainmail.violation(body) for body in bodies]
    for (deformer, handle), (again, result) in zip(deformers, moved):
        expected = finish_drag((deformer, handle))[1]
        assert np.array_equal(again.body.positions(), deformer.body.positions())
        assert (result.moved, result.reached) == (expected.moved, expected.reached)


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_functions(protocol):
    for name in chainmail.__all__:
        value = getattr(chainmail, name)
        if callable(value):
            assert pickle.loads(pickle.dumps(value, protocol)) is value, name
    with pytest.raises(TypeError, match="cannot pickle 'PyCapsule' object"):  # of another module
        pickle.dumps(__import__("datetime").datetime_CAPI, protocol)


def test_a_busy_body_is_not_pickled():
    deformer = chainmail.Deformer(chainmail.make_cloth(20, 20))
    with Occupied(deformer.body):
        for one in (deformer, deformer.body):
            with pytest.raises(chainmail.Error, match="body: another thread uses it"):
                pickle.dumps(one)
