"""The page of the manual: its examples run. Every public name has a docstring."""

import doctest

import chainmail


def test_examples_of_the_page(source):
    page = source / "resources" / "manual" / "python.md"
    result = doctest.testfile(str(page), module_relative=False, encoding="utf-8", optionflags=doctest.ELLIPSIS)
    assert result.failed == 0
    assert result.attempted > 25


def test_every_public_name_has_a_docstring():
    assert [name for name in chainmail.__all__ if name != "__version__" and not getattr(chainmail, name).__doc__] == []


def test_softness_says_its_limits():
    """The errors of numbers beyond the limits name these, too."""
    assert chainmail.LinkSoftness.compression.__doc__.endswith(". From 0.0 to 1.0.")
    assert chainmail.LinkSoftness.exponent.__doc__.endswith(". From -4.0 to 4.0.")
    assert chainmail.LinkSoftness.stretch.__doc__.endswith(". From 1.0.")  # it has no upper limit
