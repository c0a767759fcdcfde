#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of Python: processor time of a run stepped from Python over that of the executable.

    PYTHONPATH=build/python tests/benchmarks/python_overhead.py build/bin/furrow [PAIRS]

Python takes one step at a time and reads the forces on the wheel and the arrays of the ground after each.
Runs with and without Python alternate. The start of Python is left out.
"""

import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

INPUTS = Path(__file__).resolve().parents[2] / "inputs"
SCENE = INPUTS / "scenes" / "wheel_on_snow.lig"
VARIABLES = {"cell": 0.05, "distance": 0.3, "vtk": 0, "motion": "mode slip slip 0.1"}


def driven(results: str) -> int:
    import furrow

    with furrow.Simulation(SCENE, variables={**VARIABLES, "results": results}) as run:
        wheel, soil, steps = run.wheels["wheel"], run.terrains["soil"], 0
        while run.step():
            steps += 1
            if wheel.force[2] + wheel.nodes[0, 0] > 1e9 or not soil.nodes.flags.c_contiguous:
                sys.exit("not a wheel on snow")
    return steps


def processor_time(command: list[str]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    program, pairs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    given = [word for name, value in VARIABLES.items() for word in ("-var", name, str(value))]
    start = processor_time([sys.executable, "-c", "import furrow, numpy"])
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for pair in range(pairs):
            alone = processor_time([program, "-in", str(SCENE), "-log", "none", "-var", "results", f"{folder}/alone", *given])
            stepped = processor_time([sys.executable, __file__, "--driven", f"{folder}/driven"]) - start
            ratios.append(stepped / alone)
            print(f"{alone:8.2f} s alone {stepped:8.2f} s from Python, ratio {ratios[-1]:.4f}", flush=True)
    print(f"median ratio {statistics.median(ratios):.4f}; start of Python {start:.2f} s, left out")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--driven"]:
        driven(sys.argv[2])
    else:
        main()
