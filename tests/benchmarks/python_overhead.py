#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of Python: processor time of steps that Python takes one by one, over that of steps in one call.

    PYTHONPATH=build/python tests/benchmarks/python_overhead.py [CELL [ROUNDS]]

Three simulations of wheel_on_snow run side by side in this process. A round advances each by the same steps, in
random order. One call takes all steps of the first. Each step of the others has a call. In the third, Python then
reads the force on the wheel and two arrays, which is timed alone. All three compute the same bits, so a difference
of a round is that of the calls and of the machine. CELL is the size of a cell [m].

Other programs on the machine disturb some rounds by far. A result is therefore the mean of the middle half of all
rounds. Its standard error is that of 2000 bootstrap samples of the rounds.
"""

import contextlib
import random
import sys
import tempfile
import time
from pathlib import Path

import furrow
import numpy as np
from scipy.stats import trim_mean

SCENE = Path(__file__).resolve().parents[2] / "inputs" / "scenes" / "wheel_on_snow.lig"
STEPS = 5  # of a round
KINDS = ("one call", "steps", "steps and reads")
OUTSIDE = 0.25  # of the rounds at either end, which do not count
SAMPLES = 2000  # of the bootstrap


class Side:
    """One of the three simulations."""

    def __init__(self, kind: str, cell: float, results: str) -> None:
        variables = {"cell": cell, "vtk": 0, "motion": "mode slip slip 0.1", "results": f"{results}/{KINDS.index(kind)}"}
        self.kind, self.run = kind, furrow.Simulation(SCENE, variables=variables)
        self.wheel, self.soil = self.run.wheels["wheel"], self.run.terrains["soil"]

    def times(self) -> tuple[float, float]:
        """Processor times [s] of a step and of its reading; NaN at the end of the script."""
        before, reading, done = time.process_time(), 0.0, 0
        if self.kind == "one call":
            done = self.run.step(STEPS)
        else:
            for _ in range(STEPS):
                done += self.run.step()
                if self.kind == "steps and reads":
                    reading += self.read()
        whole = time.process_time() - before - reading
        return (whole / STEPS, reading / STEPS) if done == STEPS else (np.nan, np.nan)

    def read(self) -> float:
        """@return its processor time [s]"""
        time.process_time()  # the first call after a step is slow
        before = time.process_time()
        if not np.isfinite(self.wheel.force[2] + self.wheel.nodes[0, 0] + self.soil.nodes.size):
            sys.exit("the run has numbers that are not finite")
        return time.process_time() - before


def rounds_of_run(cell: float, count: int) -> list[list[float]]:
    """Processor times [s] of a step of each kind, and of reading, of at most so many rounds."""
    rounds: list[list[float]] = []
    with tempfile.TemporaryDirectory() as results, contextlib.ExitStack() as stack:
        sides = [Side(kind, cell, results) for kind in KINDS]
        for side in sides:
            stack.callback(side.run.close)
        while len(rounds) < count:
            times = {side.kind: side.times() for side in random.sample(sides, len(sides))}
            row = [*(times[kind][0] for kind in KINDS), times[KINDS[-1]][1]]
            if not np.isfinite(row).all():
                break
            rounds.append(row)
        force = [side.wheel.force for side in sides]
        if not force[0] == force[1] == force[2]:
            sys.exit("the simulations differ")
    return rounds


def middle_mean(values: np.ndarray) -> tuple[float, float]:
    """Of the rounds (n), and its standard error."""
    samples = np.random.default_rng(1).choice(values, (SAMPLES, len(values)))
    return float(trim_mean(values, OUTSIDE)), float(trim_mean(samples, OUTSIDE, axis=1).std())


def main() -> None:
    cell = float(sys.argv[1]) if len(sys.argv) > 1 else 0.05
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    rounds: list[list[float]] = []
    while len(rounds) < count:
        rounds += rounds_of_run(cell, count - len(rounds))
    whole, steps, beside_reads, reads = np.array(rounds).T
    step = float(trim_mean(whole, OUTSIDE))
    print(f"{len(rounds)} rounds, a step in one call takes {1e6 * step:.0f} us")
    for name, more in (("a call for each step", 0.5 * (steps + beside_reads) - whole), ("reads", reads)):
        mean, error = middle_mean(more)
        print(f"{name}: {1e6 * mean:.1f} +- {1e6 * error:.1f} us, "
              f"{100 * mean / step:.2f} +- {100 * error / step:.2f} %")


if __name__ == "__main__":
    main()
