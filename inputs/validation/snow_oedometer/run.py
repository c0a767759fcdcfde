#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Confined compression of fresh snow by the laws, at a material point, against the oedometer of
[Abele1975]: density at its stresses and the ratio of lateral to axial stress. See README.md.

Makes the runs that are missing and writes results.csv; seconds.
"""

import math
import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

from furrow_post.analyse.statistics import rms
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError
from furrow_post.study.case import Case
from furrow_post.study.furrow_cases import point_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

MATERIALS = HERE.parents[1] / "materials"
LAWS = (
    "fresh_snow",
    "fresh_snow_cam_clay",
    "fresh_snow_shoop",
    "fresh_snow_shoop_log",
    "fresh_snow_as_printed",
    "fresh_snow_p_0413",
    "fresh_snow_foam",
    "fresh_snow_foam_oedometer",
)
STEPS = 200  # from one measured stress to the next
AXIAL, LATERAL = "stress_zz", "stress_xx"


def measured() -> list[dict[str, float]]:
    """sigma1_Pa, rho_kgm3"""
    return read_numbers(HERE / "reference.csv")


def case_of(law: str) -> Case:
    stresses = ", ".join(f"{row['sigma1_Pa']:g}" for row in measured())
    path = f"{{type: confined, stress: [{stresses}], steps: {STEPS}}}"
    return point_case(law, law, MATERIALS / f"{law}.yaml", path)


CASES = tuple(case_of(law) for law in LAWS)


def row_of(case: Case, folder: Path) -> dict[str, object]:
    file = folder / "point.csv"
    points = read_numbers(file)
    if len(points) <= STEPS * len(measured()):
        raise ResultsError(f"{file}: has {len(points)} rows, not all steps; repeat the run")
    row: dict[str, object] = {"law": case.name}
    errors = []
    for index, at in enumerate(measured(), 1):
        state = points[index * STEPS]
        density = state["density"]
        errors.append(math.log(density / at["rho_kgm3"]))
        row[f"density_{at['sigma1_Pa'] / 1e3:g}kPa"] = round(density, 1)
        if at["sigma1_Pa"] == 1e5:
            row["k0"] = round(state[LATERAL] / state[AXIAL], 3)
    row["rms_ln_density"] = round(rms(errors), 4)
    return row


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    output.table(
        "results.csv",
        [row_of(case, runner.folder(case)) for case in CASES if runner.record(case)],
    )
    return []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", CASES, evaluate)))
