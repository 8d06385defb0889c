"""Views of positions and meshes: no copy, read-only, never dangling."""

import gc

import chainmail
import numpy as np
import pytest


def test_a_view_shows_later_moves():
    deformer = chainmail.Deformer(chainmail.make_grid(20, 10))
    view = deformer.body.view()
    deformer.move(0, (-8, -4))
    assert np.array_equal(view, deformer.body.positions()[:, :2])
    assert view[0].tolist() == [-8, -4]


def test_a_copy_does_not():
    deformer = chainmail.Deformer(chainmail.make_grid(20, 10))
    copy = deformer.body.positions()
    deformer.move(0, (-8, -4))
    assert np.array_equal(copy, deformer.body.mesh.rest_positions())
    copy[0] = 5  # it may be written
    assert deformer.body.position(0) == (-8, -4, 0)


@pytest.mark.parametrize("precision, dtype", [("double", np.float64), ("float", np.float32)])
@pytest.mark.parametrize("dimension", [1, 2, 3])
def test_shape_and_type(precision, dtype, dimension):
    body = chainmail.Body(chainmail.make_line(7, space_dimension=dimension), precision)
    view = body.view()
    assert (view.shape, view.dtype) == ((7, dimension), dtype)
    assert np.array_equal(view, body.mesh.rest_positions()[:, :dimension])


def test_a_view_cannot_be_written():
    view = chainmail.Body(chainmail.make_grid(4, 4)).view()
    with pytest.raises(ValueError):
        view[0, 0] = 1
    with pytest.raises(ValueError):
        view.flags.writeable = True


def test_a_view_outlives_everything():
    deformer = chainmail.Deformer(chainmail.make_block(30, 30, 30))
    deformer.move(0, (-8, -4, -2))
    expected = deformer.body.positions()
    part = deformer.body.view()[100:, 1:]
    del deformer
    gc.collect()
    noise = [np.full(27000 * 4, 7.0) for _ in range(20)]  # would overwrite memory that was given back
    assert np.array_equal(part, expected[100:, 1:])
    del noise


def test_arrays_of_a_mesh_outlive_it():
    mesh = chainmail.make_tetra(6, 5, 4)
    links, cells = mesh.links, mesh.tetrahedra
    expected = links.copy(), cells.copy()
    del mesh
    gc.collect()
    noise = [np.full(5000, 7, np.uint32) for _ in range(50)]
    assert np.array_equal(links, expected[0]) and np.array_equal(cells, expected[1])
    assert not links.flags.writeable
    del noise


def test_a_mesh_without_cells_has_empty_arrays():
    mesh = chainmail.make_line(3)
    assert (mesh.triangles.shape, mesh.tetrahedra.shape, mesh.hexahedra.shape) == ((0, 3), (0, 4), (0, 8))


def test_no_view_of_displacements():
    body = chainmail.Deformer(chainmail.make_grid(5, 5), "exact").body
    with pytest.raises(chainmail.Error, match="use positions"):
        body.view()


def test_no_view_along_turned_axes():
    body = chainmail.Body(chainmail.make_grid(5, 5))
    body.set_frame(chainmail.Rotation((0, 0, 1), 30))
    with pytest.raises(chainmail.Error, match="turned axes"):
        body.view()


def test_storage_stays_while_a_view_exists():
    deformer = chainmail.Deformer(chainmail.make_grid(5, 5))
    view = deformer.body.view()[1:]
    with pytest.raises(chainmail.Error, match="a view of its positions is in use"):
        deformer.set_method("exact")
    with pytest.raises(chainmail.Error, match="a view of its positions is in use"):
        deformer.body.set_frame(chainmail.Rotation((0, 0, 1), 30))
    with pytest.raises(chainmail.Error, match="a view of its positions is in use"):
        deformer.body.set_frame_of_object()
    deformer.set_method("spiral")  # stores positions, too
    assert deformer.method == "spiral"
    del view
    deformer.set_method("exact")
    deformer.body.set_frame(chainmail.Rotation((0, 0, 1), 30))


def test_a_new_deformer_keeps_the_storage_while_a_view_exists():
    body = chainmail.Body(chainmail.make_grid(5, 5))
    view = body.view()
    with pytest.raises(chainmail.Error, match="a view of its positions is in use"):
        chainmail.Deformer(body, "exact")
    deformer = chainmail.Deformer(body, "natural-queue")
    deformer.move(0, (-4, -4))
    assert np.array_equal(view, body.positions()[:, :2])


@pytest.mark.parametrize(
    "change", ["reset", "restore", "set_positions", "relax", "set_method", "new deformer", "softness"]
)
def test_a_view_follows_each_change(change):
    body = chainmail.Body(chainmail.make_cloth(9, 9))
    snapshot = body.snapshot()
    view = body.view()
    deformer = chainmail.Deformer(body, "generalized")
    deformer.move(0, (-4, -4))
    if change == "reset":
        body.reset()
    elif change == "restore":
        body.restore(snapshot)
    elif change == "set_positions":
        body.set_positions(np.random.default_rng(2).normal(size=(81, 3)) * [1, 1, 0])
    elif change == "relax":
        assert deformer.relax(5) == 5
    elif change == "set_method":
        deformer.set_method("spiral")
        deformer.move(0, (-5, -4))
    elif change == "new deformer":
        del deformer
        deformer = chainmail.Deformer(body, "enhanced")
        deformer.move(0, (-5, -4))
    else:
        body.set_softness(chainmail.LinkSoftness(stretch=1.1))
        deformer.move(0, (-5, -4))
    assert np.array_equal(view, body.positions()[:, :2])


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("method", ["natural-queue", "exact"])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_copies_agree_however_positions_are_stored(turned, method, precision):
    mesh = chainmail.make_cloth(7, 5)
    deformer = chainmail.Deformer(mesh, method, precision)
    if turned:
        deformer.body.set_frame(chainmail.Rotation((0, 0, 1), 20))
    deformer.move(0, (-3, -2))
    one_by_one = [deformer.body.position(element) for element in range(mesh.element_count)]
    assert deformer.body.positions().tolist() == [list(at) for at in one_by_one]
