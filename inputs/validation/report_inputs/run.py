#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers of [Shoop2001] that are inputs of this project, against the tests that they come from:
belt stiffness of the tyre, compression of the sand. See README.md.

Makes the runs that are missing and writes results.csv; seconds.
"""

import re
import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
INPUTS = HERE.parents[1]
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError
from furrow_post.study.furrow_cases import point_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

TYRE = INPUTS / "tyres" / "p235_75r15.yaml"
SAND = INPUTS / "materials" / "mccormick_sand.yaml"
STRESSES = (2e6, 4e6, 8e6)  # [Pa] of confined compression
PRESSURE = 13.447e6  # [Pa] the last of Table 5
STEPS = 400

CASES = (
    point_case(
        "mccormick_hydrostatic",
        "McCormick Ranch sand, hydrostatic compression",
        SAND,
        f"{{type: hydrostatic, pressure: [{PRESSURE:g}], steps: {STEPS}}}",
    ),
    *(
        point_case(
            f"mccormick_confined_{stress / 1e6:g}MPa",
            "McCormick Ranch sand, confined compression",
            SAND,
            f"{{type: confined, stress: [{stress:g}], steps: {STEPS}}}",
        )
        for stress in STRESSES
    ),
)
# Case -> what is taken of its end, name in results.csv
TAKEN = {
    "mccormick_hydrostatic": ("eps_vol_pl", "sand_plastic_volume_strain_13MPa"),
    **{
        f"mccormick_confined_{stress / 1e6:g}MPa": (
            "axial_strain",
            f"sand_axial_strain_{stress / 1e6:g}MPa",
        )
        for stress in STRESSES
    },
}


def of_tyre(key: str) -> float:
    """A number of the tyre's file. @raises ResultsError"""
    found = re.search(rf"^  {key}: *([\d.e+-]+)", TYRE.read_text(encoding="utf-8"), re.M)
    if not found:
        raise ResultsError(f"{TYRE}: has no number '{key}'")
    return float(found[1])


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    thickness = of_tyre("thickness")
    rows = [
        {
            "quantity": f"belt_stiffness_{way}",
            "unit": "N m",
            "value": round(of_tyre(modulus) * thickness**3 / 12, 3),
        }
        for way, modulus in (("along", "E1"), ("across", "E2"))
    ]
    for case in CASES:
        if record := runner.record(case):
            column, quantity = TAKEN[case.name]
            file = runner.folder(case) / "point.csv"
            points = read_numbers(file)
            if len(points) <= STEPS:
                raise ResultsError(f"{file}: has {len(points)} rows, not all steps; repeat the run")
            rows.append(
                {
                    "quantity": quantity,
                    "unit": "",
                    "value": round(points[-1][column], 4),
                    "user_s": round(record.cpu_time, 2),
                }
            )
    output.table("results.csv", rows)
    return []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", CASES, evaluate)))
