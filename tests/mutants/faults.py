"""The kinds of faults, and the places of a source that can have them.

The patterns propose; the compiler refuses. A proposal that does not compile, such as two arguments of different types
that change places, is left out by the build.
"""

import collections
import re

import source_text

# Operators: kind, pattern, replacement.
OPERATORS = [
    ("comparison", r" < ", " <= "), ("comparison", r" <= ", " < "),
    ("comparison", r" > ", " >= "), ("comparison", r" >= ", " > "),
    ("comparison", r" == ", " != "), ("comparison", r" != ", " == "),
    ("arithmetic", r" \+ ", " - "), ("arithmetic", r" - ", " + "),
    ("arithmetic", r" \* ", " / "), ("arithmetic", r" / ", " * "),
    ("arithmetic", r" \+= ", " -= "), ("arithmetic", r" -= ", " += "),
    ("arithmetic", r"\bmin\(", "max("), ("arithmetic", r"\bmax\(", "min("),
    ("arithmetic", r"\+\+", "--"),
    ("logic", r" && ", " || "), ("logic", r" \|\| ", " && "),
    ("logic", r"\btrue\b", "false"), ("logic", r"\bfalse\b", "true"),
]
NUMBER = re.compile(r"(?<![\w.'])(\d+)(?![\w.'>])")
REAL = re.compile(r"(?<![\w.'])(\d+\.\d+)(?![\w.'])")
# Code without behaviour that a test could check: memory hints, layout.
PASSED_OVER = re.compile(
    r"\b(?:assert|reserve|prefetch|shrink_to_fit|setSpacing|setContentsMargins|\w*Margins?|static_cast<void>)\b")
# Statements of state. All other calls and assignments are of the kind "statement".
SIGNAL = re.compile(r"emit |(?:[\w:]+::)?connect\([^,]*, &")
STATE = re.compile(
    r"(?:\+\+|--)?\w*revision|\w*(?:made_for|seen|outdated|dirty|stale)\w* [-+]?="
    r"|[\w:()\[\].>-]*?\b(?:reset|clear|forget|invalidate|drop|discard|abandon|cancel|end|erase|remove|refresh|update"
    r"|stop|release|wake|fall_asleep)\w*\("
    r"|[\w.>-]+_(?:[.>-]\w+)* = (?:@@|[\w:]+@@|[\w:]+\(\)|nullptr|std::nullopt|true|false|0)$")
RESET = re.compile(STATE.pattern + r"|[\w.>-]+_ = ")  # what a second event finds as the first one left it
COPY = re.compile(r"[\w\])>_]+(?:\.|->)[\w.\[\]>-]+ = ")
CHECK = re.compile(r" [!=]= |[Rr]evision|made_for|seen_|outdated|stale")
OPTION = re.compile(
    r"(?<![\w.>])(\w*(?:ptions|ettings|hoices|arameters)_?)(?:\.|->)(\w+)\b"
    r"(?!\(|\s*[-+*/|]?= |\.\w+ = |[.]\w+_back|\[[^]]*\] = )")  # a call, or a new value
SIMPLE = re.compile(r"[\w.:>\[\]-]+(?:\(\))?$")
NAME = re.compile(r"(?!this\b|true\b|false\b|nullptr\b|\d)[\w.>-]+(?:\(\))?$|std::move\(\w+\)$")
INITIALISER = re.compile(
    r"(?:^\s+(?:: )?|\) : |, )(\w+_)\(((?:std::move\()?[\w.>-]+\)?)\)(?=,| \{|\s*@@)", re.MULTILINE)
WORD = re.compile(r"\w+|[^\w\s]")
# A name of one boolean, or of a member of a struct of them.
FLAG = re.compile(r"\w+_$|(?P<owner>\w+)(?:\.|->)\w+$")
FUNCTION = re.compile(r"\)(?: const| noexcept| override)* \{\n(?=  \S)")
REFUSAL = re.compile(r"  ((?:check|refuse)\w*\([^;]*\);|if \([^{}]*\) \{\n    throw [^;]*;\n  \})\n")
SYMMETRIC = ("min", "max", "swap", "hypot", "fuzzyCompare", "isApprox", "equal")

# In a file, the text from `start` to `end` becomes `text`, where @FAULT@ stands for the number of the fault.
Fault = collections.namedtuple("Fault", "path line kind start end text before after")


