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


def test_relaxation_to_the_equilibrium():
    deformer = chainmail.Deformer(bar())
    deformer.move(44, (5, 3, 2))
    assert deformer.relax(1000, scheme="equilibrium", until=1e-6) > 0
    found = deformer.certificate()
    assert found.residual <= 1e-6 and found.iterations > 0 and found.energy_gap is None
    assert "residual" in repr(found)


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
