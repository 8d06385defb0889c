"""The tests of a build: which of them pass, which faults each of them reaches, and which one a fault makes fail."""

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


class Test:
    def __init__(self, described, seconds):
        properties = {one["name"]: one["value"] for one in described["properties"]}
        self.name = described["name"]
        self.command = described.get("command", [])
        self.place = properties["WORKING_DIRECTORY"]
        self.folder = pathlib.Path(self.place).name
        self.environment = dict(line.split("=", 1) for line in properties.get("ENVIRONMENT", []))
        self.limit = properties.get("TIMEOUT", 300)  # seconds
        self.seconds = seconds.get(self.name, 5)
        self.lock = threading.Lock()
        self.reached = None  # numbers of the faults whose place it executes; empty if it fails without a fault

    def program(self):
        """Returns the name of the test program, or pytest; nothing for a test that is something else."""
        names = [pathlib.Path(word).name for word in self.command]
        return next((name for name in names if name.startswith("test_") or name == "pytest"), None)


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
        self.tests = [test for test in tests if test.program() and (not programs or test.program() in programs)]

    def passes(self, test, home, limit, **variables):
        own = {"HOME": str(home), "XDG_RUNTIME_DIR": str(home)}
        environment = {**self.build.environment, **own, **test.environment, **variables}
        return process.run(test.command, test.place, environment, limit)[0] == 0

    def reached_by(self, test, home):
        """Returns the faults that a test reaches. It runs without a fault, when it is needed for the first time."""
        with test.lock:
            if test.reached is None:
                record = home / "reached"
                record.write_bytes(bytes(FAULT_LIMIT))
                start = time.time()
                if any(self.passes(test, home, test.limit, CHAINMAIL_FAULTS_REACHED=str(record)) for _ in range(2)):
                    test.reached = {number for number, byte in enumerate(record.read_bytes()) if byte}
                else:
                    print(f"     {test.name} fails without a fault and is left out", flush=True)
                    test.reached = set()
                test.seconds = time.time() - start
            return test.reached

    def fails(self, test, home, number):
        """True if a test fails twice with a fault. A test that takes much longer than without has failed."""
        limit = 3 * test.seconds + 10
        return not any(self.passes(test, home, limit, CHAINMAIL_FAULT=str(number)) for _ in range(2))

    def ordered(self, fault):
        """Returns the tests: those of the fault's room first, then those with words of the file in their name, then the
        fast ones."""
        folder = next(folder for room, folder in FOLDERS.items() if fault.path.startswith(room + "/"))
        words = set(re.findall(r"[a-z]+", pathlib.Path(fault.path).stem)) - {"test"}

        def key(test):
            return (test.folder != folder, -len(words & set(test.name.split("_"))), test.seconds)

        return sorted(self.tests, key=key)

    def examine(self, number, home):
        """Returns the name of the first test that catches a fault, '' if none does, and how many of them reached it."""
        spent, reaching = 0, 0
        for test in self.ordered(self.build.faults[number]):
            if spent < self.max_seconds and number in self.reached_by(test, home):
                reaching += 1
                spent += test.seconds
                if self.fails(test, home, number):
                    return test.name, reaching
        return "", reaching
