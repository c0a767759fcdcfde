# SPDX-License-Identifier: GPL-2.0-or-later
"""Density at the measured stresses, and the ratio of lateral to axial stress."""

import math
from collections.abc import Sequence
from pathlib import Path

from furrow_post.analyse.evaluations import path_states
from furrow_post.analyse.statistics import rms
from furrow_post.csv_table import read_numbers
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

STEPS = 200  # from one measured stress to the next
MEASURED = read_numbers(Path(__file__).resolve().parent / "reference.csv")


def row_of(run: Run) -> dict[str, object]:
    row: dict[str, object] = {"law": run.name}
    errors = []
    for state, at in zip(path_states(run.folder, STEPS, len(MEASURED)), MEASURED):
        density = state["density"]
        errors.append(math.log(density / at["rho_kgm3"]))
        row[f"density_{at['sigma1_Pa'] / 1e3:g}kPa"] = round(density, 1)
        if at["sigma1_Pa"] == 1e5:
            row["k0"] = round(state["stress_xx"] / state["stress_zz"], 3)
    row["rms_ln_density"] = round(rms(errors), 4)
    return row


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    output.table("results.csv", [row_of(run) for run in runs.done("*")])
    return []
