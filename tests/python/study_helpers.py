"""What workers load by name."""

import os
import threading
from pathlib import Path

import chainmail


def pin_the_last(body):
    body.pin([body.mesh.element_count - 1])


def cut_one(body):
    body.cut(0, 1)


def drag_element_seven(mesh):
    return chainmail.deform(mesh, 7, (1, 0, 0))


def drag_the_first(mesh):
    deformer = chainmail.Deformer(mesh, "exact")
    return deformer.move(0, (-2, -1)), deformer.body.positions()


class Occupied:
    """A comparison of a body in another thread, which lasts until this is left."""

    def __init__(self, body):
        self.job = chainmail.Job()
        self.started, self.proceed = threading.Event(), threading.Event()
        self.thread = threading.Thread(target=self.run, args=(body,))
        self.was_cancelled = False

    def run(self, body):
        def progress(_):
            self.started.set()
            self.proceed.wait()

        try:
            chainmail.compare(body, repetitions=10**6, job=self.job, progress=progress)
        except chainmail.Cancelled:
            self.was_cancelled = True

    def __enter__(self):
        self.thread.start()
        assert self.started.wait(60)

    def __exit__(self, *_):
        self.job.cancel()
        self.proceed.set()
        self.thread.join()
        assert self.was_cancelled  # it was in use all the time


class DieOnce:
    """Ends the process of the first worker that runs a point, and marks that it did."""

    def __init__(self, mark):
        self.mark = mark

    def __call__(self, body):
        try:
            Path(self.mark).touch(exist_ok=False)
        except FileExistsError:
            return
        os._exit(1)
