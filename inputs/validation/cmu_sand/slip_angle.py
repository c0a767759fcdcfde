#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The smooth wheel of CMU's tests at a slip angle: up to 16 grains in its width. See README.md.

Makes the runs that are missing and writes slip_angle.csv, slip_angle_limit.csv and slip_angle.png.
The law of the grains is the one that was found at slip angle 0.
"""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

from grounds import BETWEEN, SIDEWAYS, Changes, grains_case
from grounds_report import QUANTITIES, Row, at_size_zero, row_of, scatter_of_pours

import matplotlib.pyplot as plt

from furrow_post.figures.style import save
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

LAW: Changes = {"rolling": BETWEEN, **SIDEWAYS}
WIDTH = 50.0  # [mm] of the wheel
FINEST = 3.1  # [mm] 16 grains in the wheel's width
LABELS = {"fy_over_fz": "Fy/Fz", "fx_over_fz": "Fx/Fz", "sinkage_mm": "sinkage [mm]"}
# Between the coarsest and the finest grains: what was reached, plus the scatter of pours
APART = 0.2
ERRORS = {"fy_over_fz": "fy_over_fz_error", **QUANTITIES}


def run_of(size: float, pour: int = 1) -> Case:
    """size [mm]"""
    case = grains_case("sizes", size, 0.0, pour, LAW)
    return replace(case, ranks=2) if size == FINEST else case


RUNS = [
    *(run_of(size, pour) for size in (10, 8) for pour in (1, 2)),
    *(run_of(size) for size in (6, 4.2, FINEST)),
]


def limit_of(rows: Sequence[Row]) -> Row:
    """At size zero, along a straight line through all runs."""
    sizes = [row["size_mm"] for row in rows]
    limit: Row = {"finest_mm": min(sizes), "runs": len(rows)}
    for key, error in ERRORS.items():
        value = at_size_zero(sizes, [row[key] for row in rows], scatter_of_pours(rows, key))
        limit.update({key: round(value.value, 4), error: round(value.error, 4)})
    return limit


def draw(path: Path, rows: Sequence[Row], limit: Row) -> None:
    """Lateral and longitudinal force and sinkage over the size of the grains."""
    figure, panels = plt.subplots(1, len(LABELS), figsize=(11, 3.4))
    for panel, (key, label) in zip(panels, LABELS.items()):
        for found, marker in ((rows, "o"), ([{**limit, "size_mm": 0.0}], "D")):
            panel.errorbar(
                [row["size_mm"] for row in found],
                [row[key] for row in found],
                [row[ERRORS[key]] for row in found],
                fmt=marker, color="tab:cyan", ms=5, capsize=3,
            )  # fmt: skip
        panel.set(xlabel="grains [mm]; 0: the limit", ylabel=label)
        panel.grid(alpha=0.3)
    save(figure, path, dpi=75)


def evaluate(runner: Runner, output: Output) -> list[str]:
    rows = [row_of(runner, case, record) for case in RUNS if (record := runner.record(case))]
    for row in rows:
        row["grains_in_width"] = round(WIDTH / row["size_mm"], 1)
    output.table("slip_angle.csv", rows)
    if len({row["size_mm"] for row in rows}) < 3:
        return []
    limit = limit_of(rows)
    output.table("slip_angle_limit.csv", [limit])
    draw(output.path("slip_angle.png"), rows, limit)
    coarse, fine = rows[0], min(rows, key=lambda row: float(row["size_mm"]))
    apart = abs(coarse["fy_over_fz"] - fine["fy_over_fz"])
    return [f"Fy/Fz differs by {apart:.3f} between sizes"] if apart > APART else []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", RUNS, evaluate)))
