"""The page of the manual: its examples run. Every public name has a docstring."""

import doctest

import chainmail


def test_examples_of_the_page(source):
    page = source / "resources" / "manual" / "python.md"
    result = doctest.testfile(str(page), module_relative=False, encoding="utf-8", optionflags=doctest.ELLIPSIS)
    assert result.failed == 0
    assert result.attempted > 25


def text_of(name, documented):
    """Returns a docstring without the signature, which pybind11 writes before it."""
    doc = documented.__doc__ or ""
    return doc.partition("\n")[2].strip() if doc.startswith(name + "(") else doc


def test_every_public_name_has_a_docstring():
    assert text_of("bare", type("bare", (), {"__doc__": "bare(x: int) -> int\n"})) == ""
    names = [name for name in chainmail.__all__ if name != "__version__"]
    assert [name for name in names if not text_of(name, getattr(chainmail, name))] == []


def test_settings_say_their_limits():
    """The errors of numbers beyond the limits name these, too."""
    assert chainmail.LinkSoftness.compression.__doc__.endswith(". Range: 0 to 1 (of rest length).")
    assert ". Range: -4 to 4 (" in chainmail.LinkSoftness.exponent.__doc__
    assert ". Range: 1 or more (" in chainmail.LinkSoftness.stretch.__doc__
    assert ". Range: 0 to below 0.5 (" in chainmail.Elasticity.poisson.__doc__
    assert chainmail.Elasticity.law.__doc__.endswith(". One of `neo-hookean`, `gent`, `fung`.")
