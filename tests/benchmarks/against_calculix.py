#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Continuum terrain against CalculiX, run alternately on one core.

CalculiX (Debian package calculix-ccx): *DYNAMIC, EXPLICIT, 24 x 24 x 24 C3D8R with Mises plasticity,
a block that its lid compresses; element updates per second from the difference of a long and a
short run, so that reading and writing do not count. Furrow: build/tests/benchmarks/ground_update,
whose particle carries what a one-point brick carries; the cap material.

    tests/benchmarks/against_calculix.py build/tests/benchmarks/ground_update [pairs]
"""
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

N = 24                # elements along an edge
EDGE = 0.48           # m
YOUNG, NU, RHO = 13.79e6, 0.3, 200.0
YIELD = 5e3           # Pa
INCREMENT = 2.517198e-5  # s, the step that CalculiX finds stable and takes, asked or not


def deck(increments):
    number = 1 + np.arange((N + 1) ** 3).reshape(N + 1, N + 1, N + 1)  # of the node at z, y, x
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]  # x, y, z
    nodes = [number[c : N + c, b : N + b, a : N + a].ravel() for a, b, c in corners]
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{number[k, j, i]}, {i * EDGE / N:.6g}, {j * EDGE / N:.6g}, {k * EDGE / N:.6g}" for k, j, i in np.ndindex(number.shape)]
    lines.append("*ELEMENT, TYPE=C3D8R, ELSET=BLOCK")
    lines += [", ".join(map(str, row)) for row in np.column_stack([1 + np.arange(N**3), *nodes])]
    for name, layer in ("BASE", number[0]), ("LID", number[-1]):
        lines += [f"*NSET, NSET={name}", *(f"{node}," for node in layer.ravel())]
    end = increments * INCREMENT
    lines += ["*MATERIAL, NAME=SNOW", "*ELASTIC", f"{YOUNG}, {NU}", "*PLASTIC", f"{YIELD}, 0.", f"{2 * YIELD}, 1.", "*DENSITY", f"{RHO}",
              "*SOLID SECTION, ELSET=BLOCK, MATERIAL=SNOW", "*BOUNDARY", "BASE, 1, 3", "*AMPLITUDE, NAME=RAMP", f"0., 0., {end}, 1.",
              f"*STEP, INC={10 * increments}, NLGEOM", "*DYNAMIC, EXPLICIT", f"{INCREMENT}, {end}",
              "*BOUNDARY, AMPLITUDE=RAMP", f"LID, 3, 3, {-0.5 * end}", "*END STEP"]
    return "\n".join(lines) + "\n"


def run_calculix(folder, increments):
    name = f"block{increments}"
    with open(os.path.join(folder, name + ".inp"), "w") as file:
        file.write(deck(increments))
    environment = dict(os.environ, OMP_NUM_THREADS="1", CCX_NPROC_EQUATION_SOLVER="1", NUMBER_OF_CPUS="1")
    start = time.monotonic()
    done = subprocess.run(["ccx", name], cwd=folder, env=environment, capture_output=True, text=True)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        sys.exit("CalculiX failed:\n" + done.stdout[-1500:])
    taken = float(re.search(r"SELECTED time increment:\s*([\d.Ee+-]+)", done.stdout).group(1))
    if abs(taken / INCREMENT - 1.0) > 1e-3:
        sys.exit(f"CalculiX took steps of {taken} s; set INCREMENT to it, or its updates are miscounted")
    return seconds


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    program, pairs = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(pairs):
            short, long = run_calculix(folder, 20), run_calculix(folder, 120)
            theirs = N ** 3 * 100 / (long - short)
            out = subprocess.run([program, "0.04", "0.02"], capture_output=True, text=True, check=True).stdout
            ours = float(re.search(r"([\d.]+) M updates/s\n", out).group(1)) * 1e6
            ratios.append(ours / theirs)
            print(f"CalculiX {theirs:.3g} element updates/s, Furrow {ours:.3g} particle updates/s, ratio {ratios[-1]:.1f}", flush=True)
    print(f"median ratio {statistics.median(ratios):.1f} of {pairs} pairs")


if __name__ == "__main__":
    main()
