"""Figures, and the tables of compare, calibrate and ramp."""

import csv
import json
import math
import subprocess

import chainmail
import numpy as np
import pytest

NAMES = ["drag", "method", "label", "sweeps", "equilibrium", "refusal"]


def beam():
    body = chainmail.Body(chainmail.make_tetra(5, 3, 3))
    body.pin(body.mesh.side("left"))
    return body


def is_table(table):
    return len({len(column) for column in table.values()}) == 1 and all(type(c) is list for c in table.values())


def test_violation_by_hand():
    """A link of rest length 1 may be 1.2 long; at length 2 it is violated by 0.8."""
    body = chainmail.Body(chainmail.make_line(3))
    body.set_positions([[0], [2], [3]])
    found = chainmail.violation(body)
    assert found["max"] == pytest.approx(0.8) and found["rms"] == pytest.approx(0.8 / math.sqrt(2))
    assert (found["fraction"], found["links"]) == (0.5, 2)
    assert chainmail.violation(body, 0) == pytest.approx(0.8) and chainmail.violation(body, 1) == 0
    assert chainmail.displacement(body) == {"max": 1, "rms": pytest.approx(math.sqrt(2 / 3))}


def test_distance_by_hand():
    body = chainmail.Body(chainmail.make_line(2, spacing=2))
    other = body.copy()
    other.set_positions([[0], [5]])
    expected = {"max": 1.5, "rms": pytest.approx(1.5 / math.sqrt(2))}
    assert chainmail.distance(body, other) == expected
    assert chainmail.distance(body, other.positions()) == expected
    assert chainmail.distance(body, [[0], [5]]) == expected
    assert chainmail.distance(body, body) == {"max": 0, "rms": 0}
    for bad in ([[0, 0, 0]], [[0], [np.nan]], chainmail.Body(chainmail.make_line(3))):
        with pytest.raises(chainmail.Error):
            chainmail.distance(body, bad)


def test_errors_against_the_reference_solution():
    body = beam()
    tip = 44
    deformer = chainmail.Deformer(body, "neo-hookean")
    deformer.move(tip, tuple(np.add(body.mesh.rest_position(tip), (0, 1, 0))))
    reference = chainmail.reference_solution(body, tip)
    assert reference.handle_displacement == pytest.approx(1)
    assert chainmail.physical_error(body, reference)["relative"] < 1e-3
    rest = chainmail.physical_error_of_rest(reference)
    assert set(rest) == {"relative", "rms", "max"} and 0.5 < rest["relative"] < 1.5
    with pytest.raises(chainmail.Error, match="rest"):
        body.reset()
        chainmail.reference_solution(body, tip)
    with pytest.raises(chainmail.Error, match="another mesh"):
        chainmail.physical_error(beam(), reference)


def test_compare_is_a_table(tmp_path):
    drag = chainmail.Drag("corner", [0], [(-step, -step, 0) for step in range(1, 4)])
    table = chainmail.compare(
        chainmail.Body(chainmail.make_cloth(9, 9)), [drag], methods=["natural-queue", "exact"], sweeps=[0, 2],
        repetitions=1, folder=tmp_path / "report",
    )
    assert list(table)[:6] == NAMES and is_table(table)
    assert table["drag"] == ["corner"] * 4
    assert sorted(zip(table["method"], table["sweeps"])) == [
        ("exact", 0), ("exact", 2), ("natural-queue", 0), ("natural-queue", 2)
    ]  # fmt: skip
    exact = table["method"].index("exact")
    assert table["violation_max"][exact] < 1e-4
    written = list(csv.DictReader(open(tmp_path / "report" / "report.csv", newline="")))
    assert [float(row["violation_max"]) for row in written] == table["violation_max"]
    report = json.loads((tmp_path / "report" / "report.json").read_text())
    figures = [name for name in list(table)[6:] if not name.endswith("_quartile")]
    assert figures == [figure["key"] for figure in report["figures"]]
    times = [row["ms_per_move"] for row in report["objects"][0]["drags"][0]["contestants"]]
    assert [time["upper_quartile"] for time in times] == table["ms_per_move_upper_quartile"]
    assert (tmp_path / "report" / "report.html").exists() and list((tmp_path / "report").glob("*.svg"))


