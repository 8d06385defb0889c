"""Arrays that Python passes: shapes, types of numbers, values."""

import chainmail
import numpy as np
import pytest

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
RING = np.array([[0, 1], [1, 2], [2, 3], [3, 0]])


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.int64, np.uint8])
@pytest.mark.parametrize("order", ["C", "F"])
def test_positions_of_any_real_type(dtype, order):
    mesh = chainmail.make_mesh(np.asarray(SQUARE, dtype=dtype, order=order), RING)
    assert np.array_equal(mesh.rest_positions(), SQUARE)
    assert mesh.axes == "xy"


@pytest.mark.parametrize("columns, axes", [(1, "x"), (2, "xy"), (3, "xyz")])
def test_positions_of_one_to_three_columns(columns, axes):
    points = np.arange(4)[:, None] * np.array([1.0, 2.0, 3.0])[None, :columns]
    mesh = chainmail.make_mesh(points, [[0, 1], [1, 2], [2, 3]], space_dimension=columns)
    assert mesh.axes == axes
    assert np.array_equal(mesh.rest_positions()[:, :columns], points)


def test_strided_and_foreign_bytes():
    wide = np.zeros((8, 6))
    wide[::2, ::2] = SQUARE
    mesh = chainmail.make_mesh(wide[::2, ::2].astype(">f8"), RING.astype(">i4"))
    assert np.array_equal(mesh.rest_positions(), SQUARE)
    assert mesh.link_count == 4


def test_lists_are_arrays():
    mesh = chainmail.make_mesh(SQUARE.tolist(), RING.tolist(), triangles=[(0, 1, 2)])
    assert mesh.triangles.tolist() == [[0, 1, 2]]
    assert mesh.link_count == 5  # the diagonal is an edge of the triangle


BAD_MESHES = {
    "one dimension": (dict(positions=SQUARE.ravel(), links=RING), "shape (12,)"),
    "four columns": (dict(positions=np.zeros((4, 4)), links=RING), "shape (4, 4)"),
    "three dimensions": (dict(positions=np.zeros((4, 3, 1)), links=RING), "shape (4, 3, 1)"),
    "no columns": (dict(positions=np.zeros((4, 0)), links=RING), "shape (4, 0)"),
    "no rows": (dict(positions=np.zeros((0, 3)), links=RING), "0 numbers"),
    "complex": (dict(positions=SQUARE * 1j, links=RING), "complex128"),
    "text": (dict(positions=[["a", "b"], ["c", "d"]], links=RING), "of type"),
    "objects": (dict(positions=np.array([[None, 1, 2]] * 4), links=RING), "of type object"),
    "NaN": (dict(positions=SQUARE + np.array([0, 0, np.nan]), links=RING), "not a finite number"),
    "infinite": (dict(positions=np.full((4, 3), np.inf), links=RING), "not a finite number"),
    "flat links": (dict(positions=SQUARE, links=[0, 1, 1, 2]), "give the shape (n, 2)"),
    "links of three": (dict(positions=SQUARE, links=[[0, 1, 2]]), "give the shape (n, 2)"),
    "links of floats": (dict(positions=SQUARE, links=RING.astype(float)), "float64"),
    "links of truths": (dict(positions=SQUARE, links=RING > 0), "bool"),
    "negative id": (dict(positions=SQUARE, links=[[0, -1]]), "element -1: there is no such element"),
    "id too large": (dict(positions=SQUARE, links=[[0, 4]]), "uses element 4, which has no position"),
    "huge id": (dict(positions=SQUARE, links=[[0, 2**32]]), "element 4294967296"),
    "largest id": (dict(positions=SQUARE, links=[[0, 2**32 - 1]]), "element 4294967295"),
    "link to itself": (dict(positions=SQUARE, links=[[0, 0]]), "uses an element twice"),
    "no link": (dict(positions=SQUARE), "there is no link"),
    "no such dimension": (dict(positions=SQUARE, links=RING, space_dimension=1), "extends along 2 axes"),
    "triangles of four": (dict(positions=SQUARE, triangles=[[0, 1, 2, 3]]), "give the shape (n, 3)"),
    "triangle twice": (dict(positions=SQUARE, triangles=[[0, 1, 2], [0, 1, 2]]), "are there twice"),
    "tetrahedra of three": (dict(positions=SQUARE, tetrahedra=[[0, 1, 2]]), "give the shape (n, 4)"),
    "hexahedra of four": (dict(positions=SQUARE, hexahedra=[[0, 1, 2, 3]]), "give the shape (n, 8)"),
}


