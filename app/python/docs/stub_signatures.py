"""Takes the signatures of the compiled part from its stub, where they have the types that a reader needs."""

import ast
import re
from pathlib import Path

STUB = Path(__file__).resolve().parent.parent / "chainmail" / "_core.pyi"


def functions():
    """Returns the signatures of each function by its name, like `Body.cut`: arguments, and what it returns."""
    found = {}

    def visit(nodes, prefix):
        for node in nodes:
            if isinstance(node, ast.ClassDef):
                visit(node.body, node.name + ".")
            elif isinstance(node, ast.FunctionDef):
                name = prefix + ("" if node.name == "__init__" else node.name)
                found.setdefault(name.rstrip("."), []).append(signature_of(node))

    visit(ast.parse(STUB.read_text(encoding="utf-8")).body, "")
    return found


def signature_of(node):
    arguments = node.args
    if arguments.args and arguments.args[0].arg == "self":
        arguments.args = arguments.args[1:]
    returns = None if node.name == "__init__" else readable(ast.unparse(node.returns))
    return "(" + readable(ast.unparse(arguments)) + ")", returns


def readable(types):
    """Replaces the names that are private to the stub."""
    names = {
        "_IdsLike": "ids",
        "_Ids": "array of uint32",
        "_Reals": "array of float64",
        "_Vector": "vector",
        "_Tuple3": "tuple[float, float, float]",
        "_Path": "path",
        "_Numbers": "float | array | None",
        "_Progress": "function | None",
        "_Precision": "str",
        "_Scheme": "str",
        "_Energy": "str",
        "npt.ArrayLike": "array",
    }
    return re.sub("|".join(map(re.escape, names)), lambda found: names[found[0]], types)


def short(name):
    return re.sub(r"^chainmail\.(_core\.)?", "", name)


def setup(app):
    known = functions()

    def signature(_app, what, name, _object, _options, given, returns):
        found = known.get(short(name))
        if found is None or what not in {"class", "function", "method"}:
            return given, returns
        return found[0] if len(found) == 1 else ("(…)", found[0][1])

    def docstring(_app, _what, name, _object, _options, lines):
        """Removes the signatures that pybind11 writes into docstrings."""
        plain = short(name).split(".")[-1]
        written = re.compile(rf"(\d+\. )?{re.escape(plain)}\(.*\) -> .*$|Overloaded function\.$")
        kept = [line for line in lines if not written.match(line)]
        while kept and not kept[0].strip():
            kept.pop(0)
        lines[:] = kept

    app.connect("autodoc-process-signature", signature)
    app.connect("autodoc-process-docstring", docstring)
    return {"parallel_read_safe": True}
