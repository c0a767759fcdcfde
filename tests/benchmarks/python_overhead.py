#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cost of Python: user processor time of a run stepped from Python over that of the executable.

    PYTHONPATH=build/python tests/benchmarks/python_overhead.py build/bin/furrow [PAIRS]

Python takes one step at a time and reads the forces on the wheel and the arrays of the ground after each.
Pairs of runs with equal histories alternate. The start of Python is left out.
"""

import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

INPUTS = Path(__file__).resolve().parents[2] / "inputs"
SCENE = INPUTS / "scenes" / "wheel_on_snow.lig"
VARIABLES = {"cell": 0.08, "distance": 0.1, "vtk": 0, "motion": "mode slip slip 0.1"}


def driven(results: str) -> int:
    import furrow

    with furrow.Simulation(SCENE, variables={**VARIABLES, "results": results}) as run:
        wheel, soil, steps = run.wheels["wheel"], run.terrains["soil"], 0
        while run.step():
            steps += 1
            if wheel.force[2] + wheel.nodes[0, 0] > 1e9 or not soil.nodes.flags.c_contiguous:
                sys.exit("not a wheel on snow")
    return steps


def history(folder: Path) -> list[bytes]:
    """The channels of a run, without its costs."""
    import h5py

    with h5py.File(folder / "history.h5") as file:
        return [file["history"][name][:].tobytes() for name in sorted(file["history"])]


def user_time(command: list[str]) -> float:
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before


def main() -> None:
    program, pairs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 20
    given = [word for name, value in VARIABLES.items() for word in ("-var", name, str(value))]
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for pair in range(pairs):
            alone_folder, stepped_folder = Path(folder, f"alone{pair}"), Path(folder, f"stepped{pair}")
            alone_command = [program, "-in", str(SCENE), "-log", "none", "-var", "results", str(alone_folder), *given]
            stepped_command = [sys.executable, __file__, "--driven", str(stepped_folder)]
            start = user_time([sys.executable, "-c", "import furrow, numpy"]) - user_time([program, "--version"])
            if pair % 2:
                stepped, alone = user_time(stepped_command), user_time(alone_command)
            else:
                alone, stepped = user_time(alone_command), user_time(stepped_command)
            if history(alone_folder) != history(stepped_folder):
                sys.exit("the two histories differ")
            ratios.append((stepped - start) / alone)
            print(f"{alone:8.2f} s alone {stepped - start:8.2f} s from Python, ratio {ratios[-1]:.4f}", flush=True)
    error = statistics.stdev(ratios) / len(ratios) ** 0.5
    print(f"overhead {100 * statistics.mean(ratios) - 100:.1f} +- {100 * error:.1f} %, without the start of Python")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--driven"]:
        driven(sys.argv[2])
    else:
        main()
