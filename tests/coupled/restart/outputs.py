# SPDX-License-Identifier: GPL-2.0-or-later
"""Continues a run from a checkpoint and compares it with the run without a break. Every bit of the
outputs of fixes must agree, from the first row on. So must the history, where there is one.

    outputs.py <furrow> tyre <stiffness of the plane, Pa/m> <least penetration, m>
    outputs.py <furrow> cell <speed of the layer, m/s>

`<scene>_start.lig` begins a run, `<scene>_go_on.lig` continues it from its checkpoint.
"""

import re
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, script_output

HERE = Path(__file__).resolve().parent
CHECKPOINT = 1000  # step


def run(furrow, folder, script, **variables):
    """@return the rows of the thermo output by their step"""
    said = script_output(furrow, HERE / script, folder, here=HERE, **variables)
    return {int(row.split()[0]): row.split() for row in re.findall(r"^ *\d+(?: +-?[\d.]\S*)+ *$", said, flags=re.M)}


def history(folder):
    file = folder / "results/history.h5"
    return columns(file) if file.exists() else {}


def continue_run(furrow, scene, check, **variables):
    """@param check  of the rows and the history of the run without a break"""
    with tempfile.TemporaryDirectory() as folder:
        whole, parts = Path(folder) / "whole", Path(folder) / "parts"
        rows = run(furrow, whole, f"{scene}_start.lig", until=2000, **variables)
        run(furrow, parts, f"{scene}_start.lig", until=1200, **variables)
        continued = run(furrow, parts, f"{scene}_go_on.lig", until=2000, **variables)
        one, other = history(whole), history(parts)
    check(rows, one)
    for name, values in one.items():
        assert np.array_equal(values, other[name]), f"{name} differs by up to {np.abs(values - other[name]).max()}"
    assert min(continued) == CHECKPOINT and max(continued) == 2000, f"rows {sorted(continued)}"
    for step, row in continued.items():
        assert row == rows[step], f"outputs {row} after read_restart, and {rows[step]} without a break"
    print(f"{len(continued)} rows of outputs and {len(one.get('time', []))} of the history agree in every bit")


def tyre(furrow, stiffness, least_penetration):
    """A tyre on a rigid plane."""

    def check(rows, moving):
        assert moving["x"][-1] > 0.05 and moving["force_z"][-1] > 3000, "the tyre does not roll"
        penetration = float(rows[CHECKPOINT][4]) / float(stiffness)
        assert penetration > float(least_penetration), f"the tyre stands {penetration} m deep at the checkpoint"

    continue_run(furrow, "tyre", check, stiffness=stiffness)


def cell(furrow, speed):
    """A periodic cell of grains, stopped before its ramps have ended."""

    def check(rows, _):
        assert float(rows[2000][1]) > 1.5 * float(rows[CHECKPOINT][1]) > 0.0, "the layer does not accelerate"
        assert float(rows[2000][5]) != float(rows[CHECKPOINT][5]), "the height of the cell is not controlled"
        assert float(rows[CHECKPOINT][7]) > 100.0, "the grains do not touch"

    continue_run(furrow, "cell", check, speed=speed)


if __name__ == "__main__":
    {"tyre": tyre, "cell": cell}[sys.argv[2]](sys.argv[1], *sys.argv[3:])
