"""The text of a C++ source as faults see it: code without strings and comments, its statements, values and lists.

It relies on the format of this project's sources: spaces around binary operators, and braces around every block.
"""

import collections
import re

TOKEN = re.compile(r"""
    (?P<number>\b\d[\w.']*)
  | (?P<string>R"(?P<mark>[^()\s\\]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#(?:[^\n]*\\\n)*[^\n]*)
  """, re.VERBOSE | re.DOTALL | re.MULTILINE)
# Empty braces are a value, unless they are the body of a function.
EMPTY_VALUE = re.compile(
    r"(?<=[\w>])(?<!const)(?<!override)(?<!noexcept)\{\}|(?<=[=(,>?:] )\{\}|(?<=return )\{\}|(?<=\()\{\}")
LABELS = re.compile(
    r"\s*(?:(?:case [\w:'\"]+|default|public|protected|private|signals|public slots|private slots):(?!:)\s*)*")
OTHER_STATEMENT = re.compile(
    r"(?:using|namespace|template|static_assert|friend|typedef|class|struct|enum|union|concept|extern|throw|goto|if"
    r"|else|while|do|for|switch|case|break|continue|delete|co_\w+|assert|Q_\w+)\b"
    r"|.*\b(?:constexpr|operator|requires)\b", re.DOTALL)
RETURN = re.compile(r"return\s+")
ASSIGNMENT = re.compile(r" [-+*/%|&^]?= ")
CALL_OR_ASSIGNMENT = re.compile(
    r"(?:\+\+|--)[\w.>\[\]-]+$|(?:emit )?[\w.>:\[\]()*-]+(?:\(.*\)| [-+*/%|&^]?=\s.*)$", re.DOTALL)

Span = collections.namedtuple("Span", "form start end")  # form: "statement", "value" or "condition"
Elements = collections.namedtuple("Elements", "opener before spans")  # a list in parentheses or braces


def blank(text):
    return re.sub(r"[^\n]", " ", text)


def without_comments(text):
    """Returns the text with comments and directives replaced by as many spaces."""
    return TOKEN.sub(lambda m: blank(m.group()) if m["comment"] or m["directive"] else m.group(), text)


def code_only(text):
    """Returns the text with strings replaced too. A directive ends with a semicolon, so that it divides statements."""
    def replaced(match):
        if match["comment"]:
            return blank(match.group())
        if match["directive"]:
            return blank(match.group())[:-1] + ";"
        if match["string"]:
            return '"' + re.sub(r"[^\n]", "_", match.group())[1:-1] + '"'
        return match.group()

    return EMPTY_VALUE.sub("@@", TOKEN.sub(replaced, text))


def closing(code, start):
    """Returns the position of the bracket that closes the one at `start`; the end of the code if none does."""
    depth = 0
    for at in range(start, len(code)):
        depth += (code[at] in "([{") - (code[at] in ")]}")
        if depth == 0:
            return at
    return len(code)


def divided(code, start, end, separator):
    """Returns the ranges between the separators that are not inside brackets."""
    ranges, depth, begin = [], 0, start
    for at in range(start, end):
        depth += (code[at] in "([{") - (code[at] in ")]}")
        if depth == 0 and code[at] == separator:
            ranges.append((begin, at))
            begin = at + 1
    return ranges + [(begin, end)]


def trimmed(code, start, end):
    text = code[start:end]
    return start + len(text) - len(text.lstrip()), end - len(text) + len(text.rstrip())


def simple_statements(code):
    """Yields the ranges of the statements without blocks, without labels and semicolon."""
    brackets, start = [], 0
    for at, character in enumerate(code):
        if character in "([{":
            brackets.append(character)
        elif character in ")]}" and brackets:
            brackets.pop()
        if character == ";" and (not brackets or brackets[-1] == "{"):
            yield trimmed(code, LABELS.match(code, start).end(), at)
        if character in "{}" or (character == ";" and (not brackets or brackets[-1] == "{")):
            start = at + 1


def spans_of_statement(code, start, end):
    """Returns the statement itself, if it can be skipped, or the value that it returns or gives a new name."""
    statement = code[start:end]
    if not re.match(r"[\w:*(+-]", statement) or OTHER_STATEMENT.match(statement):
        return []
    if match := RETURN.match(statement):
        return [Span("value", start + match.end(), end)]
    if CALL_OR_ASSIGNMENT.match(statement):
        return [Span("statement", start, end)]
    assigned = ASSIGNMENT.search(statement)
    if assigned and assigned.group() == " = " and "(" not in statement[:assigned.start()]:
        value = divided(code, start + assigned.end(), end, ",")[0]  # of the first name
        return [Span("value", *trimmed(code, *value))]
    return []


def conditions(code):
    """Yields the conditions of if, while and for, and the first values of for."""
    for match in re.finditer(r"\b(if|while|for) \(", code):
        parts = divided(code, match.end(), closing(code, match.end() - 1), ";")
        wanted = parts[-1:]
        if match.group(1) == "for":
            wanted = parts[1:2]
            yield from spans_of_statement(code, *trimmed(code, *parts[0])) if len(parts) == 3 else []
        for part in wanted:
            start, end = trimmed(code, *part)
            if start < end and not ASSIGNMENT.search(code, start, end):
                yield Span("condition" if match.group(1) == "if" else "value", start, end)


def spans(code):
    """Returns the places where the code can choose between two statements or between two values."""
    found = [span for statement in simple_statements(code) for span in spans_of_statement(code, *statement)]
    return found + list(conditions(code))


def lists(code):
    """Yields the lists of arguments, and of values in braces, that have two elements or more."""
    for match in re.finditer(r"(\w+)\(|[\w=(,>{]\s*(\{)", code):
        opener = match.end() - 1
        end = closing(code, opener)
        if match.group(1) in ("if", "for", "while", "switch", "sizeof", "decltype", "catch") or ";" in code[opener:end]:
            continue
        if match.group(2) and re.search(r"\benum\b[^;{}]*$", code[:opener]):
            continue
        elements = divided(code, opener + 1, end, ",")
        if len(elements) > 1:
            yield Elements(code[opener], match.group(1) or "", [trimmed(code, *element) for element in elements])
