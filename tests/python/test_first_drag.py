"""A drag against the closed form, and against the command line."""

import csv
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


def test_errors_are_those_of_the_command_line(program, tmp_path):
    file = tmp_path / "missing.obj"
    shown = subprocess.run([program, "info", file], capture_output=True, text=True)
    with pytest.raises(chainmail.Error) as raised:
        chainmail.read_mesh(file)
    assert shown.stderr == f"chainmail: {raised.value}\n"
    error = raised.value
    assert str(error) == f"{error.where}: {error.problem}; {error.remedy}"
