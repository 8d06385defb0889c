"""The defaults of keywords are those that the stubs show."""

import ast
import re

import chainmail

# The compiled functions with defaults, which are those of the C++ structs that they fill.
FILLED = {
    "relax": chainmail.Deformer.relax,
    "calibrate": chainmail.calibrate,
    "compare": chainmail.compare,
    "ramp": chainmail.ramp,
    "LinkSoftness": chainmail.LinkSoftness.__init__,
    "Elasticity": chainmail.Elasticity.__init__,
    "make_line": chainmail.make_line,
    "make_grid": chainmail.make_grid,
    "make_cloth": chainmail.make_cloth,
    "make_block": chainmail.make_block,
    "make_tetra": chainmail.make_tetra,
}


def defaults_in(definition):
    """The keywords with a default in a parsed function."""
    arguments = definition.args
    named = [*zip(arguments.args[::-1], arguments.defaults[::-1]), *zip(arguments.kwonlyargs, arguments.kw_defaults)]
    return {one.arg: default for one, default in named if default is not None}


def defaults_of_function(function):
    call = function.__doc__.splitlines()[0]
    # An object of a class, like LinkSoftness(stretch=1.2), has the defaults of the class, which are tested on their own.
    literal = re.sub(r"= [A-Z]\w+\([^)]*\)", "= None", call)
    defaults = defaults_in(ast.parse(f"def {literal}: ...").body[0])
    return {name: ast.literal_eval(default) for name, default in defaults.items()}


def is_same(keyword, other):
    """True for equal values of one kind; nothing and an empty list are equal."""
    if keyword in ([], None) or other is None:
        return keyword in ([], None) and other is None
    return keyword == other and isinstance(keyword, bool) == isinstance(other, bool)


def test_stubs_show_these_defaults(source):
    stubs = ast.parse((source / "app" / "python" / "chainmail" / "_core.pyi").read_text(encoding="utf-8"))
    shown = {}
    for node in ast.walk(stubs):
        if isinstance(node, ast.ClassDef):
            shown.update({node.name: one for one in node.body if getattr(one, "name", "") == "__init__"})
        elif isinstance(node, ast.FunctionDef) and node.name in FILLED:
            shown[node.name] = node
    for name, function in FILLED.items():
        keywords, stub = defaults_of_function(function), defaults_in(shown[name])
        assert set(stub) == set(keywords), name
        for keyword, default in stub.items():
            if not (isinstance(default, ast.Constant) and default.value is ...):
                assert is_same(ast.literal_eval(default), keywords[keyword]), (name, keyword)
