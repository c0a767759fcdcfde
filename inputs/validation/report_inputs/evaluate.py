# SPDX-License-Identifier: GPL-2.0-or-later
"""Belt stiffness of the tyre's file, and the strains of the sand."""

import re
from collections.abc import Sequence
from pathlib import Path

from furrow_post.analyse.evaluations import path_states
from furrow_post.errors import ResultsError
from furrow_post.study.output import Output
from furrow_post.study.runs import Runs

TYRE = Path(__file__).resolve().parents[2] / "tyres" / "p235_75r15.yaml"
STEPS = 400
HYDROSTATIC = "mccormick_hydrostatic"


def of_tyre(key: str) -> float:
    """A number of the tyre's file. @raises ResultsError"""
    found = re.search(rf"^  {key}: *([\d.e+-]+)", TYRE.read_text(encoding="utf-8"), re.M)
    if not found:
        raise ResultsError(f"{TYRE}: has no number '{key}'")
    return float(found[1])


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    thickness = of_tyre("thickness")
    rows: list[dict[str, object]] = [
        {
            "quantity": f"belt_stiffness_{way}",
            "unit": "N m",
            "value": round(of_tyre(modulus) * thickness**3 / 12, 3),
        }
        for way, modulus in (("along", "E1"), ("across", "E2"))
    ]
    for run in runs.done("*"):
        (end,) = path_states(run.folder, STEPS)
        column, quantity = "axial_strain", f"sand_axial_strain_{run.name.rpartition('_')[2]}"
        if run.name == HYDROSTATIC:
            column, quantity = "eps_vol_pl", "sand_plastic_volume_strain_13MPa"
        seconds = round(run.record.cpu_time, 2)
        rows.append({"quantity": quantity, "unit": "", "value": round(end[column], 4), "user_s": seconds})
    output.table("results.csv", rows)
    return []
