"""Meshes from and to files."""

import chainmail
import numpy as np
import pytest


@pytest.mark.parametrize("ending", [".obj", ".ply", ".msh"])
def test_written_and_read_again(ending, tmp_path):
    mesh = chainmail.make_cloth(5, 4, spacing=0.1)
    chainmail.write_mesh(tmp_path / f"cloth{ending}", mesh)
    again = chainmail.read_mesh(str(tmp_path / f"cloth{ending}"))
    assert np.array_equal(again.links, mesh.links)
    assert np.allclose(again.rest_positions(), mesh.rest_positions(), atol=1e-6)


def test_a_body_is_written_where_it_is(tmp_path):
    deformer = chainmail.Deformer(chainmail.make_cloth(5, 4))
    deformer.move(0, (-3, -1))
    chainmail.write_mesh(tmp_path / "moved.csv", deformer.body)
    table = np.loadtxt(tmp_path / "moved.csv", delimiter=",", skiprows=1)
    assert np.array_equal(table[:, 1:], deformer.body.positions())


def test_a_lattice_for_files_that_do_not_state_it(tmp_path):
    (tmp_path / "chain.dat").write_text("0 1 1\n1 1 0\n")
    with pytest.raises(chainmail.Error):
        chainmail.read_mesh(tmp_path / "chain.dat")
    mesh = chainmail.read_mesh(tmp_path / "chain.dat", lattice=(2, 1, 1), spacing=3)
    assert mesh.rest_lengths().tolist() == [3]


def test_formats():
    rows = chainmail.file_formats()
    assert {"name", "endings", "content", "reads", "writes", "holds_positions"} == set(rows[0])
    assert any(".obj" in "".join(row["endings"]) or "obj" in row["endings"] for row in rows)