def test_compare_with_physics_is_a_table(tmp_path):
    drags = [chainmail.Drag("pull", [44], [(0, 1, 0)]), chainmail.Drag("too far", [44], [(1e300, 0, 0)])]
    table = chainmail.compare(beam(), drags, methods=["fem"], against="physics", repetitions=1, folder=tmp_path)
    assert list(table)[:6] == NAMES and is_table(table)
    assert table["drag"] == ["pull", "pull", "too far"] and table["method"] == ["nothing", "fem", ""]
    nothing, fem, no_reference = table["relative"]
    assert 0 < fem < 0.1 < nothing < 1.5 and no_reference is None
    assert table["ms_per_move"][0] is None and table["ms_per_move"][1] > 0
    assert table["refusal"][:2] == ["", ""] and "Newton did not converge" in table["refusal"][2]


@pytest.mark.parametrize("path", [[5], [(1, 2, 3, 4)], ["ab"], [None]])
def test_bad_paths(path):
    with pytest.raises((chainmail.Error, TypeError)):
        chainmail.Drag("d", [0], path)


def test_calibrate_is_a_dictionary_with_a_table():
    options = dict(drags=1, held_out=1, evaluations=5, most_sweeps=3)
    found = chainmail.calibrate(beam(), **options)
    assert list(found) == ["softness", "sweeps", "evaluations", "errors", "json"]
    assert isinstance(found["softness"], chainmail.LinkSoftness) and found["evaluations"] >= 1
    assert list(found["errors"]) == ["drags", "state", "relative", "error_rms", "error_max"]
    assert is_table(found["errors"])
    assert found["errors"]["drags"] == ["fitted"] * 3 + ["held out"] * 3
    assert found["errors"]["state"] == ["nothing", "before", "after"] * 2
    report = json.loads(found["json"])
    assert report["compression"] == found["softness"].compression
    assert report["residual"]["relative"] == found["errors"]["relative"][2]
    assert chainmail.calibrate(beam(), **options) == found
    wounded = beam()
    wounded.cut([link for link, (a, b) in enumerate(wounded.mesh.links) if a % 5 == 2 and b % 5 == 3 and a % 15 < 5])
    assert chainmail.calibrate(wounded, **options)["errors"]["relative"][0] != found["errors"]["relative"][0]
    other = json.loads(chainmail.calibrate(beam(), seed=2, **options)["json"])
    assert other["options"]["seed"] == 2 and other["drags"] != report["drags"]


def test_ramp_is_two_tables():
    found = chainmail.ramp(["natural-queue", "exact"], largest=64, drags=1, moves=3)
    assert list(found) == ["sizes", "methods", "seconds"]
    assert list(found["sizes"]) == [
        "width", "elements", "links", "method", "passes", "median_ms", "p99_ms", "mean_moved", "repeated", "real_time",
    ]  # fmt: skip
    assert list(found["methods"]) == ["method", "largest_width", "lost", "growth_exponent"]
    assert is_table(found["sizes"]) and is_table(found["methods"])
    assert [type(found["sizes"][name][0]) for name in ("passes", "p99_ms", "repeated")] == [int, float, bool]
    assert found["sizes"]["width"][0] == 4 and found["sizes"]["elements"][-1] <= 64
    assert found["methods"]["method"] == ["natural-queue", "exact"]


def test_a_preset_for_the_command_line(program, tmp_path):
    preset, mesh = tmp_path / "soft.json", tmp_path / "cloth.obj"
    chainmail.write_preset(preset, "soft", chainmail.LinkSoftness(stretch=1.5))
    chainmail.write_mesh(mesh, chainmail.make_cloth(5, 5))
    subprocess.run(
        [program, "compare", mesh, "--preset", preset, "--repetitions", "1", "-o", tmp_path / "out"], check=True,
        capture_output=True,
    )
    with pytest.raises(chainmail.Error, match="preset"):
        chainmail.write_preset(preset, "", chainmail.LinkSoftness())


def test_drags():
    drag = chainmail.Drag("turn", range(3), [(1, 0, 0), ((2, 0, 0), chainmail.Rotation((0, 0, 1), 5))])
    assert repr(drag) == "<Drag: 'turn', 3 elements, 2 moves>"
    assert drag.elements.tolist() == [0, 1, 2]
    assert drag.path == [(1, 0, 0), ((2, 0, 0), chainmail.Rotation((0, 0, 1), 5))]
