#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The smooth wheel of CMU's tests at a slip angle: up to 16 grains in its width. See README.md.

Makes the runs that are missing and writes slip_angle.csv, slip_angle_best_estimates.csv and slip_angle.png.
The laws of the grains are the one that was found at slip angle 0 and a stronger one.
"""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

from grounds import BETWEEN, SIDEWAYS, STRONG_SOIL, Changes, continuum_case, grains_case
from grounds_report import QUANTITIES, Row, limit_of, row_of, scatter_of_pours

import matplotlib.pyplot as plt

from furrow_post.figures.style import save
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

STRONGER = 0.5  # rolling friction
WIDTH = 50.0  # [mm] of the wheel
FINEST = 3.1  # [mm] 16 grains in the wheel's width
COLOURS = {
    "grains, rolling friction 0.35": "tab:cyan",
    "grains, rolling friction 0.5": "tab:green",
    "continuum, rolling friction 0.5": "tab:orange",
}
LABELS = {"fy_over_fz": "Fy/Fz", "fx_over_fz": "Fx/Fz", "sinkage_mm": "sinkage [mm]"}
# Fy/Fz with the finest grains that were run, less and plus twice the scatter of pours
REACHED = {
    "grains, rolling friction 0.35": (0.25, 0.37),
    "grains, rolling friction 0.5": (0.31, 0.43),
    "continuum, rolling friction 0.5": (0.2, 0.6),
}
ERRORS = {"fy_over_fz": "fy_over_fz_error", **QUANTITIES}


def run_of(rolling: float, size: float, pour: int = 1) -> Case:
    """size [mm]"""
    changes: Changes = {"rolling": rolling, **SIDEWAYS}
    case = grains_case("sizes", size, 0.0, pour, changes)
    return replace(case, ranks=2) if size == FINEST else case


RUNS = [
    *(
        run_of(rolling, size, pour)
        for rolling in (BETWEEN, STRONGER)
        for size, pour in ((10, 1), (10, 2), (8, 1), (8, 2), (6, 1))
    ),
    run_of(BETWEEN, FINEST),
    *(
        continuum_case(
            "continuum", cell, 0.0, {"material": STRONG_SOIL, **SIDEWAYS, "symmetry": "no"}
        )
        for cell in (10, 7)
    ),
]


def draw(path: Path, rows: Sequence[Row], limits: Sequence[Row]) -> None:
    """Lateral and longitudinal force and sinkage over the size of the grains."""
    figure, panels = plt.subplots(1, len(LABELS), figsize=(11, 3.6), layout="constrained")
    best = [{**limit, "size_mm": 0.0} for limit in limits]
    for panel, (key, label) in zip(panels, LABELS.items()):
        for ground, colour in COLOURS.items():
            for found, marker, name in ((rows, "o", ground), (best, "D", None)):
                mine = [row for row in found if row["ground"] == ground]
                panel.errorbar(
                    [row["size_mm"] for row in mine],
                    [row[key] for row in mine],
                    [row[ERRORS[key]] for row in mine],
                    fmt=marker, color=colour, ms=5, capsize=3, label=name,
                )  # fmt: skip
        panel.set(xlabel="grains [mm]; 0: best estimate", ylabel=label)
        panel.grid(alpha=0.3)
    panels[1].legend(fontsize=7)
    save(figure, path, dpi=75)


def evaluate(runner: Runner, output: Output) -> list[str]:
    rows = [row_of(runner, case, record) for case in RUNS if (record := runner.record(case))]
    for row in rows:
        row["grains_in_width"] = round(WIDTH / row["size_mm"], 1)
    output.table("slip_angle.csv", rows)
    scatter = {key: scatter_of_pours(rows, key) for key in ERRORS}
    by_law = [[row for row in rows if row["ground"] == ground] for ground in COLOURS]
    known = [mine for mine in by_law if len({row["size_mm"] for row in mine}) > 1]
    finest = [min(mine, key=lambda row: float(row["size_mm"])) for mine in known]
    limits = [
        {
            "ground": last["ground"],
            "finest_mm": last["size_mm"],
            "runs": len(mine),
            **limit_of(mine, scatter, ERRORS),
        }
        for mine, last in zip(known, finest)
    ]
    output.table("slip_angle_best_estimates.csv", limits)
    draw(output.path("slip_angle.png"), rows, limits)
    return [
        f"{row['ground']}, {row['size_mm']:g} mm: Fy/Fz is {row['fy_over_fz']}, not {low} to {high}"
        for row in finest
        if not (low := REACHED[row["ground"]][0])
        <= row["fy_over_fz"]
        <= (high := REACHED[row["ground"]][1])
    ]


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", RUNS, evaluate)))
