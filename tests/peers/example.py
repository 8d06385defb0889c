"""A solver for `chainmail compare --judge`: it moves the handle and leaves everything else at rest. Replace solve().

    python3 example.py bar-bend.json answer.json
"""

import json
import sys
import time


def prepare(case):
    """Prepares for the object, its pins and its handle. Returns the positions of the elements at rest."""
    return [list(point) for point in case["positions"]]


def solve(positions, case, move):
    """Puts the handle where the move has it, and every other element where your method finds it."""
    for element, place in zip(case["handle"], move):
        positions[element] = place


def milliseconds(work):
    start = time.perf_counter()
    result = work()
    return result, 1e3 * (time.perf_counter() - start)


def main(case_file, answer_file):
    with open(case_file, encoding="utf-8") as file:
        case = json.load(file)
    positions, factorize_ms = milliseconds(lambda: prepare(case))
    moves_ms = [milliseconds(lambda: solve(positions, case, move))[1] for move in case["moves"]]
    answer = {"kind": "chainmail answer", "schema_version": 1, "solver": "nothing but the handle moves",
              "case": case["name"], "positions": positions, "factorize_ms": factorize_ms, "moves_ms": moves_ms}
    with open(answer_file, "w", encoding="utf-8") as file:
        json.dump(answer, file)


if __name__ == "__main__":
    main(*sys.argv[1:])
