"""The stubs and the module name the same things."""

import inspect
import os
import re
import subprocess
import sys

import chainmail
import pytest


def test_all_is_all():
    public = {
        name
        for name, value in vars(chainmail).items()
        if not name.startswith("_") and not inspect.ismodule(value)
    }
    assert public | {"__version__"} == set(chainmail.__all__)
    assert list(chainmail.__all__) == sorted(chainmail.__all__)


def test_all_of_the_compiled_part_is_public():
    from chainmail import _core

    assert {name for name in vars(_core) if not name.startswith("_")} <= set(chainmail.__all__)


def test_everything_has_a_docstring():
    for name in set(chainmail.__all__) - {"__version__"}:
        value = getattr(chainmail, name)
        assert (value.__doc__ or "").strip(), name
        if inspect.isclass(value):
            members = [m for m in vars(value) if not m.startswith("_")]
            assert all((getattr(value, m).__doc__ or "").strip() for m in members), name


# The compiled classes have a metaclass of pybind11, and those that only the module makes have an __init__ that refuses.
EXPECTED = re.compile(
    r"inconsistent, (metaclass differs|stub does not have \*args argument \"args\")$|parameter_study\.\w+ is not a "
)


def test_stubs_agree_with_the_module(tmp_path):
    pytest.importorskip("mypy.stubtest")
    environment = {**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(chainmail.__file__))}
    shown = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "chainmail", "--concise"],
        capture_output=True, text=True, cwd=tmp_path, env=environment,
    )  # fmt: skip
    lines = shown.stdout.splitlines()
    assert any("metaclass differs" in line for line in lines), shown.stdout  # it has looked
    assert [line for line in lines if not EXPECTED.search(line)] == [] and shown.stderr == ""


def test_types_of_a_program(tmp_path):
    pytest.importorskip("mypy")
    program = tmp_path / "program.py"
    program.write_text(
        "import chainmail\n"
        "sheet = chainmail.make_cloth(20, 20)\n"
        "deformer = chainmail.Deformer(sheet, 'natural-queue')\n"
        "moved: int = deformer.move(0, (-5, -3)).moved\n"
        "handle = deformer.grab([1, 2])\n"
        "deformer.move(handle, handle.after((1, 0)))\n"
        "deformer.body.cut(3, 4)\n"
        "table = chainmail.study(sheet, ['exact'])\n"
        "wrong: str = deformer.relax(3)\n"
    )
    environment = {**os.environ, "MYPYPATH": os.path.dirname(os.path.dirname(chainmail.__file__))}
    shown = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(program)],
        capture_output=True, text=True, env=environment,
    )  # fmt: skip
    lines = [line for line in shown.stdout.splitlines() if ": error:" in line]
    assert len(lines) == 1 and "program.py:9" in lines[0], shown.stdout
