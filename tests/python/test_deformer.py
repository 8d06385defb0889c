"""Deformers: methods, handles, traces, relaxation, control points."""

import chainmail
import numpy as np
import pytest


def bar():
    body = chainmail.Body(chainmail.make_tetra(5, 3, 3))
    body.pin(body.mesh.side("left"))
    return body


def test_facts_about_methods():
    rows = {row["name"]: row for row in chainmail.methods()}
    assert rows["natural-queue"]["family"] == "chainmail" and rows["fem"]["needs_pins"]
    assert set(rows["exact"]) == {
        "name", "label", "source", "summary", "family", "needs_grid", "needs_pins", "holds_links"
    }
    assert chainmail.refusal("exact", chainmail.make_line(3)) == ""
    assert "grid" in chainmail.refusal("3d", chainmail.make_tetra(3, 3, 3)) or chainmail.refusal(
        "3d", chainmail.make_tetra(3, 3, 3)
    )


def test_unknown_methods():
    body = bar()
    for call in (
        lambda: chainmail.Deformer(body, "magic"),
        lambda: chainmail.refusal("magic", body.mesh),
        lambda: chainmail.deform(body.mesh, 0, (1, 0, 0), method="magic"),
    ):
        with pytest.raises(chainmail.Error, match="method 'magic': there is no such method; use one of generalized"):
            call()
    with pytest.raises(chainmail.Error):
        chainmail.Deformer(body, "3d")
    assert chainmail.Deformer(body, "exact").method == "exact"  # the refusals left the body as it was


def test_a_body_has_one_deformer():
    body = bar()
    one = chainmail.Deformer(body)
    assert one.body is body
    with pytest.raises(chainmail.Error, match="it has a deformer already"):
        chainmail.Deformer(body)
    with pytest.raises(chainmail.Error, match="magic"):
        one.set_method("magic")
    one.move(44, (5, 3, 2))
    del one
    before = body.positions()
    two = chainmail.Deformer(body, "exact")
    assert np.allclose(body.positions(), before, atol=1e-12)
    two.move(44, (6, 3, 2))
    assert body.position(44) != tuple(before[44])


def test_a_handle_of_many_moves_as_a_rigid_body():
    mesh = chainmail.make_cloth(10, 10, space_dimension=3)
    deformer = chainmail.Deformer(mesh)
    handle = deformer.grab(mesh.side("left"))
    assert handle.elements.tolist() == list(range(0, 100, 10))
    assert handle.grabbed == chainmail.Pose((0, 4.5, 0)) == handle.pose
    turn = chainmail.Rotation((1, 0, 0), 90)
    result = deformer.move(handle, handle.after((-2, 0, 0), turn))
    assert result.reached == handle.pose == chainmail.Pose((-2, 4.5, 0), turn)
    expected = [[-2, 4.5, y - 4.5] for y in range(10)]
    assert np.allclose(deformer.body.positions()[handle.elements], expected)


def test_a_trace_is_the_candidates_in_order():
    deformer = chainmail.Deformer(chainmail.make_line(4))
    deformer.set_tracing(True)
    deformer.move(0, (-0.3,))
    assert deformer.trace().tolist() == [[1, 0, 1], [2, 1, 0]]
    assert deformer.trace().dtype == np.int64
    deformer.set_tracing(False)
    deformer.move(0, (-0.4,))
    assert deformer.trace().shape == (0, 3)


def test_another_deformer_of_a_body_begins_without_a_trace():
    body = chainmail.Body(chainmail.make_line(3))
    deformer = chainmail.Deformer(body, "generalized")
    deformer.set_tracing(True)
    deformer.move(0, (-5,))
    assert len(deformer.trace()) > 0
    del deformer
    assert chainmail.Deformer(body, "generalized").trace().shape == (0, 3)


def test_relaxation_to_the_equilibrium():
    deformer = chainmail.Deformer(bar())
    deformer.move(44, (5, 3, 2))
    assert deformer.relax(1000, scheme="equilibrium", until=1e-6) > 0
    found = deformer.certificate()
    assert found.residual <= 1e-6 and found.iterations > 0 and found.energy_gap is None
    assert "residual" in repr(found)


def test_a_split_makes_two_parts():
    deformer = chainmail.Deformer(chainmail.make_tetra(5, 4, 4))
    body, before = deformer.body, deformer.body.mesh
    body.pin(before.side("left"))
    body.set_softness(chainmail.LinkSoftness(stretch=1.5), [before.find_link(3, 4)])
    handle = deformer.grab(4)
    count = deformer.split([(1.3, -1), (2.6, 5)], (0.1, 0.2, -1))
    assert count > 0 and body.mesh.element_count == before.element_count + count
    assert body.mesh.part_count == 2 and before.part_count == 1
    assert np.array_equal(body.positions()[:80], before.rest_positions())
    assert set(before.side("left")) <= set(body.pins())
    assert body.softness_of(body.mesh.find_link(3, 4)).stretch == 1.5
    with pytest.raises(chainmail.Error, match="it is of another mesh"):
        deformer.move(handle, handle.after((1, 0, 0)))
    at = body.positions()
    assert deformer.move(4, (9, 0, 0)).moved > 0
    still = body.positions()
    assert np.array_equal(still[before.side("left")], at[before.side("left")]) and still[1].tolist() == [1, 0, 0]
    # The line is where the elements are: between the parts, there are none.
    assert deformer.split(np.array([[3, -1, 0], [3.4, 5, 0]]), (0, 0, 1)) == 0
    assert chainmail.Body(body.mesh).mesh.element_count == len(still)


