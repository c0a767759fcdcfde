#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of Python: processor time of steps that Python takes one by one, over that of steps in one call.

    PYTHONPATH=build/python tests/benchmarks/python_overhead.py [CELL [BLOCKS]]

One simulation of wheel_on_snow advances in blocks. A block has three parts of the same number of steps, in random
order: all steps in one call, a call for each step, and the same with reads of the wheel's force and two arrays
after each step. The reads are timed alone. Steps of a block take nearly the same time, so a difference of its parts
is that of the calls and of the machine. Two simulations side by side would also differ by where their memory
lies, by about 1 %. CELL is the size of a cell [m].

Other programs on the machine disturb some blocks by far. A result is therefore the mean of the middle half of all
blocks. Its standard error is that of 2000 bootstrap samples of the blocks.
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
STEPS = 5  # of a part of a block
KINDS = ("one call", "steps", "steps and reads")
EMPTY = """
units si
atom_style granular
atom_modify sort 0 0
newton off
communicate single vel yes
region box block 0 1 0 1 0 1 units box
create_box 1 box
neighbor 0.01 bin
timestep 1e-4
fix wheel all wheel/rigid diameter 0.4 width 0.1 mass 10 inertia 0.3 axle 0.5 0.5 0.5
thermo 1000000
run 1000000
"""
OUTSIDE = 0.25  # of the blocks at either end, which do not count
SAMPLES = 2000  # of the bootstrap


class Part:
    """Advances a simulation by the steps of one part."""

    def __init__(self, run: furrow.Simulation) -> None:
        self.run, self.wheel, self.soil = run, run.wheels["wheel"], run.terrains["soil"]

    def times(self, kind: str) -> tuple[float, float]:
        """Processor times [s] of a step and of its reading; NaN at the end of the script."""
        before, reading, done = time.process_time(), 0.0, 0
        if kind == "one call":
            done = self.run.step(STEPS)
        else:
            for _ in range(STEPS):
                done += self.run.step()
                if kind == "steps and reads":
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


def blocks_of_run(cell: float, count: int) -> list[list[float]]:
    """Processor times [s] of a step of each kind, and of reading, of at most so many blocks."""
    blocks: list[list[float]] = []
    with tempfile.TemporaryDirectory() as results, contextlib.ExitStack() as stack:
        variables = {"cell": cell, "vtk": 0, "motion": "mode slip slip 0.1", "results": results}
        run = furrow.Simulation(SCENE, variables=variables)
        stack.callback(run.close)
        part = Part(run)
        while len(blocks) < count:
            times = {kind: part.times(kind) for kind in random.sample(KINDS, len(KINDS))}
            row = [*(times[kind][0] for kind in KINDS), times[KINDS[-1]][1]]
            if not np.isfinite(row).all():
                break
            blocks.append(row)
    return blocks


def call_times(count: int, calls: int = 200) -> np.ndarray:
    """Processor times [s] of a call beyond that of its step, in a box with a wheel alone, whose step takes
    microseconds (count)."""
    more = []
    with tempfile.NamedTemporaryFile("w", suffix=".lig") as script:
        script.write(EMPTY)
        script.flush()
        with furrow.Simulation(script.name) as run:
            for _ in range(count):
                start = time.process_time()
                run.step(calls)
                middle = time.process_time()
                for _ in range(calls):
                    run.step()
                more.append((time.process_time() - 2 * middle + start) / calls)
    return np.array(more)


def middle_mean(values: np.ndarray) -> tuple[float, float]:
    """Trimmed mean of the blocks (n), and its standard error."""
    samples = np.random.default_rng(1).choice(values, (SAMPLES, len(values)))
    return float(trim_mean(values, OUTSIDE)), float(trim_mean(samples, OUTSIDE, axis=1).std())


def main() -> None:
    cell = float(sys.argv[1]) if len(sys.argv) > 1 else 0.05
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 300
    mean, error = middle_mean(call_times(count))
    print(f"a call in a box with a wheel alone, beyond its step: {1e6 * mean:.2f} +- {1e6 * error:.2f} us")
    blocks: list[list[float]] = []
    while len(blocks) < count:
        blocks += blocks_of_run(cell, count - len(blocks))
    whole, steps, beside_reads, reads = np.array(blocks).T
    step = float(trim_mean(whole, OUTSIDE))
    print(f"{len(blocks)} blocks, a step in one call takes {1e6 * step:.0f} us")
    for name, more in (("a call for each step", 0.5 * (steps + beside_reads) - whole), ("reads", reads)):
        mean, error = middle_mean(more)
        print(f"{name}: {1e6 * mean:.1f} +- {1e6 * error:.1f} us, "
              f"{100 * mean / step:.2f} +- {100 * error / step:.2f} %")


if __name__ == "__main__":
    main()
