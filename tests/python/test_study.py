"""Parameter studies in this process."""

import chainmail
import numpy as np
import pytest

from study_helpers import cut_one, pin_the_last

COLUMNS = [
    "mesh", "elements", "links", "drag", "method", "compression", "stretch", "shear", "lateral", "stiffness",
    "exponent", "sweeps", "refusal", "passes", "checked", "moved", "stopped", "violation_max", "violation_rms",
    "violation_fraction", "displacement_max", "displacement_rms", "energy", "exact_distance_max",
    "exact_distance_rms", "ms_median", "ms_max",
]  # fmt: skip
SOFT = [chainmail.LinkSoftness(stretch=stretch) for stretch in (1.1, 1.3)]


def test_a_row_for_each_combination():
    meshes = {"line": chainmail.make_line(9), "cloth": chainmail.make_cloth(5, 4)}
    table = chainmail.study(meshes, ["natural-queue", "exact"], SOFT, sweeps=[0, 2])
    assert list(table) == COLUMNS
    assert all(len(column) == 16 for column in table.values())
    points = list(zip(table["mesh"], table["stretch"], table["method"], table["sweeps"]))
    assert points == [
        (mesh, stretch, method, sweeps)
        for mesh in meshes
        for stretch in (1.1, 1.3)
        for method in ("natural-queue", "exact")
        for sweeps in (0, 2)
    ]


def test_figures_are_those_of_a_drag_by_hand():
    mesh = chainmail.make_cloth(7, 5)
    drag = chainmail.Drag("corner", [0], [(-1, -1, 0), (-2, -2, 0)])
    table = chainmail.study(mesh, softness=SOFT[0], drag=drag)
    deformer, exact = chainmail.Deformer(mesh), chainmail.Deformer(mesh, "exact")
    moved = 0
    for each in (deformer, exact):
        each.body.set_softness(SOFT[0])
        handle = each.grab(0)
        results = [each.move(handle, handle.after(by)) for by in drag.path]
        moved = moved or sum(result.moved for result in results)
    assert table["moved"] == [moved] and table["passes"] == [2]
    assert table["violation_max"] == [chainmail.violation(deformer.body)["max"]]
    assert table["energy"] == [chainmail.elastic_energy(deformer.body)]
    assert table["exact_distance_rms"] == [chainmail.distance(deformer.body, exact.body.positions())["rms"]]
    assert table["ms_max"][0] >= table["ms_median"][0] > 0


def test_a_point_without_a_result_says_why():
    table = chainmail.study(chainmail.make_cloth(5, 4), ["3d", "fem", "generalized"])
    assert table["refusal"][0] and table["refusal"][1] and not table["refusal"][2]
    assert table["moved"][0] is None and table["moved"][2] > 0


def test_bodies_are_prepared():
    mesh = chainmail.make_line(6)
    table = chainmail.study(mesh, prepare=cut_one)
    assert table["moved"] == [0]
    table = chainmail.study(mesh, prepare=pin_the_last)
    assert table["moved"][0] > 0


def test_drags_per_mesh_and_handles_that_turn():
    turn = chainmail.Rotation((0, 0, 1), 20)
    table = chainmail.study(
        chainmail.make_cloth(5, 4), drag=lambda mesh: chainmail.Drag("turn", mesh.side("left"), [((0, 0, 0), turn)])
    )
    assert table["drag"] == ["turn"] and table["moved"][0] > 0


def test_progress():
    shares = []
    chainmail.study(chainmail.make_line(5), ["natural-queue", "exact"], progress=shares.append)
    assert shares == [0.5, 1]


@pytest.mark.parametrize("mesh", [chainmail.make_line(5), chainmail.make_tetra(3, 3, 3), chainmail.make_line(1)])
def test_the_standard_drag_leads_away(mesh):
    drag = chainmail.standard_drag(mesh)
    assert len(drag.path) == 10 and drag.elements.tolist() == [0]
    assert np.isfinite(drag.path).all()
    diagonal = np.linalg.norm(np.subtract(*mesh.bounds))
    assert np.linalg.norm(drag.path[-1]) == pytest.approx(0.3 * diagonal)


@pytest.mark.parametrize(
    "bad", [dict(methods=[]), dict(softness=[]), dict(sweeps=[]), dict(repetitions=0), dict(meshes={})]
)
def test_bad_studies(bad):
    with pytest.raises(chainmail.Error):
        chainmail.study(**{"meshes": chainmail.make_line(5), **bad})
