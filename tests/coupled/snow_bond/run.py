# SPDX-License-Identifier: GPL-2.0-or-later
"""A block of sintered snow that is crushed and torn: the same on several ranks, and the same when
it is continued from a checkpoint.

    run.py ranks <furrow> <mpirun -n>      on 1, 2 and 3 ranks: to rounding, and the same bonds
    run.py restart <furrow> <mpirun -n>    continued after half of it, on 1 and 2 ranks: every bit
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
TIME_LIMIT = 120  # s
ROUNDING = 1e-9  # m; sums over ranks and ghosts come in another order, and differences grow


def run(furrow, mpirun, folder, ranks, **variables):
    folder.mkdir(exist_ok=True)
    words = [word for pair in {"here": HERE, **variables}.items() for word in ("-var", *map(str, pair))]
    done = subprocess.run([*mpirun, str(ranks), furrow, "-in", HERE / "crushed.lig", "-log", "none", *words],
                          cwd=folder, timeout=TIME_LIMIT, text=True, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{folder.name} stopped with status {done.returncode}:\n{done.stdout[-4000:]}")
    return np.loadtxt(folder / "grains.txt", skiprows=9), (folder / "bonds.txt").read_text()


def check_that_it_happens(grains, bonds):
    _, all_bonds, _, made, _, broken = bonds.split()
    assert float(broken) > 100 and float(made) > 50, f"hardly a bond breaks: {bonds}"
    assert grains[:, 3].max() < 0.115, "the block is not crushed"


def ranks(furrow, mpirun, folder):
    alone, bonds = run(furrow, mpirun, folder / "one", 1)
    check_that_it_happens(alone, bonds)
    for number in (2, 3):
        grains, others = run(furrow, mpirun, folder / str(number), number)
        difference = np.abs(grains[:, 1:4] - alone[:, 1:4]).max()
        print(f"{number} ranks: largest difference {difference:.1e} m; {others.strip()}")
        assert difference < ROUNDING
        assert others == bonds, f"{bonds} and {others}"


def restart(furrow, mpirun, folder):
    for number in (1, 2):
        place = folder / str(number)
        whole, bonds = run(furrow, mpirun, place, number)
        check_that_it_happens(whole, bonds)
        continued, others = run(furrow, mpirun, place, number, start="continued", **{"from": "checkpoint.2000"})
        print(f"{number} ranks: largest difference {np.abs(continued - whole).max():g}")
        assert np.array_equal(continued, whole)
        assert others == bonds, f"{bonds} and {others}"


if __name__ == "__main__":
    case, program, *launcher = sys.argv[1:]
    with tempfile.TemporaryDirectory() as scratch:
        {"ranks": ranks, "restart": restart}[case](program, launcher, Path(scratch))
