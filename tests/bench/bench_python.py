"""What the Python module costs: adds its figures to a file of results, as in: bench_python.py build/bench.json"""

import json
import statistics
import sys
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


def move_microseconds():
    """The handle moves within the valid regions of 1,000 elements, so nearly all of the time is the binding's."""
    deformer = chainmail.Deformer(chainmail.make_grid(40, 25))
    there, back = (-0.001, 0.0, 0.0), (0.0, 0.0, 0.0)

    def work():
        for _ in range(1000):
            deformer.move(0, there)
            deformer.move(0, back)

    return best_of(20, work) / 2000 * 1e6


def positions_milliseconds():
    deformer = chainmail.Deformer(chainmail.make_grid(1000, 1000))
    deformer.move(0, (-30, 0))
    out = np.empty((10**6, 3))
    return best_of(20, lambda: deformer.body.positions(out)) * 1e3


def add(results, name, value):
    """Adds a figure as the other benchmarks do: all values, their median and their quartiles."""
    key = f"/python/{name}"
    samples = results.setdefault("samples", {}).setdefault(key, [])
    samples.append(value)
    ratios = results.setdefault("ratios", {}).setdefault("python", {})
    ratios[name] = statistics.median(samples)
    quartiles = statistics.quantiles(samples, n=4, method="inclusive") if len(samples) > 1 else [value] * 3
    results.setdefault("quartiles", {})[key] = [quartiles[0], quartiles[2]]


if __name__ == "__main__":
    path = sys.argv[1]
    try:
        with open(path, encoding="utf-8") as file:
            results = json.load(file)
    except FileNotFoundError:
        results = {}
    add(results, "move_us", move_microseconds())
    add(results, "million_positions_ms", positions_milliseconds())
    with open(path, "w", encoding="utf-8") as file:
        json.dump(results, file)
