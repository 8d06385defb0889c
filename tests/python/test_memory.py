"""Memory that runs out: MemoryError or an answer, nothing else."""

import subprocess
import sys

import pytest

PROGRAM = """
import pickle, resource, sys
import chainmail
import numpy as np


def attempt(work):
    try:
        return work()
    except (MemoryError, chainmail.Error):
        return None

used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
limit = used + int(float(sys.argv[1]) * 2**20)
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
for make in (lambda: chainmail.make_cloth(80, 80), lambda: chainmail.make_tetra(8, 8, 8)):
    mesh = attempt(make)
    if mesh is None:
        continue
    for method in ("natural-queue", "exact", "arap", "ffd"):
        deformer = attempt(lambda: chainmail.Deformer(mesh, method))
        if deformer is None:
            continue
        attempt(lambda: deformer.body.pin(mesh.side("right")))
        attempt(lambda: deformer.body.set_elasticity(chainmail.Elasticity(iterations=2)))
        attempt(lambda: deformer.move(0, (-0.5, 0.2, 0)))
        attempt(lambda: deformer.relax(1, scheme="equilibrium"))
        attempt(lambda: chainmail.violation(deformer.body))
        attempt(lambda: deformer.body.set_link_softness(stretch=np.linspace(1, 2, mesh.link_count)))
        attempt(lambda: pickle.loads(pickle.dumps(mesh)))
        attempt(lambda: deformer.body.copy().positions())
print("alive")
"""


@pytest.mark.parametrize("megabytes", [1, 1.5, 1.8, 2, 3, 4, 6, 8, 9, 10, 11, 12, 13, 15, 20, 25, 30, 40, 50, 65, 80])
def test_little_memory(megabytes):
    done = subprocess.run([sys.executable, "-c", PROGRAM, str(megabytes)], capture_output=True, text=True, timeout=200)
    assert (done.returncode, done.stdout) == (0, "alive\n"), done.stderr
