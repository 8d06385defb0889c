"""Processes that a fork makes, while helper threads exist that it does not copy."""

import subprocess
import sys

import pytest

LARGE_DRAG = """
import os, sys
import chainmail
import numpy as np


def drag(x):
    deformer = chainmail.Deformer(mesh, "exact")
    deformer.set_threads(4)
    deformer.move(0, (x, -200))
    return deformer.body.positions()


def threads():
    return len(os.listdir("/proc/self/task"))

mesh = chainmail.make_cloth(400, 400)
alone = threads()
expected = drag(-300)
started = threads() > alone


def same():
    return np.array_equal(drag(-300), expected)


def fork_and(work):
    child = os.fork()
    if child != 0:
        return os.waitpid(child, 0)[1]
    work()
    sys.exit(0)

"""

# Python 3.12 and later warn of any fork in a process with threads.
QUIET = ["-W", "ignore::DeprecationWarning"]
CHILDREN = {
    "ends": "lambda: None",
    "moves": "lambda: same() or sys.exit(1)",
    "forks again": "lambda: same() and fork_and(same) == 0 or sys.exit(1)",
}


@pytest.mark.parametrize("child", CHILDREN)
def test_a_child_of_a_process_with_helpers(child):
    program = f"{LARGE_DRAG}\nstatus = fork_and({CHILDREN[child]})\nassert same()\nprint(started, status)"
    done = subprocess.run([sys.executable, *QUIET, "-c", program], capture_output=True, text=True, timeout=120)
    started, status = done.stdout.split()[-2:]
    assert (status, done.returncode, done.stderr) == ("0", 0, "")
    if started == "False":
        pytest.skip("this machine has no core for a helper")


def test_a_child_starts_helpers_of_its_own():
    program = f"{LARGE_DRAG}\nalone = 1\nprint(started, fork_and(lambda: sys.exit(not (same() and threads() > 1))))"
    done = subprocess.run([sys.executable, *QUIET, "-c", program], capture_output=True, text=True, timeout=120)
    started, status = done.stdout.split()[-2:]
    if started == "False":
        pytest.skip("this machine has no core for a helper")
    assert (status, done.returncode, done.stderr) == ("0", 0, "")
