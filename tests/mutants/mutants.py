#!/usr/bin/env python3
"""Puts random single-line faults ("mutants") into copies of the source and reports which of them the tests catch.

`tests/run mutants` starts it after the release build with tests, and it asks ctest of that build for the tests. Each
worker has a copy of the source. It changes one line there, builds and runs the related tests one after another, and
stops at the first one that fails. A mutant that does not compile is replaced by another one.

Related tests are those that include the header of the changed file, the most specific first, and then all tests of
its room. A test counts as failing only if it fails twice.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import threading
import time

# The rooms that get faults, and the folders of tests that run for them.
ROOMS = {
    "core/mesh": ["core", "files"],
    "core/elastic": ["core"],
    "core/solve": ["core", "hard"],
    "core/measure": ["core"],
    "core/simulate": ["core"],
    "core/report": ["core", "cli"],
    "core/calibrate": ["core", "cli"],
    "core/bullet": ["core"],
    "core/api": ["core", "cli"],
    "core/files": ["files", "cli"],
    "app": ["cli"],
    "ui": ["ui"],
}

# Each operator: its name, a pattern, and the replacement. Binary operators have spaces around them in this source, but
# templates and pointers do not.
SWAPS = [
    ("comparison", r" < ", " <= "), ("comparison", r" <= ", " < "),
    ("comparison", r" > ", " >= "), ("comparison", r" >= ", " > "),
    ("equality", r" == ", " != "), ("equality", r" != ", " == "),
    ("arithmetic", r" \+ ", " - "), ("arithmetic", r" - ", " + "),
    ("arithmetic", r" \* ", " / "), ("arithmetic", r" / ", " * "),
    ("assignment", r" \+= ", " -= "), ("assignment", r" -= ", " += "),
    ("logic", r" && ", " || "), ("logic", r" \|\| ", " && "),
    ("boolean", r"\btrue\b", "false"), ("boolean", r"\bfalse\b", "true"),
    ("bound", r"\bmin\(", "max("), ("bound", r"\bmax\(", "min("),
    ("step", r"\+\+", "--"), ("negation", r"\bif \((?=[^;]*\) \{$)", "if (!"),
]
NUMBER = re.compile(r"(?<![\w.'])(\d+)(?![\w.'>])")
REAL = re.compile(r"(?<![\w.'])(\d+\.\d+)(?![\w.'])")
# Named constants are choices, like a waiting time or a size on the screen. A slightly different value is not wrong.
NAMED_CONSTANT = re.compile(r"^\s*(static |inline )*constexpr \w[\w:<>, ]* \w+ = [^;]*;")
STATEMENT = re.compile(r"^\s+[\w.>\-\[\]]+(\(.*\)| [+\-*/]?= .*);$")
# Lines without behaviour that a test could check: declarations, compile-time checks, memory hints, layout.
PASSED_OVER = re.compile(
    r"^\s*(#|//|using |namespace |template |static_assert|assert\(|friend |class |struct |enum |case .*:$|public:|private:)"
    r"|reserve\(|prefetch|shrink_to_fit|setSpacing|setContentsMargins|Margin|static_cast<void>|NOLINT|operator")

Mutant = collections.namedtuple("Mutant", "path line operator before after")


def code_only(line):
    """Returns the line with strings, characters and comments replaced by the same number of other characters."""
    blank = lambda match: " " * len(match.group())
    line = re.sub(r'"(\\.|[^"\\])*"|(?<!\d)\'(\\.|[^\'\\])\'', lambda m: '"' + "_" * (len(m.group()) - 2) + '"', line)
    return re.sub(r"//.*", blank, line)


def mutants_of(path, number, line):
    """Returns all faults that the operators can put into one line."""
    code = code_only(line)
    if PASSED_OVER.search(code):
        return []
    found = []

    def add(operator, start, end, text):
        found.append(Mutant(path, number, operator, line, line[:start] + text + line[end:]))

    for operator, pattern, text in SWAPS:
        if operator == "arithmetic" and '"' in code:
            continue  # the operator joins strings
        for match in re.finditer(pattern, code):
            if operator == "negation":
                add(operator, match.start(), len(line), "if (!(" + line[match.end():-3] + ")) {")
            else:
                add(operator, match.start(), match.end(), text)
    if not NAMED_CONSTANT.match(code):
        for match in NUMBER.finditer(code):
            add("number", match.start(), match.end(), str(int(match.group()) + 1))
        for match in REAL.finditer(code):
            add("number", match.start(), match.end(), str(2 * float(match.group()) or 1.0))
    if STATEMENT.match(code) and not line.lstrip().startswith(("return", "throw")):
        found.append(Mutant(path, number, "statement", line, ""))
    return found


def source_files(root):
    """Returns all files of the project. It does not use git, so that it works in an export too."""
    files = []
    for folder, folders, names in os.walk(root):
        inside = pathlib.Path(folder).relative_to(root)
        folders[:] = [name for name in folders if name not in (".git", "build", "__pycache__")]
        files += [str(inside / name) for name in names if (root / inside / name).is_file()]
    return files


def room_of(path):
    return next((room for room in ROOMS if path.startswith(room + "/")), None)


def is_candidate(path, wanted):
    # Only the headers of core/solve contain templates; other headers contain declarations.
    is_source = path.endswith(".cpp") or (path.endswith(".h") and path.startswith("core/solve/"))
    return is_source and room_of(path) and any(path == w or path.startswith(w.rstrip("/") + "/") for w in wanted)


def draw(root, wanted, generator):
    """Yields mutants: a random fault in each line that can have one, in random order of the lines."""
    lines = []
    for path in sorted(filter(lambda p: is_candidate(p, wanted), source_files(root))):
        for number, line in enumerate((root / path).read_text().split("\n")):
            if found := mutants_of(path, number, line):
                lines.append(found)
    generator.shuffle(lines)
    for found in lines:
        yield generator.choice(found)


def included(root, source):
    """Returns the files of the project that a source includes, directly or not."""
    found, waiting = set(), [source]
    while waiting:
        file = waiting.pop()
        for name in re.findall(r'^#include "([^"]+)"', (root / file).read_text(), re.M):
            places = [str(pathlib.Path(file).parent), "tests", "core", "ui", "app"]
            path = next((os.path.normpath(f"{place}/{name}") for place in places if (root / place / name).is_file()), None)
            if path and path not in found:
                found.add(path)
                waiting.append(path)
    return found


class Tests:
    """The tests of the release build, with the files that each includes and the time that it takes."""

    def __init__(self, root, most):
        build = root / "build/release"
        self.most = most
        self.includes = {}  # per test: the files of the project that its source includes
        self.folder = {}
        self.program = {}  # per test: the target that contains it
        shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True, text=True).stdout
        for test in json.loads(shown)["tests"] if shown else []:
            self.add(root, test)
        if not self.includes:
            sys.exit("mutants: the release build has no tests; start it with tests/run mutants")
        self.seconds = collections.defaultdict(lambda: 12.0)  # default until the time is known
        costs = build / "Testing/Temporary/CTestCostData.txt"
        for line in costs.read_text().splitlines() if costs.exists() else []:
            if match := re.match(r"(\S+) (\d+) ([\d.]+)$", line):
                if int(match.group(2)):
                    self.seconds[match.group(1)] = float(match.group(3))

    def add(self, root, test):
        """Notes a test that is a class of Qt Test: ctest starts a program test_… with the name of the class, if it has
        several."""
        words = [pathlib.Path(word).name for word in test.get("command", [])]
        program = next((word for word in words if word.startswith("test_")), None)
        folder = next(pathlib.Path(p["value"]).name for p in test["properties"] if p["name"] == "WORKING_DIRECTORY")
        if not program or folder == "python":
            return
        name = (words[words.index(program) + 1:] or [program.removeprefix("test_")])[0]
        source = next((file for file in (f"tests/{folder}/test_{name}.cpp", f"tests/{folder}/{name}.cpp")
                       if (root / file).exists()), None)
        if source:
            self.includes[test["name"]] = included(root, source)
            self.folder[test["name"]] = folder
            self.program[test["name"]] = program

    def related(self, path):
        """Returns the tests for a file, specific and fast ones first: those with its header, then those of its room.

        There are at most `most` of them.
        """
        header = re.sub(r"\.cpp$", ".h", path)
        words = set(re.findall(r"[a-z]+", pathlib.Path(path).stem))
        folders = ROOMS[room_of(path)]

        def key(name):
            includes = header in self.includes[name]
            alike = len(words & set(name.replace("window_", "").split("_")))
            return (-alike, not includes, self.seconds[name] * (1 + len(self.includes[name]) / 100))

        return sorted((n for n in self.includes if self.folder[n] in folders
                       or (header in self.includes[n] and self.folder[n] not in ("ui", "hard"))), key=key)[:self.most]


class Worker:
    """A copy of the source with its own build."""

    def __init__(self, root, number, tests):
        self.root, self.tests = root, tests
        self.copy = root / f"build/mutants/{number}"
        self.home = root / f"build/mutants/home{number}"
        self.home.mkdir(parents=True, exist_ok=True)
        self.home.chmod(0o700)
        self.reliable = {}  # per test that failed here: True if it passes without a fault
        self.environment = dict(os.environ, CCACHE_BASEDIR=str(self.copy), HOME=str(self.home),
                                XDG_RUNTIME_DIR=str(self.home), CCACHE_DIR=os.environ["CCACHE_DIR"])
        self.update()
        # Uses the options of the release build, so that ccache knows the objects.
        cache = (root / "build/release/CMakeCache.txt").read_text()
        options = ["-D" + line for line in re.findall(
            r"^(?:CHAINMAIL_TESTS|CHAINMAIL_UNITY|CMAKE_COMPILE_WARNING_AS_ERROR|CMAKE_EXE_LINKER_FLAGS):.*", cache, re.M)]
        self.run(["cmake", "--preset", "release", *options], check=True)

    def update(self):
        """Updates the copy. Unchanged files keep their time, so that they are not built again."""
        files = set(source_files(self.root))
        for name in files:
            source, target = self.root / name, self.copy / name
            if not target.exists() or target.read_bytes() != source.read_bytes():
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, target)
        for old in self.copy.rglob("*"):
            name = str(old.relative_to(self.copy))
            if old.is_file() and not name.startswith("build/") and name not in files:
                old.unlink()

    def run(self, command, check=False, seconds=900):
        limited = ["prlimit", f"--as={16 << 30}", f"--core=0", "--", *map(str, command)]
        process = subprocess.Popen(limited, cwd=self.copy, env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
        try:
            output, _ = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, 9)
            output, _ = process.communicate()
        if check and process.returncode != 0:
            sys.exit(f"mutants: {' '.join(map(str, command))} failed:\n{output[-2000:]}")
        return process.returncode, output

    def build(self, target):
        return self.run(["cmake", "--build", "build/release", "--target", target, "--", "-j1"])[0] == 0

    def fails(self, test):
        limit = max(60, 5 * self.tests.seconds[test])
        command = ["ctest", "--test-dir", "build/release", "-R", f"^{test}$", "--timeout", int(limit)]
        return all(self.run(command, seconds=limit)[0] != 0 for _ in range(2))

    def is_reliable(self, test):
        """Returns True if a test passes here without a fault. The source must be unchanged."""
        if test not in self.reliable:
            self.reliable[test] = self.build(self.tests.program[test]) and not self.fails(test)
            if not self.reliable[test]:
                print(f"     {test} fails in {self.copy} without a fault: left out", flush=True)
        return self.reliable[test]

    def examine(self, mutant):
        """Returns the name of the test that catches a mutant; '' if none does, None if it does not compile."""
        tests = [test for test in self.tests.related(mutant.path) if self.reliable.get(test, True)]
        while True:
            caught = self.first_failure(mutant, tests)
            if not caught or self.is_reliable(caught):
                return caught
            tests = tests[tests.index(caught) + 1:]

    def first_failure(self, mutant, tests):
        file = self.copy / mutant.path
        original = file.read_text()
        lines = original.split("\n")
        lines[mutant.line] = mutant.after
        file.write_text("\n".join(lines))
        try:
            for test in tests:
                if not self.build(self.tests.program[test]):
                    return None
                if self.fails(test):
                    return test
            return ""
        finally:
            file.write_text(original)


def describe(mutant, caught):
    what = f"{mutant.before.strip()}  →  {mutant.after.strip() or '(removed)'}"
    return f"{'caught by ' + caught if caught else 'SURVIVED':32} {mutant.path}:{mutant.line + 1} [{mutant.operator}] {what}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--room", default="all", help="all, or a folder or file under " + ", ".join(ROOMS))
    parser.add_argument("--seed", type=int)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--tests", type=int, help="run at most this many tests for a fault, the most specific ones")
    parser.add_argument("--at-least", type=float, default=0, help="exit with status 1 if a smaller share is caught")
    options = parser.parse_args()
    root = options.root.resolve()
    wanted = list(ROOMS) if options.room == "all" else [options.room]
    seed = random.SystemRandom().randrange(1_000_000) if options.seed is None else options.seed
    candidates = draw(root, wanted, random.Random(seed))
    if not any(is_candidate(path, wanted) for path in source_files(root)):
        sys.exit(f"mutants: {options.room} contains no sources; use a folder or file under {', '.join(ROOMS)}")
    print(f"mutants: {options.count} in {options.room}, seed {seed}", flush=True)

    os.environ.setdefault("CCACHE_DIR", subprocess.run(["ccache", "-k", "cache_dir"], capture_output=True,
                                                       text=True).stdout.strip())
    tests = Tests(root, options.tests)
    workers = [Worker(root, i, tests) for i in range(min(options.jobs, options.count))]
    lock, results, uncompiled, started = threading.Lock(), [], [0], time.time()

    def work(worker):
        while True:
            with lock:
                if len(results) >= options.count:
                    return
                mutant = next(candidates, None)
            if mutant is None:
                return
            caught = worker.examine(mutant)
            with lock:
                if caught is None:
                    uncompiled[0] += 1
                elif len(results) < options.count:
                    results.append((mutant, caught))
                    print(f"{len(results):4} {describe(mutant, caught)}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(len(workers)) as pool:
        for done in [pool.submit(work, worker) for worker in workers]:
            done.result()

    report(results, uncompiled[0], seed, time.time() - started)
    caught = sum(1 for _, test in results if test)
    sys.exit(0 if results and caught >= options.at_least * len(results) else 1)


def report(results, uncompiled, seed, seconds):
    per_room = collections.defaultdict(lambda: [0, 0])
    for mutant, caught in results:
        per_room[room_of(mutant.path)][0 if caught else 1] += 1
    print(f"\n{'room':16} mutants  caught")
    for room, (caught, survived) in sorted(per_room.items()):
        print(f"{room:16} {caught + survived:7} {caught:7}")
    caught = sum(1 for _, test in results if test)
    share = 100 * caught / max(1, len(results))
    print(f"{'all':16} {len(results):7} {caught:7}  ({share:.0f} %), seed {seed}, {uncompiled} did not compile, {seconds:.0f} s")
    survivors = [one for one in results if not one[1]]
    if survivors:
        print("\nNo test caught:")
        for mutant, _ in survivors:
            print("  " + describe(mutant, "").removeprefix("SURVIVED").strip())


if __name__ == "__main__":
    main()
