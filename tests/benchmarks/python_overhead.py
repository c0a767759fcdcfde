#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of Python: processor time of steps that Python takes one by one, over that of steps in one call.

    PYTHONPATH=build/python tests/benchmarks/python_overhead.py [CELL [ROUNDS]]

One run of wheel_on_snow alternates blocks of three kinds, in random order within a round. One call takes all steps
of the first. Each step of the others has a call. In the third kind Python then reads the force on the wheel and two
arrays. CELL is the size of a cell [m]. The run repeats until it has ROUNDS rounds.
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


Times = dict[str, float]  # processor time of a step of each kind [s]


def rounds_of_run(cell: float, count: int) -> list[Times]:
    """Those of one run, at most as many as count."""
    rounds: list[Times] = []
    variables = {"cell": cell, "vtk": 0, "motion": "mode slip slip 0.1"}
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

            while len(rounds) < count:
                times: Times = {}
                for kind in random.sample(KINDS, len(KINDS)):
                    before = time.process_time()
                    if not block(kind):
                        return rounds
                    times[kind] = (time.process_time() - before) / STEPS
                rounds.append(times)
    return rounds


def main() -> None:
    cell = float(sys.argv[1]) if len(sys.argv) > 1 else 0.05
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    rounds: list[Times] = []
    while len(rounds) < count:
        rounds += rounds_of_run(cell, count - len(rounds))
    whole = statistics.mean(times["one call"] for times in rounds)
    print(f"{len(rounds)} rounds, a step in one call takes {1e6 * whole:.0f} us")
    for kind in KINDS[1:]:
        more = [times[kind] - times["one call"] for times in rounds]
        mean, error = statistics.mean(more), statistics.stdev(more) / len(more) ** 0.5
        print(f"{kind}: {1e6 * mean:.0f} +- {1e6 * error:.0f} us more, "
              f"{100 * mean / whole:.1f} +- {100 * error / whole:.1f} %")


if __name__ == "__main__":
    main()
