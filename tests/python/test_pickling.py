"""Pickles and copies, in this process and in others."""

import copy
import multiprocessing
import pickle

import chainmail
import numpy as np
import pytest

from study_helpers import drag_the_first

PROTOCOLS = range(pickle.HIGHEST_PROTOCOL + 1)
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


@pytest.mark.parametrize("protocol", PROTOCOLS)
@pytest.mark.parametrize("kind", MESHES)
def test_meshes(kind, protocol):
    mesh = MESHES[kind]()
    again = pickle.loads(pickle.dumps(mesh, protocol))
    assert again != mesh and mesh == copy.copy(mesh) == copy.deepcopy(mesh)  # a mesh does not change
    assert np.array_equal(again.rest_positions(), mesh.rest_positions())
    for name in ("links", "triangles", "tetrahedra", "hexahedra"):
        assert np.array_equal(getattr(again, name), getattr(mesh, name))
    assert (again.lattice, again.is_grid, again.axes) == (mesh.lattice, mesh.is_grid, mesh.axes)


def test_a_mesh_keeps_the_order_of_neighbours(tmp_path):
    file = tmp_path / "3x1.dat"
    file.write_text("0 1 1\n1 2 2 0\n2 1 1\n")
    mesh = chainmail.read_mesh(file)
    assert mesh.neighbours(1).tolist() == [2, 0]
    assert pickle.loads(pickle.dumps(mesh)).neighbours(1).tolist() == [2, 0]


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
    drag = chainmail.Drag("d", [1, 2], [(1, 2, 3), ((1, 0, 0), turn)])
    again = pickle.loads(pickle.dumps(drag, protocol))
    assert (again.name, again.elements.tolist(), again.path) == ("d", [1, 2], drag.path)
    error = pickle.loads(pickle.dumps(chainmail.Error("a", "b", "c"), protocol))
    assert (str(error), error.where, error.problem, error.remedy) == ("a: b; c", "a", "b", "c")


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_what_cannot_be_pickled_says_so(protocol):
    deformer = chainmail.Deformer(chainmail.make_tetra(4, 3, 3))
    body = deformer.body
    body.pin(body.mesh.side("right"))
    deformer.move(0, (-0.3, 0, 0))
    for one, words in (
        (deformer, "Deformer: it belongs to this process; make a Deformer there"),
        (body, "Body: it belongs to this process; pickle its mesh"),
        (deformer.grab(0), "Handle: it is of a mesh of this process; grab"),
        (body.snapshot(), "Snapshot: it belongs to a body of this process; pickle"),
        (chainmail.Job(), "Job: it belongs to the work of this process; make another one"),
        (chainmail.reference_solution(body, 0), "ReferenceSolution: it belongs to a mesh of this process"),
    ):
        with pytest.raises(chainmail.Error, match=words):
            pickle.dumps(one, protocol)


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_a_pool_of_processes(start):
    """Workers get meshes, make their deformers, and return results and arrays."""
    meshes = [chainmail.make_cloth(6, 5), chainmail.make_tetra(4, 3, 3)]
    with multiprocessing.get_context(start).Pool(2) as pool:
        moved = pool.map_async(drag_the_first, meshes).get(120)
        made = pool.starmap_async(chainmail.make_grid, [(3, 4), (5, 6)]).get(120)
    assert [mesh.element_count for mesh in made] == [12, 30]
    for mesh, (result, positions) in zip(meshes, moved):
        expected, at = drag_the_first(mesh)
        assert np.array_equal(positions, at)
        assert (result.moved, result.reached) == (expected.moved, expected.reached)


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_functions(protocol):
    for name in chainmail.__all__:
        value = getattr(chainmail, name)
        if callable(value):
            assert pickle.loads(pickle.dumps(value, protocol)) is value, name
    with pytest.raises(TypeError, match="cannot pickle 'PyCapsule' object"):  # of another module
        pickle.dumps(__import__("datetime").datetime_CAPI, protocol)
