"""The end of Python while daemon threads work: the exit status is that of the program."""

import subprocess
import sys

import pytest

PROGRAM = """
import sys, threading
import chainmail


def motions():
    while True:
        begun.set()
        yield (1, 0)


def moves():
    deformer = chainmail.Deformer(chainmail.make_cloth(150, 150))
    while True:
        begun.set()
        deformer.move(0, (-5, -3))


def positions():
    body = chainmail.Body(chainmail.make_cloth(150, 150))
    while True:
        begun.set()
        body.set_positions(body.positions())


def prepares():
    deformer = chainmail.Deformer(chainmail.make_tetra(16, 16, 16), "neo-hookean")
    deformer.body.pin(deformer.body.mesh.side("left"))
    begun.set()
    deformer.move(4095, (16, 15, 15))


def compares():
    chainmail.compare(chainmail.Body(chainmail.make_cloth(20, 20)), repetitions=10**6, progress=lambda _: begun.set())


def drags():
    while True:
        try:
            chainmail.Drag("endless", [0], motions())
        except chainmail.Error:
            pass

begun = threading.Event()
threading.Thread(target=globals()[sys.argv[1]], daemon=True).start()
begun.wait()
print("done")
sys.exit(3)
"""


@pytest.mark.parametrize("options", [[], ["-X", "dev", "-W", "error"]], ids=["plain", "dev"])
@pytest.mark.parametrize("work", ["moves", "positions", "prepares", "compares", "drags"])
def test_a_daemon_thread_does_not_change_the_end(work, options):
    for _ in range(3):
        done = subprocess.run([sys.executable, *options, "-c", PROGRAM, work], capture_output=True, text=True, timeout=60)
        assert (done.stdout, done.returncode, done.stderr) == ("done\n", 3, "")


def test_without_numpy_the_import_says_so():
    program = "import sys\nsys.modules['numpy'] = None\nimport chainmail"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
    assert done.stderr.splitlines()[-1] == (
        "ImportError: chainmail needs NumPy, which is not installed; install python3-numpy, or run pip install numpy"
    )
