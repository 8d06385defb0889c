"""Shows pages of the manual, which are Markdown, in Sphinx, which reads reStructuredText.

The directive `.. manual:: NAME` includes resources/manual/NAME.md. It knows what those pages use: headings, paragraphs,
lists, tables, code, and text that is emphasized, code or a link. So the pages need no reader of Markdown.
"""

import re
from pathlib import Path

from docutils import nodes
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

MANUAL = Path(__file__).resolve().parents[3] / "resources" / "manual"
UNDERLINES = {1: "=", 2: "-", 3: "~"}


def inline(text):
    """Returns a text with code, links and emphasis as reStructuredText."""
    parts = re.split(r"(`[^`]+`)", text)
    for at, part in enumerate(parts):
        if part.startswith("`"):
            parts[at] = "`" + part + "`"
        else:
            part = re.sub(r"\[([^]]+)\]\([^)]*\)", r"\1", part)
            parts[at] = part.replace("|", "\\|")
    return "".join(parts)


def table(rows):
    """Returns the rows of a Markdown table as a list table."""
    content = [row for row in rows if not set(row) <= set("|-: ")]
    cells = [[cell.strip() for cell in row.strip().strip("|").split("|")] for row in content]
    lines = [".. list-table::", "   :header-rows: 1", ""]
    for row in cells:
        for at, cell in enumerate(row):
            lines.append(("   * - " if at == 0 else "     - ") + inline(cell))
    return lines + [""]


def is_special(lines, at):
    """True if a line ends a paragraph."""
    return not lines[at].strip() or lines[at].startswith(("#", "```", "|"))


def converted(text):
    """Returns a page as reStructuredText, without its title."""
    lines, out = text.splitlines(), []
    at = 0
    while at < len(lines):
        line = lines[at]
        if heading := re.match(r"(#+) (.*)", line):
            if len(heading[1]) > 1:
                out += [heading[2], UNDERLINES[len(heading[1])] * len(heading[2]), ""]
        elif line.startswith("```"):
            end = next(i for i in range(at + 1, len(lines)) if lines[i].startswith("```"))
            out += [f".. code-block:: {line[3:] if line[3:] else 'text'}", ""]
            out += ["   " + each for each in lines[at + 1 : end]] + [""]
            at = end
        elif line.startswith("    ") and (at == 0 or not lines[at - 1].strip()):
            out += [".. code-block:: text", ""]
            while at < len(lines) and (lines[at].startswith("    ") or not lines[at].strip()):
                out.append("   " + lines[at][4:])
                at += 1
            continue
        elif line.startswith("|"):
            end = next((i for i in range(at, len(lines)) if not lines[i].startswith("|")), len(lines))
            out += table(lines[at:end])
            at = end
            continue
        else:
            end = next((i for i in range(at, len(lines)) if is_special(lines, i)), len(lines))
            out += inline("\n".join(lines[at:end])).splitlines() if end > at else [""]
            at = max(end, at + 1)
            continue
        at += 1
    return out


class Manual(SphinxDirective):
    """The directive `manual`."""

    required_arguments = 1

    def run(self):
        file = MANUAL / (self.arguments[0] + ".md")
        self.env.note_dependency(str(file))
        content = StringList(converted(file.read_text(encoding="utf-8")), source=str(file))
        holder = nodes.section()
        holder.document = self.state.document
        self.state.nested_parse(content, 0, holder, match_titles=1)
        return holder.children


def setup(app):
    app.add_directive("manual", Manual)
    return {"parallel_read_safe": True}
