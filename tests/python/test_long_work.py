"""Progress, cancelling and Ctrl-C."""

import os
import signal
import subprocess
import sys
import threading

import chainmail
import pytest


def beam():
    body = chainmail.Body(chainmail.make_tetra(7, 3, 3))
    body.pin(body.mesh.side("left"))
    return body


LONG = {
    "compare": lambda **given: chainmail.compare(beam(), repetitions=10**6, **given),
    "calibrate": lambda **given: chainmail.calibrate(beam(), evaluations=10**6, drags=20, **given),
    "ramp": lambda **given: chainmail.ramp(budget=1000, moves=1000, **given),
}


@pytest.mark.parametrize("work", LONG)
def test_progress_is_reported(work):
    shares = []
    job = chainmail.Job()

    def progress(share):
        shares.append(share)
        if len(shares) == 3:
            job.cancel()

    with pytest.raises(chainmail.Cancelled):
        LONG[work](job=job, progress=progress)
    assert shares == sorted(shares) and 0 <= shares[0] and shares[-1] <= 1
    assert job.is_cancelled


@pytest.mark.parametrize("work", LONG)
def test_an_exception_of_progress_ends_the_work(work):
    def progress(_):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        LONG[work](progress=progress)


@pytest.mark.parametrize("work", LONG)
def test_control_c_ends_the_work(work):
    """The signal comes when the work has begun; Python raises KeyboardInterrupt within a second."""

    def progress(_):
        os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        LONG[work](progress=progress)


def test_another_thread_cancels():
    job = chainmail.Job()
    begun = threading.Event()
    canceller = threading.Thread(target=lambda: begun.wait() and job.cancel())
    canceller.start()
    with pytest.raises(chainmail.Cancelled):
        chainmail.compare(beam(), repetitions=10**6, job=job, progress=lambda _: begun.set())
    canceller.join()


def test_a_cancelled_job_cancels_the_next_preparation():
    deformer = chainmail.Deformer(beam(), "fem")
    job = chainmail.Job()
    job.cancel()
    deformer.set_job(job)
    before = deformer.body.positions()
    with pytest.raises(chainmail.Cancelled):
        deformer.move(62, (7, 2, 2))
    assert (deformer.body.positions() == before).all()
    deformer.set_job(chainmail.Job())
    assert deformer.move(62, (7, 2, 2)).moved > 0


CONTROL_C_IN_A_MOVE = """
import os, signal, sys, threading
import chainmail

deformer = chainmail.Deformer(chainmail.make_tetra(13, 13, 13), "neo-hookean")
deformer.body.pin(deformer.body.mesh.side("left"))
job = chainmail.Job()
deformer.set_job(job)


def interrupt():
    while job.share == 0:  # until the preparation has begun
        pass
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=interrupt, daemon=True).start()
try:
    deformer.move(13**3 - 1, (13, 12, 12))
except KeyboardInterrupt:
    print("interrupted", (deformer.body.positions() == deformer.body.mesh.rest_positions()).all(), job.is_cancelled)
    deformer.set_method("natural-queue")
    print(deformer.move(13**3 - 1, (14, 12, 12)).moved > 0)
"""


def test_control_c_ends_a_preparation_and_the_next_move_works():
    shown = subprocess.run(
        [sys.executable, "-c", CONTROL_C_IN_A_MOVE], capture_output=True, text=True, timeout=200
    )
    assert (shown.stdout, shown.stderr) == ("interrupted True True\nTrue\n", "")


CONTROL_C_IN_A_RELAXATION = """
import os, signal, threading
import chainmail

deformer = chainmail.Deformer(chainmail.make_tetra(20, 20, 20))
deformer.move(0, (-5, -5, -5))
job = chainmail.Job()
deformer.set_job(job)


def interrupt():
    while job.share == 0:  # until the first sweep has ended
        pass
    os.kill(os.getpid(), signal.SIGINT)

threading.Thread(target=interrupt, daemon=True).start()
try:
    deformer.relax(10_000)
except KeyboardInterrupt:
    print("interrupted", job.is_cancelled, deformer.relax(1))
"""


def test_control_c_ends_a_relaxation_and_the_next_one_works():
    shown = subprocess.run(
        [sys.executable, "-c", CONTROL_C_IN_A_RELAXATION], capture_output=True, text=True, timeout=200
    )
    assert (shown.stdout, shown.stderr) == ("interrupted True 1\n", "")


def test_reference_solutions_report_progress():
    body = beam()
    deformer = chainmail.Deformer(body)
    deformer.move(62, (7, 2, 2))
    shares = []
    solution = chainmail.reference_solution(body, 62, progress=shares.append)
    assert all(0 <= share <= 1 for share in shares)
    assert solution.positions().shape == (63, 3)


def test_a_job():
    job = chainmail.Job()
    assert (job.share, job.is_cancelled, repr(job)) == (0, False, "<Job: 0 % done>")
    job.cancel()
    assert repr(job) == "<Job: 0 % done, cancelled>"
