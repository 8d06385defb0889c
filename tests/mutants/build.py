"""A copy of the source with all faults in one build. Faults that do not compile are left out."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import process

HEADER = "tests/mutants/fault.h"
# The targets that are built first. Once they compile, the tests do so too, and are compiled only once.
PROGRAMS = ["chainmail", "chainmail_python", "workbench"]
PLACE = re.compile(r"\b((?:core|app|ui)/[\w/]+\.(?:cpp|h)):(\d+)")
ERROR_PLACE = re.compile(PLACE.pattern + r"(?::\d+)?: (?:fatal )?error: ")
# The program that imports foreign files gets only some variables of the environment. In the copy, these of faults too.
KEPT_VARIABLES = ("core/files/import/import_process.cpp", '"UBSAN_OPTIONS"}',
                  '"UBSAN_OPTIONS", "CHAINMAIL_FAULT", "CHAINMAIL_FAULTS_REACHED"}')


def source_files(root):
    """Returns all files of the project. It does not use git, so that it works in an export too."""
    files = []
    for folder, folders, names in os.walk(root):
        inside = pathlib.Path(folder).relative_to(root)
        folders[:] = [name for name in folders if name not in (".git", "build", "__pycache__")]
        files += [str(inside / name) for name in names if (root / inside / name).is_file()]
    return files


def key(fault):
    return f"{fault.path}:{fault.line} {fault.text}"


def with_faults(text, faults, header):
    """Returns a source in which each of the numbered faults can be switched on. Each line moves down by one."""
    for number, fault in sorted(faults.items(), key=lambda item: -item[1].start):
        text = text[:fault.start] + fault.text.replace("@FAULT@", str(number)) + text[fault.end:]
    return f'#include "{header}"\n{text}'


class Build:
    def __init__(self, root, faults):
        self.root = root
        self.copy = root / "build/mutants/source"
        self.folder = self.copy / "build/release"
        self.known = root / "build/mutants/refused.json"  # the faults that earlier builds refused
        refused = set(json.loads(self.known.read_text())) if self.known.exists() else set()
        self.faults = {number: fault for number, fault in faults.items() if key(fault) not in refused}
        # Read once: the source may be edited while the copy is built again and again.
        self.sources = {name: (root / name).read_bytes() for name in source_files(root)}
        cache = subprocess.run(["ccache", "-k", "cache_dir"], capture_output=True, text=True).stdout.strip()
        self.environment = {"CCACHE_DIR": cache, **os.environ, "CCACHE_BASEDIR": str(self.copy)}

    def content(self, name):
        faults = {number: fault for number, fault in self.faults.items() if fault.path == name}
        file, old, new = KEPT_VARIABLES
        if not faults and name != file:
            return self.sources[name]
        text = self.sources[name].decode()
        text = with_faults(text, faults, self.copy / HEADER) if faults else text
        return (text.replace(old, new) if name == file else text).encode()

    def write(self):
        """Updates the copy. Unchanged files keep their time, so that they are not built again."""
        for name in self.sources:
            target, content = self.copy / name, self.content(name)
            if not target.exists() or target.read_bytes() != content:
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(content)
                shutil.copymode(self.root / name, target)
        for old in set(source_files(self.copy)) - set(self.sources):
            (self.copy / old).unlink()

    def configure(self):
        """Uses the compiler's options of the release build, if there is one, so that ccache knows the objects."""
        cache = self.root / "build/release/CMakeCache.txt"
        known = cache.read_text() if cache.exists() else ""
        same = re.findall(r"^(?:CMAKE_COMPILE_WARNING_AS_ERROR|CMAKE_EXE_LINKER_FLAGS):.*", known, re.M)
        wanted = ["CHAINMAIL_UNITY=ON", "CHAINMAIL_TESTS=ON", "CHAINMAIL_PYTHON=ON", *same]
        options = [f"-D{option}" for option in wanted]
        code, output = process.run(["cmake", "--preset", "release", *options], self.copy, self.environment)
        if code != 0:
            sys.exit(f"mutants: the copy could not be configured:\n{output[-2000:]}")

    def compile(self, targets):
        """Builds the targets, again and again without the faults that do not compile."""
        while True:
            self.write()
            command = ["cmake", "--build", self.folder, "--target", *targets, "--", "-k", "0"]
            code, output = process.run(command, self.copy, self.environment)
            if code == 0:
                return
            refused = self.faults_at(ERROR_PLACE, output) or self.faults_at(PLACE, output)
            if not refused:
                sys.exit(f"mutants: the copy could not be built:\n{output[-4000:]}")
            print(f"mutants: {len(refused)} faults do not compile and are left out", flush=True)
            self.refuse(refused)

    def refuse(self, numbers):
        """Leaves faults out, also in the next builds."""
        earlier = json.loads(self.known.read_text()) if self.known.exists() else []
        self.known.write_text(json.dumps(earlier + [key(self.faults.pop(number)) for number in numbers]))

    def faults_at(self, pattern, output):
        """Returns the numbers of the faults in lines that the compiler names."""
        lines = {(match[1], int(match[2]) - 1) for match in pattern.finditer(output)}
        return [number for number, fault in self.faults.items()
                if any((fault.path, fault.line + line) in lines for line in range(fault.text.count("\n") + 1))]
