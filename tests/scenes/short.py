# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a scene in its shortest form: short.py <furrow> <scene> <folder>.

The file short.csv has variables and results of scenes whose quick form takes more than some seconds.
Energies and momenta of the run must balance too.
"""

import csv
import shlex
import shutil
import sys
from pathlib import Path

from head import Expectations
from quantities import continuum_quantities, plate_quantities, wheel_quantities

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "tests" / "coupled" / "support"))
from furrow_run import output


def main(furrow, scene, folder):
    with open(Path(__file__).with_name("short.csv"), newline="", encoding="utf-8") as file:
        row = next(row for row in csv.DictReader(file) if row["scene"] == scene)
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    results = folder / "results"
    results.mkdir(parents=True)
    output([furrow, "-in", f"{scene}.lig", "-log", "none", "-v", "results", results, *shlex.split(row["variables"])],
           PROJECT / "inputs" / "scenes", FURROW_CACHE=str(folder / "cache"))
    found = continuum_quantities(results)
    if (results / "history.h5").is_file():
        found.update(wheel_quantities(results))
    if (results / "curve.txt").is_file():
        found.update(plate_quantities(results))
    Expectations(scene, row["gives"]).check(found)


if __name__ == "__main__":
    main(*sys.argv[1:])