class Source:
    """A file in which faults are looked for."""

    def __init__(self, path, text):
        self.path = path
        self.text = text
        self.plain = source_text.without_comments(text)
        self.code = source_text.code_only(text)

    def one_line(self, start, end):
        return re.sub(r"\s*\n\s*", " ", self.plain[start:end])

    def fault(self, kind, start, end, text, before, after):
        line = self.text.count("\n", 0, start) + 1
        return Fault(self.path, line, kind, start, end, text, before, after)

    def in_line(self, span):
        """Returns what stands before a span in its line."""
        return self.plain[self.plain.rfind("\n", 0, span.start) + 1:span.start].lstrip()

    def changed(self, kind, span, start, end, replacement):
        """Returns the fault that replaces a part of a span: a statement or a value."""
        faulty = self.one_line(span.start, start) + replacement + self.one_line(end, span.end)
        original = self.text[span.start:span.end]
        if span.form == "statement":
            text = f"if (chainmail_fault(@FAULT@)) {{ {faulty}; }} else {{ {original}; }}"
        else:
            text = f"(chainmail_fault(@FAULT@) ? ({faulty}) : ({original}))"
        before, whole = self.in_line(span), self.one_line(span.start, span.end)
        return self.fault(kind, span.start, span.end, text, before + whole, before + faulty)

    def skipped(self, kind, span):
        text = f"if (!chainmail_fault(@FAULT@)) {{ {self.text[span.start:span.end]}; }}"
        return self.fault(kind, span.start, span.end, text, self.one_line(span.start, span.end), "(skipped)")


def operators(source, span):
    code = source.code[span.start:span.end]
    for kind, pattern, replacement in OPERATORS:
        if kind != "arithmetic" or '"' not in code:  # there it joins strings
            for match in re.finditer(pattern, code):
                yield source.changed(kind, span, span.start + match.start(), span.start + match.end(), replacement)


def numbers(source, span):
    for pattern, next_value in (NUMBER, lambda text: int(text) + 1), (REAL, lambda text: 2 * float(text) or 1.0):
        for match in pattern.finditer(source.code, span.start, span.end):
            yield source.changed("number", span, match.start(), match.end(), str(next_value(match.group())))


def negation(source, span):
    if span.form == "condition":
        yield source.changed("logic", span, span.start, span.end, f"!({source.one_line(span.start, span.end)})")


def operand_end(code, start, end):
    """Returns where the operand of a logical operator ends."""
    depth = 0
    for at in range(start, end):
        depth += (code[at] in "([{") - (code[at] in ")]}")
        if depth < 0 or (depth == 0 and (code[at] in "?,;" or code.startswith((" && ", " || ", " : "), at))):
            return at
    return end


def terms(source, span):
    """Drops a term of a comparison or of a condition of several."""
    for match in re.finditer(r"\s(?:&&|\|\|)\s+", source.code[span.start:span.end]):
        start, after = span.start + match.start(), span.start + match.end()
        yield source.changed("term", span, start, operand_end(source.code, after, span.end), "")
    first = re.match(r"(.* = )?([^&|?,]*? && )", source.code[span.start:span.end])
    if first and first[2].count("(") == first[2].count(")"):
        yield source.changed("term", span, span.start + first.start(2), span.start + first.end(2), "")


def check(source, span):
    """Skips a block that depends on a comparison."""
    if span.form == "condition" and CHECK.search(source.code, span.start, span.end):
        yield source.changed("check", span, span.start, span.end, "false")


def removal(source, span):
    """Skips a statement."""
    if span.form == "statement":
        code = source.code[span.start:span.end]
        kinds = [("signal", SIGNAL), ("state", STATE), ("copy", COPY), ("statement", re.compile(""))]
        yield source.skipped(next(kind for kind, pattern in kinds if pattern.match(code)), span)


def again(source, span):
    """Skips a reset from the second time on."""
    if span.form == "statement" and RESET.match(source.code[span.start:span.end]):
        statement = source.text[span.start:span.end]
        text = f"if (!chainmail_fault_again(@FAULT@)) {{ {statement}; }}"
        before = source.one_line(span.start, span.end)
        yield source.fault("again", span.start, span.end, text, before, "(skipped the second time)")


