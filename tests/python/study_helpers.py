"""What workers load by name."""

import os
from pathlib import Path

import chainmail


def pin_the_last(body):
    body.pin([body.mesh.element_count - 1])


def cut_one(body):
    body.cut(0, 1)


def drag_element_seven(mesh):
    return chainmail.deform(mesh, 7, (1, 0, 0))


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
