"""The pages: their examples run, and Sphinx makes them without warnings."""

import doctest
import re
import subprocess
import sys

import chainmail
import pytest


def pages(source):
    return [source / "resources" / "manual" / "python.md", *sorted((source / "app" / "python" / "docs").glob("*.rst"))]


def test_examples_of_the_pages(source):
    tried = 0
    for page in pages(source):
        result = doctest.testfile(str(page), module_relative=False, encoding="utf-8", optionflags=doctest.ELLIPSIS)
        assert result.failed == 0, page
        tried += result.attempted
    assert tried > 30


def test_every_public_name_is_in_the_reference(source):
    text = "".join(page.read_text(encoding="utf-8") for page in pages(source)[1:])
    named = set(re.findall(r"^\.\. auto(?:class|function|exception):: (\w+)$", text, re.MULTILINE))
    assert named == set(chainmail.__all__) - {"__version__"}


def test_softness_says_its_limits():
    """The errors of numbers beyond the limits name these, too."""
    assert chainmail.LinkSoftness.compression.__doc__.endswith(". From 0.0 to 1.0.")
    assert chainmail.LinkSoftness.exponent.__doc__.endswith(". From -4.0 to 4.0.")
    assert chainmail.LinkSoftness.stretch.__doc__.endswith(". From 1.0.")  # it has no upper limit


def test_sphinx_has_no_warnings(source, tmp_path):
    pytest.importorskip("sphinx")
    shown = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "-d", tmp_path / "trees",
         source / "app" / "python" / "docs", tmp_path / "html"],
        capture_output=True, text=True,
    )  # fmt: skip
    assert (shown.stderr, shown.returncode) == ("", 0)
    page = (tmp_path / "html" / "index.html").read_text(encoding="utf-8")
    assert "A first drag" in page and "<table" in page
