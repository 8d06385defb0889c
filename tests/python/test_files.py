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


def test_samples_open(source):
    for file in sorted((source / "meshes").glob("*.*")):
        if file.suffix in {".dat", ".obj", ".ply", ".msh"}:
            assert chainmail.read_mesh(file).element_count > 0


@pytest.mark.parametrize(
    "name, text, words",
    [
        ("a.obj", "v 0 0 0\nv 1 0 nan\nl 1 2\n", "a.obj:2"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nl 1 5\n", "a.obj:3"),
        ("a.dat", "0 1 7\n", "a.dat"),
        ("a.unknown", "what is this", "a.unknown"),
        ("a.msh", "$MeshFormat\n4.1 0 8\n", "a.msh"),
    ],
)
def test_damaged_files(name, text, words, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(chainmail.Error) as raised:
        chainmail.read_mesh(tmp_path / name)
    assert words in str(raised.value) and "\n" not in str(raised.value)


def test_a_lattice_for_files_that_do_not_state_it(tmp_path):
    (tmp_path / "chain.dat").write_text("0 1 1\n1 1 0\n")
    with pytest.raises(chainmail.Error):
        chainmail.read_mesh(tmp_path / "chain.dat")
    mesh = chainmail.read_mesh(tmp_path / "chain.dat", lattice=(2, 1, 1), spacing=3)
    assert mesh.rest_lengths().tolist() == [3]


def test_unknown_ending(tmp_path):
    with pytest.raises(chainmail.Error, match="cloth.xyz"):
        chainmail.write_mesh(tmp_path / "cloth.xyz", chainmail.make_cloth(3, 3))
    assert not (tmp_path / "cloth.xyz").exists()


def test_formats():
    rows = chainmail.file_formats()
    assert {"name", "endings", "content", "reads", "writes", "holds_positions"} == set(rows[0])
    assert any(".obj" in "".join(row["endings"]) or "obj" in row["endings"] for row in rows)