@pytest.mark.parametrize("bad", BAD_MESHES)
def test_bad_meshes(bad):
    arguments, words = BAD_MESHES[bad]
    with pytest.raises(chainmail.Error) as raised:
        chainmail.make_mesh(**arguments)
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)


def test_rows_of_different_length():
    with np.errstate(all="ignore"), pytest.raises((chainmail.Error, ValueError)):
        chainmail.make_mesh([[0, 0, 0], [1, 0]], [[0, 1]])


@pytest.mark.parametrize("size", [0, -1, 2**32])
def test_sizes_out_of_range(size):
    for make in (chainmail.make_line, lambda n: chainmail.make_grid(n, 2), lambda n: chainmail.make_tetra(2, 2, n)):
        with pytest.raises(chainmail.Error):
            make(size)


@pytest.mark.parametrize("shape", [(5, 3), (6, 1), (18,), (3, 6), (6, 3, 1), (0, 3), ()])
def test_positions_of_another_shape_change_nothing(shape):
    body = chainmail.Body(chainmail.make_grid(3, 2))
    before = body.positions()
    with pytest.raises(chainmail.Error, match="positions"):
        body.set_positions(np.zeros(shape))
    assert np.array_equal(body.positions(), before)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1e39])
def test_positions_that_are_no_numbers_change_nothing(value):
    body = chainmail.Body(chainmail.make_grid(3, 2), "float")
    before = body.positions()
    bad = before.copy()
    bad[4, 1] = value
    with pytest.raises(chainmail.Error, match="element 4"):
        body.set_positions(bad)
    assert np.array_equal(body.positions(), before)


def test_positions_off_the_plane_are_refused():
    body = chainmail.Body(chainmail.make_grid(3, 2))
    bad = body.positions()
    bad[2, 2] = 1
    with pytest.raises(chainmail.Error, match="does not extend along z"):
        body.set_positions(bad)


def test_positions_are_set_on_the_axes_that_exist():
    body = chainmail.Body(chainmail.make_grid(3, 2))
    flat = np.random.default_rng(1).normal(size=(6, 2))
    body.set_positions(flat)
    assert np.array_equal(body.positions(), np.column_stack([flat, np.zeros(6)]))


def test_columns_of_a_plane_of_x_and_z():
    upright = SQUARE[:, [0, 2, 1]] + np.array([0, 7, 0])
    mesh = chainmail.make_mesh(upright, RING)
    assert mesh.axes == "xz"
    body = chainmail.Body(mesh)
    body.set_positions([[1, 2], [3, 4], [5, 6], [7, 8]])
    assert body.positions().tolist() == [[1, 7, 2], [3, 7, 4], [5, 7, 6], [7, 7, 8]]
    assert body.view().tolist() == [[1, 2], [3, 4], [5, 6], [7, 8]]


BAD_OUTS = {
    "type": np.empty((6, 3), np.float32),
    "shape": np.empty((6, 2)),
    "order": np.empty((6, 3), order="F"),
    "strides": np.empty((12, 3))[::2],
    "list": [[0.0] * 3] * 6,
}


@pytest.mark.parametrize("bad", BAD_OUTS)
def test_an_array_that_cannot_take_positions(bad):
    with pytest.raises(chainmail.Error, match="out: "):
        chainmail.Body(chainmail.make_grid(3, 2)).positions(BAD_OUTS[bad])


def test_an_array_that_may_not_be_written():
    out = np.empty((6, 3))
    out.flags.writeable = False
    with pytest.raises(chainmail.Error, match="out: "):
        chainmail.Body(chainmail.make_grid(3, 2)).positions(out)


def test_an_array_that_takes_positions():
    body = chainmail.Body(chainmail.make_grid(3, 2))
    out = np.full((6, 3), np.nan)
    assert body.positions(out) is out
    assert np.array_equal(out, body.mesh.rest_positions())


BAD_IDS = [-1, 6, 2**31, 2**32, 2**64 - 1, 2**64, -(2**70)]


