"""A drag against the closed form, and against the command line."""

import csv
import json
import subprocess

import chainmail
import numpy as np
import pytest


def positions_of_program(program, folder, mesh, *options):
    out = folder / "positions.csv"
    subprocess.run([program, "deform", mesh, *options, "--positions", out], check=True, capture_output=True)
    with open(out, newline="") as file:
        return np.array([[float(row[axis]) for axis in "xyz"] for row in csv.DictReader(file)])


@pytest.mark.parametrize("to, one, two", [(-1.0, -1 + 1.2, -1 + 1.2 + 1.2), (0.5, 0.5 + 0.8, 0.5 + 0.8 + 0.8)])
def test_a_line_stretches_and_shortens(to, one, two):
    """Each link of rest length 1 may be 0.8 to 1.2 long, and each element moves just far enough."""
    deformer = chainmail.Deformer(chainmail.make_line(3))
    result = deformer.move(0, (to,))
    assert deformer.body.positions().tolist() == [[to, 0, 0], [one, 0, 0], [two, 0, 0]]
    assert (result.moved, result.checked, result.stopped, result.remark) == (2, 2, False, "")
    assert result.reached.pivot == (to, 0, 0)
    assert deformer.moved().tolist() == [1, 2]


def test_a_handle_of_many_equals_the_command_line(program, tmp_path):
    mesh = chainmail.make_tetra(5, 3, 3)
    chainmail.write_mesh(tmp_path / "bar.msh", mesh)
    bar = chainmail.read_mesh(tmp_path / "bar.msh")
    deformer = chainmail.Deformer(bar, "exact", "float")
    handle = deformer.grab(bar.side("right"))
    deformer.move(handle, handle.after((1, 0.5, 0), chainmail.Rotation((1, 0, 0), 30)))
    grab = ",".join(str(element) for element in handle.elements)
    expected = positions_of_program(
        program, tmp_path, tmp_path / "bar.msh", "--algorithm", "exact", "--precision", "float", "--grab", grab,
        "--by", "1,0.5,0",
    )
    deformer.body.reset()
    handle = deformer.grab(bar.side("right"))
    deformer.move(handle, handle.after((1, 0.5, 0)))
    assert np.array_equal(deformer.body.positions(), expected)


@pytest.mark.parametrize("method", ["natural-queue", "exact", "ffd"])
@pytest.mark.parametrize("scheme", ["mean", "link", "equilibrium"])
def test_recorded_moves_end_at_the_same_bits(program, tmp_path, method, scheme):
    """tests/cli/test_one_engine.cpp has the same for the window's thread and for comparisons."""
    chainmail.write_mesh(tmp_path / "bar.msh", chainmail.make_tetra(4, 3, 3))
    bar = chainmail.read_mesh(tmp_path / "bar.msh")
    left, right = (bar.side(side).tolist() for side in ("left", "right"))
    links = [bar.links[link].tolist() for link in (2, 5, 11)]
    until = {"until": 0} if scheme == "equilibrium" else {}
    relax = {"do": "relax", "sweeps": 4, "scheme": scheme, **until}
    moves = [
        {"do": "pin", "elements": left},
        {"do": "grab", "elements": right}, {"do": "drag", "target": [3.5, 1.25, 1]}, relax,
        {"do": "drag", "target": [4.25, 1.5, 0.75]}, relax, {"do": "release"},
        {"do": "cut", "links": links},
        {"do": "grab", "element": right[0]}, {"do": "drag", "target": [5, 0.5, 0.25]}, relax, {"do": "release"},
    ]
    (tmp_path / "moves.json").write_text(json.dumps({"version": 1, "commands": moves}))
    expected = positions_of_program(
        program, tmp_path, tmp_path / "bar.msh", "--algorithm", method, "--script", tmp_path / "moves.json",
        "--energy", "corotated",
    )

    deformer = chainmail.Deformer(bar, method)
    deformer.body.set_energy("corotated")
    deformer.body.pin(left)
    handle = deformer.grab(right)
    for target in [(3.5, 1.25, 1), (4.25, 1.5, 0.75)]:
        deformer.move(handle, chainmail.Pose(target))
        deformer.relax(4, scheme=scheme, until=0)
    deformer.release()
    deformer.body.cut([2, 5, 11])
    deformer.move(right[0], (5, 0.5, 0.25))
    deformer.relax(4, scheme=scheme, until=0)
    assert np.array_equal(deformer.body.positions(), expected)


def test_errors_are_those_of_the_command_line(program, tmp_path):
    file = tmp_path / "missing.obj"
    shown = subprocess.run([program, "info", file], capture_output=True, text=True)
    with pytest.raises(chainmail.Error) as raised:
        chainmail.read_mesh(file)
    assert shown.stderr == f"chainmail: {raised.value}\n"
    error = raised.value
    assert str(error) == f"{error.where}: {error.problem}; {error.remedy}"
