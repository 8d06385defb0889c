#!/usr/bin/env python3
"""Checks the tests: puts random faults ("mutants") into a copy of the source and names those that no test catches.

All faults are in one build (build.py), which is compiled once. An environment variable switches one of them on
(fault.h). faults.py has the kinds of faults. Each test runs once without a fault, which shows the faults that it
reaches. For each fault, the tests that reach it run one after another until one fails (suite.py).
"""

import argparse
import collections
import concurrent.futures
import os
import pathlib
import queue
import random
import re
import sys
import time

import build as builds
import faults as kinds
import suite as suites

# More faults are drawn than wanted, because some do not compile: swapped arguments of two types, above all.
SPARE = 1.6
Result = collections.namedtuple("Result", "fault caught reaching")


def room_of(path):
    """Returns the folder of a file, at most two levels deep."""
    return "/".join(path.split("/")[:-1][:2])


def candidates(root, wanted):
    """Returns the sources that can have faults. Of headers, only those with templates contain more than
    declarations.

    Examples of the library run only when it is installed.
    """
    return sorted(path for path in builds.source_files(root)
                  if re.match(r"(?:core|app|ui)/.*\.cpp$|core/(?:body|chainmail|exact|equilibrium|solver)/.*\.h$", path)
                  and "/examples/" not in path
                  and (wanted == "all" or path == wanted or path.startswith(wanted.rstrip("/") + "/")))


class Room:
    def __init__(self):
        self.lines = 0
        self.faults = collections.defaultdict(list)  # by kind

    def add(self, path, text):
        self.lines += text.count("\n")
        for fault in kinds.faults_of(path, text):
            self.faults[fault.kind].append(fault)

    def draw(self, generator):
        """Takes a random fault of a random kind."""
        left = self.faults[generator.choice([kind for kind in sorted(self.faults) if self.faults[kind]])]
        return left.pop(generator.randrange(len(left)))


def draw(root, paths, count, generator):
    """Returns random faults that do not overlap, as many in each room as its lines say."""
    rooms = collections.defaultdict(Room)
    for path in paths:
        rooms[room_of(path)].add(path, (root / path).read_text())
    drawn = []
    while len(drawn) < count and (left := [room for room in rooms.values() if any(room.faults.values())]):
        fault = generator.choices(left, [room.lines for room in left])[0].draw(generator)
        if not any(fault.path == other.path and fault.start < other.end and other.start < fault.end for other in drawn):
            drawn.append(fault)
    return drawn


def shortened(before, after):
    """Returns two texts without most of what they have in common at both ends."""
    start = len(os.path.commonprefix([before, after]))
    end = len(os.path.commonprefix([before[start:][::-1], after[start:][::-1]]))

    def middle(text):
        begin, stop = max(0, start - 50), min(len(text), len(text) - end + 30)
        return ("…" if begin else "") + text[begin:stop] + ("…" if stop < len(text) else "")

    return f"{middle(before)}  →  {middle(after)}"


def described(result):
    fault = result.fault
    verdict = f"caught by {result.caught}" if result.caught else f"SURVIVED {result.reaching} tests"
    what = shortened(fault.before, fault.after)
    return f"{verdict:34} {room_of(fault.path):18} {fault.path}:{fault.line} [{fault.kind}] {what}"


def examine_all(suite, numbers, root, jobs):
    """Examines the faults, some at a time, and prints a line for each. Returns the results."""
    homes, results = queue.SimpleQueue(), []
    for job in range(jobs):
        home = root / f"build/mutants/home{job}"
        home.mkdir(mode=0o700, exist_ok=True)
        homes.put(home)

    def examine(number):
        home = homes.get()
        try:
            return Result(suite.build.faults[number], *suite.examine(number, home))
        finally:
            homes.put(home)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for done in concurrent.futures.as_completed([pool.submit(examine, number) for number in numbers]):
            results.append(done.result())
            print(f"{len(results):4} {described(results[-1])}", flush=True)
    return results


def print_table(results, name, key):
    rows = collections.defaultdict(lambda: [0, 0])
    for result in results:
        rows[key(result.fault)][bool(result.caught)] += 1
    print(f"\n{name:20} planted  caught  survived")
    for row, (survived, caught) in sorted(rows.items()):
        print(f"{row:20} {survived + caught:7} {caught:7} {survived:9}")


def report(results, seed, seconds):
    print_table(results, "kind", lambda fault: fault.kind)
    print_table(results, "room", lambda fault: room_of(fault.path))
    survivors = [result for result in results if not result.caught]
    caught = len(results) - len(survivors)
    print(f"{'all':20} {len(results):7} {caught:7} {len(survivors):9}"
          f"  ({100 * caught / max(1, len(results)):.0f} % caught, seed {seed}, {seconds:.0f} s)")
    if survivors:
        print("\nNo test caught:")
        for result in survivors:
            print("  " + described(result))


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--room", default="all", help="all, or a folder or file of core, app or ui")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1_000_000))
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="tests that run at the same time")
    parser.add_argument("--programs", nargs="*", help="build and run only these test programs, such as test_core")
    parser.add_argument("--seconds", type=float, default=60, help="time of the tests that run for a fault, at most")
    parser.add_argument("--at-least", type=float, default=0, help="exit with status 1 if a smaller share is caught")
    return parser.parse_args()


def main():
    chosen = options()
    root, start = chosen.root.resolve(), time.time()
    paths = candidates(root, chosen.room)
    if not paths:
        sys.exit(f"mutants: {chosen.room} contains no sources; use a folder or file of core, app or ui")
    print(f"mutants: {chosen.count} in {chosen.room}, seed {chosen.seed}", flush=True)
    drawn = draw(root, paths, int(SPARE * chosen.count) + 2, random.Random(chosen.seed))
    build = builds.Build(root, dict(enumerate(drawn, start=1)))
    build.write()
    build.configure()
    for targets in [chosen.programs] if chosen.programs else [builds.PROGRAMS, ["all"]]:
        build.compile(targets)
    print(f"mutants: built in {time.time() - start:.0f} s", flush=True)
    numbers = sorted(build.faults)[:chosen.count]
    results = examine_all(suites.Suite(build, chosen.programs, chosen.seconds), numbers, root, chosen.jobs)
    report(results, chosen.seed, time.time() - start)
    caught = sum(1 for result in results if result.caught)
    sys.exit(0 if results and caught >= chosen.at_least * len(results) else 1)


if __name__ == "__main__":
    main()
