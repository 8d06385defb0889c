"""What the binding costs. The limits are loose, for machines that are busy with other work."""

import time

import chainmail
import numpy as np


def best_of(runs, work):
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def test_a_move_costs_a_few_microseconds_more_than_in_cpp():
    """The handle moves within the valid regions, so nearly all of the time is the binding's."""
    deformer = chainmail.Deformer(chainmail.make_grid(40, 25))
    there, back = (-0.001, 0.0, 0.0), (0.0, 0.0, 0.0)

    def work():
        for _ in range(1000):
            deformer.move(0, there)
            deformer.move(0, back)

    assert best_of(20, work) / 2000 < 5e-6


def test_a_million_positions_take_a_few_milliseconds():
    deformer = chainmail.Deformer(chainmail.make_grid(1000, 1000))
    deformer.move(0, (-30, 0))
    out = np.empty((10**6, 3))
    assert best_of(20, lambda: deformer.body.positions(out)) < 10e-3
    assert best_of(20, deformer.body.positions) < 20e-3
    assert best_of(20, deformer.body.view) < 1e-3
