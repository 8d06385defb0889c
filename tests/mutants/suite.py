"""The tests of a build: which of their functions pass, which faults each of these reaches, and which a fault makes fail."""

import collections
import json
import pathlib
import re
import subprocess
import threading
import time

import process

# The folder of tests that belongs to a room. The first that fits counts.
FOLDERS = {"core/files": "files", "core": "core", "app/python": "python", "app": "cli", "ui": "ui"}
FAULT_LIMIT = 4096  # as in fault.h
START_SECONDS = 1  # of a test, beside its functions
# A function of a test, or a whole test with the name ''. `reached` are the numbers of the faults whose place it executes.
Function = collections.namedtuple("Function", "name seconds reached")


class Test:
    def __init__(self, described, seconds):
        properties = {one["name"]: one["value"] for one in described["properties"]}
        self.name = described["name"]
        self.command = described.get("command", [])
        self.place = properties["WORKING_DIRECTORY"]
        self.folder = pathlib.Path(self.place).name
        self.environment = dict(line.split("=", 1) for line in properties.get("ENVIRONMENT", []))
        self.limit = properties.get("TIMEOUT", 300)  # seconds
        self.is_long = "long" in properties.get("LABELS", [])  # not run with every change
        self.seconds = seconds.get(self.name, 5)
        self.lock = threading.Lock()
        self.functions = None  # those that pass without a fault

    def functions_reaching(self, number):
        return [one for one in self.functions if number in one.reached]

    def program(self):
        """Returns the name of the test program, or pytest; nothing for a test that is something else."""
        names = [pathlib.Path(word).name for word in self.command]
        return next((name for name in names if name.startswith("test_") or name == "pytest"), None)


def words_of(name):
    """Returns the words of a name in the singular: window_docks tests stiffness_dock.cpp."""
    return {word.removesuffix("s") for word in re.findall(r"[a-z]+", name)} - {"test"}


def recorded_seconds(root):
    """Returns the seconds that ctest has recorded in the release build."""
    costs = root / "build/release/Testing/Temporary/CTestCostData.txt"
    text = costs.read_text() if costs.exists() else ""
    lines = re.findall(r"^(\S+) [1-9]\d* ([\d.]+)$", text, re.M)
    return {name: float(seconds) for name, seconds in lines}


class Suite:
    def __init__(self, build, programs, seconds):
        self.build = build
        self.max_seconds = seconds  # that tests may run for one fault
        command = ["ctest", "--test-dir", build.folder, "--show-only=json-v1"]
        shown = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        known = recorded_seconds(build.root)
        tests = [Test(described, known) for described in json.loads(shown)["tests"]]
        self.tests = [test for test in tests if test.program() and not test.is_long and
                      (not programs or test.program() in programs)]

    def run(self, test, home, limit, functions=(), **variables):
        """Returns whether a test passes, or some of its functions, and its output."""
        own = {"HOME": str(home), "XDG_RUNTIME_DIR": str(home)}
        environment = {**self.build.environment, **own, **test.environment, **variables}
        names = [one.name for one in functions if one.name]
        code, output = process.run([*test.command, *names], test.place, environment, limit)
        return code == 0, output

    def find_functions(self, test, home):
        """Runs a test without a fault, when it is needed for the first time. Programs of Qt Test say what each of their
        functions reaches; other tests are a single function."""
        with test.lock:
            if test.functions is not None:
                return
            record = home / "reached"
            record.write_bytes(bytes(FAULT_LIMIT))
            start = time.time()
            passes, output = self.run(test, home, 2 * test.limit, CHAINMAIL_FAULTS_REACHED=str(record))
            found = re.findall(r"^@ (\w+) (\d+)((?: \d+)*)$", output, re.M)
            test.functions = [Function(name, int(ms) / 1000, set(map(int, numbers.split())))
                              for name, ms, numbers in found]
            if passes and not found:
                reached = {number for number, byte in enumerate(record.read_bytes()) if byte}
                test.functions = [Function("", time.time() - start, reached)]
            if not test.functions:
                print(f"     {test.name} fails without a fault and is left out", flush=True)

    def fails(self, test, functions, home, number):
        """True if functions of a test fail twice with a fault, and pass without it. Those that take much longer than
        without it have failed."""
        limit = 3 * sum(one.seconds for one in functions) + 10
        if any(self.run(test, home, limit, functions, CHAINMAIL_FAULT=str(number))[0] for _ in range(2)):
            return False
        return self.run(test, home, limit, functions)[0]

    def ordered(self, fault):
        """Returns the tests: those of the fault's room first, then those with words of the file in their name, then the
        fast ones."""
        folder = next(folder for room, folder in FOLDERS.items() if fault.path.startswith(room + "/"))
        words = words_of(pathlib.Path(fault.path).stem)

        def key(test):
            return (test.folder != folder, -len(words & words_of(test.name)), test.seconds)

        return sorted(self.tests, key=key)

    def examine(self, number, home):
        """Returns the name of the first test that catches a fault, '' if none does, and how many of them reached it."""
        spent, reaching = 0, 0
        for test in self.ordered(self.build.faults[number]):
            if spent >= self.max_seconds:
                break
            self.find_functions(test, home)
            functions = test.functions_reaching(number)
            if functions:
                reaching += 1
                spent += START_SECONDS + sum(one.seconds for one in functions)
                if self.fails(test, functions, home, number):
                    return test.name, reaching
        return "", reaching