def are_alike(one, other):
    """True if two statements have the same words, except one word in place of another."""
    words, others = WORD.findall(one), WORD.findall(other)
    pairs = set(zip(words, others))
    return (len(words) == len(others) and sum(a != b for a, b in pairs) == 1
            and any(a == b and a[0].isalpha() for a, b in pairs))


def homes(source):
    """Skips one of two statements that do the same for two members or two panels."""
    ranges = [one for one in source_text.simple_statements(source.code)
              if source_text.CALL_OR_ASSIGNMENT.match(source.code[slice(*one)])]
    for one, other in zip(ranges, ranges[1:]):
        if (source.code[one[1]:other[0]].strip() == ";"
                and are_alike(source.plain[slice(*one)], source.plain[slice(*other)])):
            for start, end in one, other:
                yield source.skipped("home", source_text.Span("statement", start, end))


def implications(source):
    """Lets another boolean of the same owner imply the one of a condition."""
    flags = [(span, match) for span in source_text.conditions(source.code)
             if span.form == "condition" and (match := FLAG.match(source.code[span.start:span.end]))]
    for (one, match), (other, neighbour) in [*zip(flags, flags[1:]), *zip(flags[1:], flags)]:
        if match["owner"] == neighbour["owner"] and match.group() != neighbour.group():
            yield source.changed("implication", one, one.end, one.end, f" || {neighbour.group()}")


def late_refusals(source):
    """Moves a check at the start of a function behind its work."""
    for function in FUNCTION.finditer(source.code):
        at = function.end()
        while refusal := REFUSAL.match(source.code, at):
            start, at = refusal.start(1), refusal.end()
            text = f"const ChainmailLate late_@FAULT@(@FAULT@, [&] {{ {source.text[start:refusal.end(1)]} }});"
            before = source.one_line(start, refusal.end(1))
            yield source.fault("refusal", start, refusal.end(1), text, before, "(at the end) " + before)


def swaps(source, elements):
    """Lets two neighbours of a list change places."""
    if elements.before in SYMMETRIC:
        return
    for (start, middle), (after, end) in zip(elements.spans, elements.spans[1:]):
        one, two = source.plain[start:middle], source.plain[after:end]
        if SIMPLE.match(source.code[start:middle]) and SIMPLE.match(source.code[after:end]) and one != two:
            text = f"chainmail_swapped(@FAULT@, {one}, {two}), chainmail_swapped(@FAULT@, {two}, {one})"
            before = elements.before + elements.opener
            yield source.fault("swap", start, end, text, f"{before}…{one}, {two}…", f"{before}…{two}, {one}…")


def member(source, start, end, before):
    """Leaves a member out of a copy: it gets the value that its type has without one."""
    name = source.plain[start:end]
    text = f"chainmail_or_empty(@FAULT@, {name})"
    return source.fault("member", start, end, text, f"{before}{name}", f"{before}(nothing)")


def members(source, elements):
    if elements.opener == "{":
        for start, end in elements.spans:
            if NAME.match(source.code[start:end]):
                yield member(source, start, end, "{…")


def initialisers(source):
    for match in INITIALISER.finditer(source.code):
        if NAME.match(match.group(2)):
            yield member(source, match.start(2), match.end(2), match.group(1) + "(")


def options(source):
    """Ignores an option: reads what it has if nobody sets it."""
    for match in OPTION.finditer(source.code):
        owner = match.group(1) if match.group().startswith(match.group(1) + ".") else "*" + match.group(1)
        ignored = f"chainmail_default<std::remove_cvref_t<decltype({owner})>>.{match.group(2)}"
        text = f"(chainmail_fault(@FAULT@) ? {ignored} : {match.group()})"
        yield source.fault("option", match.start(), match.end(), text, match.group(), "its default")


def faults_of(path, text):
    """Returns all faults that a source can have."""
    source, found = Source(path, text), []
    for span in source_text.spans(source.code):
        if not PASSED_OVER.search(source.code, span.start, span.end):
            for proposals in (operators, numbers, negation, terms, check, removal, again):
                found += proposals(source, span)
    for elements in source_text.lists(source.code):
        found += [*swaps(source, elements), *members(source, elements)]
    for proposals in (initialisers, options, homes, implications, late_refusals):
        found += proposals(source)
    return found