@pytest.mark.parametrize("element", BAD_IDS)
def test_elements_that_do_not_exist(element):
    body = chainmail.Body(chainmail.make_grid(3, 2))
    deformer = chainmail.Deformer(body)
    calls = [
        lambda: body.position(element),
        lambda: body.mesh.neighbours(element),
        lambda: body.mesh.rest_position(element),
        lambda: body.mesh.find_link(0, element),
        lambda: body.is_pinned(element),
        lambda: body.cut(0, element),
        lambda: deformer.move(element, (0, 0)),
        lambda: deformer.grab(element),
    ]
    for call in calls:
        with pytest.raises(chainmail.Error, match="element .*there is no such element"):
            call()


@pytest.mark.parametrize("ids", [[0, -1], [0, 6], np.array([2**40]), [[0, 1]], [0.5], ["a"], np.array([True])])
def test_lists_of_ids_that_do_not_exist(ids):
    body = chainmail.Body(chainmail.make_grid(3, 2))
    for call in (body.pin, body.unpin, body.cut, body.uncut, lambda some: chainmail.Handle(body, some)):
        before = body.pins().tolist(), body.cuts().tolist()
        if call in (body.cut, body.uncut) and np.array_equal(ids, [0, 6]):
            continue  # link 6 exists
        with pytest.raises(chainmail.Error):
            call(ids)
        assert (body.pins().tolist(), body.cuts().tolist()) == before


@pytest.mark.parametrize("ids", [2**64 - 1, [2**64 - 1], np.array([2**64 - 1], np.uint64)])
def test_an_id_is_named_as_it_was_given(ids):
    with pytest.raises(chainmail.Error, match="element 18446744073709551615: there is no such element"):
        chainmail.Body(chainmail.make_grid(3, 2)).pin(ids)


@pytest.mark.parametrize("link", [-1, 7, 2**32])
def test_links_that_do_not_exist(link):
    body = chainmail.Body(chainmail.make_grid(3, 2))
    calls = [
        lambda: body.mesh.link(link),
        lambda: body.cut([link]),
        lambda: body.is_cut(link),
        lambda: body.softness_of(link),
        lambda: body.set_softness(chainmail.LinkSoftness(), [link]),
        lambda: body.set_link_softness([link], stretch=2),
        lambda: body.clear_softness([link]),
        lambda: chainmail.violation(body, link),
    ]
    for call in calls:
        with pytest.raises(chainmail.Error, match="link .*there is no such link"):
            call()


@pytest.mark.parametrize("ids", [range(3), (0, 1, 2), np.arange(3, dtype=np.int8), np.arange(3, dtype=np.uint64)])
def test_ids_of_any_whole_type(ids):
    body = chainmail.Body(chainmail.make_grid(3, 2))
    body.pin(ids)
    assert body.pins().tolist() == [0, 1, 2]
    assert body.pins().dtype == np.uint32
    body.unpin([])
    body.unpin(np.int64(1))
    assert body.pins().tolist() == [0, 2]


@pytest.mark.parametrize("target", [(), (0, 0, 0, 0), np.zeros((2, 2))[:0]])
def test_targets_of_wrong_length(target):
    with pytest.raises(chainmail.Error, match="target: it has"):
        chainmail.Deformer(chainmail.make_grid(3, 2)).move(0, target)


@pytest.mark.parametrize("target", [1.0, None, "ab", ("a", 1), [None, None], np.zeros((2, 2))])
def test_targets_that_are_no_vectors(target):
    with pytest.raises(TypeError):
        chainmail.Deformer(chainmail.make_grid(3, 2)).move(0, target)


@pytest.mark.parametrize("target", [(np.nan, 0), (np.inf, 0), (0, 0, 1), (1e39, 0)])
def test_targets_that_no_element_can_reach(target):
    deformer = chainmail.Deformer(chainmail.make_grid(3, 2), precision="float")
    before = deformer.body.positions()
    with pytest.raises(chainmail.Error):
        deformer.move(0, target)
    assert np.array_equal(deformer.body.positions(), before)


@pytest.mark.parametrize("target", [(1, 2), [1, 2, 0], np.array([1.0, 2.0]), np.array([1, 2, 0], np.int32)])
def test_targets_are_any_vectors(target):
    deformer = chainmail.Deformer(chainmail.make_grid(3, 2))
    deformer.move(np.int32(0), target)
    assert deformer.body.position(0) == (1, 2, 0)
