#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of Python: processor time of steps that Python takes one by one, over that of steps in one call.

    PYTHONPATH=build/python tests/benchmarks/python_overhead.py [CELL [REPETITIONS]]

One run of wheel_on_snow alternates blocks of three kinds. One call takes all steps of the first. Each step of
the others has a call. In the third kind Python then reads the force on the wheel and two arrays.
CELL is the size of a cell [m].
"""

import random
import statistics
import sys
import tempfile
import time
from pathlib import Path

import furrow
import numpy as np

SCENE = Path(__file__).resolve().parents[2] / "inputs" / "scenes" / "wheel_on_snow.lig"
STEPS = 5  # of a block
KINDS = ("one call", "steps", "steps and reads")


def times_of_run(cell: float) -> dict[str, float]:
    """Processor time of a step of each kind [s]."""
    spent = dict.fromkeys(KINDS, 0.0)
    rounds = 0
    variables = {"cell": cell, "distance": 0.3, "vtk": 0, "motion": "mode slip slip 0.1"}
    with tempfile.TemporaryDirectory() as results:
        with furrow.Simulation(SCENE, variables={**variables, "results": results}) as run:
            wheel, soil = run.wheels["wheel"], run.terrains["soil"]

            def block(kind: str) -> bool:
                if kind == "one call":
                    return run.step(STEPS) == STEPS
                for _ in range(STEPS):
                    if not run.step():
                        return False
                    if kind == "steps":
                        continue
                    if not np.isfinite(wheel.force[2] + wheel.nodes[0, 0] + soil.nodes.size):
                        sys.exit("the run has numbers that are not finite")
                return True

            while True:
                new = {}
                for kind in random.sample(KINDS, len(KINDS)):
                    before = time.process_time()
                    if not block(kind):
                        return {each: total / rounds / STEPS for each, total in spent.items()}
                    new[kind] = time.process_time() - before
                rounds += 1
                for kind, seconds in new.items():
                    spent[kind] += seconds


def main() -> None:
    cell = float(sys.argv[1]) if len(sys.argv) > 1 else 0.05
    runs = [times_of_run(cell) for _ in range(int(sys.argv[2]) if len(sys.argv) > 2 else 5)]
    whole = [run["one call"] for run in runs]
    print(f"a step in one call takes {1e6 * statistics.mean(whole):.0f} us")
    for kind in KINDS[1:]:
        more = [1e6 * (run[kind] - run["one call"]) for run in runs]
        ratios = [100 * (run[kind] / run["one call"] - 1) for run in runs]
        root = len(runs) ** 0.5
        print(f"{kind}: {statistics.mean(more):.0f} +- {statistics.stdev(more) / root:.0f} us more, "
              f"{statistics.mean(ratios):.1f} +- {statistics.stdev(ratios) / root:.1f} %")


if __name__ == "__main__":
    main()