def sheet(space_dimension):
    corners = [[x, y, 0] for y in range(3) for x in range(3)]
    faces = [[i, i + 1, i + 4] for i in (0, 1, 3, 4)] + [[i, i + 4, i + 3] for i in (0, 1, 3, 4)]
    return chainmail.make_mesh(corners, triangles=faces, space_dimension=space_dimension)


def test_a_split_of_faces():
    plane, space = (chainmail.Deformer(sheet(dimension), "exact") for dimension in (2, 3))
    assert plane.split([(1.4, -1), (1.6, 3)]) == space.split([(1.4, -1, 5), (1.6, 3, 5)], along=(0, 0, 1)) > 0
    assert plane.body.mesh.part_count == space.body.mesh.part_count == 2


@pytest.mark.parametrize(
    "mesh, line, along, words",
    [
        (chainmail.make_tetra(3, 3, 3), [(1, 1, 1)], (0, 0, 1), "fewer than two points"),
        (chainmail.make_tetra(3, 3, 3), [(1, 1, 1), (np.nan, 2, 2)], (0, 0, 1), "not a finite number"),
        (chainmail.make_tetra(3, 3, 3), [(1, 1, 1), (1e300, 2, 2)], (0, 0, 1), "a coordinate is too large"),
        (chainmail.make_tetra(3, 3, 3), [(1, 1, 1), (1, 1e308, 2)], (0, 0, 1), "a coordinate is too large"),
        (chainmail.make_tetra(3, 3, 3), [(1, 1, 1), (1, 2, 2, 2)], (0, 0, 1), "line: it has more than 3 numbers"),
        (chainmail.make_tetra(3, 3, 3), [(1, -1), (1, 3)], None, "no direction"),
        (chainmail.make_tetra(3, 3, 3), [(1, -1), (1, 3)], (0, 0, 0), "has the length 0"),
        (chainmail.make_tetra(60, 10, 10), [(1.5, -1), (1.5, 30)], (0, 0, 1), "elements"),
        (chainmail.make_grid(3, 3), [(1, -1), (1, 3)], None, "neither cells nor faces"),
        (sheet(2), [(1, -1), (1, 3)], (1, 0, 0), "in the plane of the object"),
    ],
)
def test_what_cannot_be_split(mesh, line, along, words):
    """The large block is too large for the method after the split."""
    deformer = chainmail.Deformer(mesh, "corotational" if mesh.element_count == 6000 else "natural-queue")
    with pytest.raises(chainmail.Error, match=words):
        deformer.split(line, along)
    assert deformer.body.mesh == mesh and deformer.body.positions().shape == (mesh.element_count, 3)


def test_nothing_is_split_while_a_view_exists():
    deformer = chainmail.Deformer(chainmail.make_tetra(3, 3, 3))
    view = deformer.body.view()
    with pytest.raises(chainmail.Error, match="a view of its positions is in use"):
        deformer.split([(1, -1), (1, 3)], (0, 0, 1))
    assert np.array_equal(view, deformer.body.positions())
    del view
    assert deformer.split([(1, -1), (1, 3)], (0, 0, 1)) == 9


def test_the_shortcut():
    mesh = chainmail.make_grid(6, 4)
    deformer = chainmail.Deformer(mesh)
    handle = deformer.grab([0, 1])
    deformer.move(handle, handle.after((-2, -1)))
    assert np.array_equal(chainmail.deform(mesh, [0, 1], (-2, -1)), deformer.body.positions())


def test_what_results_look_like():
    deformer = chainmail.Deformer(chainmail.make_line(3))
    assert repr(deformer) == "<Deformer: natural-queue on 3 elements>"
    assert repr(deformer.move(0, (-1,))) == "<MoveResult: 2 moved, 2 checked>"
    handle = deformer.grab([1, 2])
    assert repr(handle) == "<Handle: 2 elements at (0.7999999999999999, 0.0, 0.0)>"
    assert repr(deformer.grab(0)) == "<Handle: element 0 at (-1.0, 0.0, 0.0)>"
    assert repr(chainmail.Pose((1, 2))) == "Pose(pivot=(1.0, 2.0, 0.0))"
    pose = chainmail.Pose((1, 2), chainmail.Rotation((0, 0, 1), 5))
    assert eval(repr(pose), vars(chainmail)) == pose
