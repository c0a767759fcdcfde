#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The wheel with grousers of CMU's tests on finer grains, by the law that was found with the smooth
one. See README.md.

Makes the runs that are missing and writes grousers.csv, grousers_accuracy.csv and grousers.png.
Loads and slips are those measured; nothing was fitted to this wheel.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
from grounds import BETWEEN, Changes, grains_case
from grounds_report import QUANTITIES, RADIUS, Row, accuracy, row_of

import matplotlib.pyplot as plt

from furrow_post.analyse.statistics import rms
from furrow_post.figures.style import save
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

KIND = "grouser"
SLIPS = (-0.001, 0.21, -0.203, 0.5, -0.5, 0.75)  # breadth first
BLIND: Changes = {"rolling": BETWEEN}
SIZES = (6, 8, 10)  # [mm]
RUNS = [grains_case(f"{size} mm", size, slip, 1, BLIND, KIND) for size in SIZES for slip in SLIPS]
# What was reached, plus the scatter from one pour to the next: size of the grains [mm] -> rms
REACHED = {8.0: 0.15}
MEASURED = (
    ("fx_over_fz", "Fx/Fz", "force_N", "force_std_N"),
    ("sinkage_mm", "sinkage [mm]", "sinkage_mm", "sinkage_std_mm"),
)


def by_size(rows: Sequence[Row]) -> dict[float, list[Row]]:
    found: dict[float, list[Row]] = {}
    for row in rows:
        found.setdefault(row["size_mm"], []).append(row)
    return found


def accuracy_rows(rows: Sequence[Row]) -> list[Row]:
    """A row for each size: rms over the slips that were run."""
    found = []
    for size, mine in by_size(rows).items():
        sinkages = [row["sinkage_mm"] - row["measured_sinkage_mm"] for row in mine]
        found.append(
            {
                "ground": mine[0]["ground"],
                "size_mm": size,
                "slips": len(mine),
                "rms_fx_over_fz": round(accuracy(mine), 3),
                "rms_sinkage_over_r": round(rms(sinkages) / RADIUS, 3),
            }
        )
    return found


def draw(path: Path, rows: Sequence[Row]) -> None:
    """Fx/Fz and sinkage over the slip, measured and computed."""
    measured = sorted(cases.wheel_points(KIND), key=lambda point: point["slip"])
    slips = [point["slip"] for point in measured]
    figure, panels = plt.subplots(1, 2, figsize=(10, 4))
    for panel, (key, label, column, scatter) in zip(panels, MEASURED):
        loads = [point["load_N"] if key == "fx_over_fz" else 1.0 for point in measured]
        values = [point[column] / load for point, load in zip(measured, loads)]
        errors = [point[scatter] / load for point, load in zip(measured, loads)]
        panel.errorbar(slips, values, errors, fmt="s-", color="black", capsize=3, label="measured")
        for size, unsorted in by_size(rows).items():
            mine = sorted(unsorted, key=lambda row: float(row["slip"]))
            panel.errorbar(
                [row["slip"] for row in mine],
                [row[key] for row in mine],
                [row[QUANTITIES[key]] for row in mine],
                fmt="o--", ms=4, capsize=3, label=f"{mine[0]['ground']}, {size:g} mm",
            )  # fmt: skip
        panel.set(xlabel="slip", ylabel=label)
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=7)
    save(figure, path, dpi=75)


def evaluate(runner: Runner, output: Output) -> list[str]:
    rows = [row_of(runner, case, record) for case in RUNS if (record := runner.record(case))]
    if not rows:
        return []
    output.table("grousers.csv", rows)
    reached = accuracy_rows(rows)
    output.table("grousers_accuracy.csv", reached)
    draw(output.path("grousers.png"), rows)
    return [
        f"{row['size_mm']:g} mm: rms of Fx/Fz is {row['rms_fx_over_fz']}, limit {limit}"
        for row in reached
        if row["rms_fx_over_fz"] > (limit := REACHED.get(row["size_mm"], 1.0))
    ]


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", RUNS, evaluate)))
