# SPDX-License-Identifier: GPL-2.0-or-later
"""A tyre on a rigid plane that is stopped and continued, against the same run without a break: every
bit of the histories must agree.

    tyre.py <furrow>
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent


def run(furrow, folder, script, until):
    folder.mkdir(exist_ok=True)
    done = subprocess.run([furrow, "-in", HERE / script, "-log", "none", "-var", "here", HERE, "-var", "until", str(until)], cwd=folder,
                          timeout=400, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{script} stopped with status {done.returncode}:\n{done.stdout[-4000:]}")


def history(folder):
    with h5py.File(folder / "results/history.h5") as file:
        return {name: data[:] for name, data in file["history"].items()}


def main(furrow):
    with tempfile.TemporaryDirectory() as folder:
        whole, parts = Path(folder) / "whole", Path(folder) / "parts"
        run(furrow, whole, "tyre_start.lig", 2000)
        run(furrow, parts, "tyre_start.lig", 1200)
        run(furrow, parts, "tyre_go_on.lig", 2000)
        one, other = history(whole), history(parts)
    assert one["x"][-1] > 0.05 and one["force_z"][-1] > 3000, "the tyre does not roll"
    for name, values in one.items():
        assert np.array_equal(values, other[name]), f"{name} differs by up to {np.abs(values - other[name]).max()}"
    print(f"{len(one['time'])} rows agree in every bit")


if __name__ == "__main__":
    main(sys.argv[1])
