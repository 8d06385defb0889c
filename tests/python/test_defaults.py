"""The defaults of keywords are those of the C++ structs that they fill, and those that the stubs show."""

import ast
import inspect
import re

import chainmail
import pytest

# Functions, and the structs whose members their keywords are.
FILLED = {
    "relax": ("core/api/chainmail/deformer.h", "RelaxOptions", chainmail.Deformer.relax),
    "calibrate": ("core/api/chainmail/calibrate.h", "CalibrateOptions", chainmail.calibrate),
    "compare": ("core/api/chainmail/compare.h", "CompareOptions", chainmail.compare),
    "ramp": ("core/api/chainmail/ramp.h", "RampOptions", chainmail.ramp),
    "LinkSoftness": ("core/api/chainmail/body.h", "LinkSoftness", chainmail.LinkSoftness.__init__),
    "Elasticity": ("core/api/chainmail/body.h", "Elasticity", chainmail.Elasticity.__init__),
    "make_line": ("core/api/chainmail/mesh.h", "LatticeOptions", chainmail.make_line),
    "make_grid": ("core/api/chainmail/mesh.h", "LatticeOptions", chainmail.make_grid),
    "make_cloth": ("core/api/chainmail/mesh.h", "LatticeOptions", chainmail.make_cloth),
    "make_block": ("core/api/chainmail/mesh.h", "LatticeOptions", chainmail.make_block),
    "make_tetra": ("core/api/chainmail/mesh.h", "LatticeOptions", chainmail.make_tetra),
}
# Keywords that are no member, or have another name there (drags).
ELSEWHERE = {"job", "progress", "folder"}
OWN = {("compare", "drags")}


def value_of(initializer):
    """The value of an initializer of C++, as Python writes it."""
    text = initializer.strip()
    constants = {"": None, "{}": None, "true": True, "false": False}
    constants.update({"Precision::single_precision": "float", "Precision::double_precision": "double"})
    if text in constants:
        return constants[text]
    if "::" in text:
        return text.split("::")[-1].replace("_", "-")
    if text.startswith("{"):
        return tuple(value_of(one) for one in text.strip("{}").split(","))
    if "/" in text:
        above, below = text.split("/")
        return value_of(above) / value_of(below)
    return ast.literal_eval(text.replace("'", "_"))


def defaults_of_struct(header, name):
    text = re.sub(r"//.*", "", header.read_text(encoding="utf-8"))
    body = re.search(rf"\bstruct {name} \{{(.*?)\n\}};", text, re.DOTALL).group(1)
    members = re.findall(r"^\s*[\w:<>, ]+?\s(\w+)(?:\s*=\s*([^;()]*)|(\{[^;]*\}))?;", body, re.MULTILINE)
    return {member: value_of(assigned or braced) for member, assigned, braced in members}


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


def is_same(keyword, member):
    """True for equal values of one kind; nothing and an empty list are equal."""
    if keyword in ([], None) or member is None:
        return keyword in ([], None) and member is None
    return keyword == member and isinstance(keyword, bool) == isinstance(member, bool)


@pytest.mark.parametrize("name", FILLED)
def test_keywords_have_the_defaults_of_the_struct(source, name):
    header, struct, function = FILLED[name]
    members = defaults_of_struct(source / header, struct)
    keywords = defaults_of_function(function)
    assert keywords
    for keyword in sorted(set(keywords) - ELSEWHERE):
        if (name, keyword) not in OWN:
            assert is_same(keywords[keyword], members[keyword]), keyword


def test_stubs_show_these_defaults(source):
    stubs = ast.parse((source / "app" / "python" / "chainmail" / "_core.pyi").read_text(encoding="utf-8"))
    shown = {}
    for node in ast.walk(stubs):
        if isinstance(node, ast.ClassDef):
            shown.update({node.name: one for one in node.body if getattr(one, "name", "") == "__init__"})
        elif isinstance(node, ast.FunctionDef) and node.name in FILLED:
            shown[node.name] = node
    for name, (_, _, function) in FILLED.items():
        keywords, stub = defaults_of_function(function), defaults_in(shown[name])
        assert set(stub) == set(keywords), name
        for keyword, default in stub.items():
            if not (isinstance(default, ast.Constant) and default.value is ...):
                assert is_same(ast.literal_eval(default), keywords[keyword]), (name, keyword)


def test_read_mesh_reads_like_cpp(source):
    members = defaults_of_struct(source / "core/api/chainmail/mesh_file.h", "ReadOptions")
    keywords = inspect.signature(chainmail.read_mesh).parameters
    for name in set(members) - {"import_program"}:
        assert is_same(keywords[name].default, members[name]), name
