#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The wheel with grousers of CMU's tests on finer grains, by the law that was found with the smooth
one, and what its forces depend on that was not measured. See README.md.

Makes the runs that are missing and writes grousers.csv, grousers_best_estimates.csv,
grousers_accuracy.csv, grousers_assumed.csv and grousers.png. Loads and slips are those measured;
nothing was fitted to this wheel. Stages: sizes assumed.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
from grounds import BETWEEN, FASTEST, SOFT, Changes, grains_case
from grounds_report import BETWEEN as BETWEEN_LAW
from grounds_report import (
    GRAINS,
    LIMIT_COLUMNS,
    QUANTITIES,
    RADIUS,
    Row,
    accuracy,
    limit_of,
    row_of,
    scatter_of_pours,
)

import matplotlib.pyplot as plt

from furrow_post.analyse.statistics import rms
from furrow_post.csv_table import read_rows
from furrow_post.figures.style import save
from furrow_post.study.case import Case, Value
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

KIND = "grouser"
SLIPS = (-0.001, 0.21, -0.203, 0.5, -0.5, 0.75)  # breadth first
NOT_FITTED: Changes = {"rolling": BETWEEN}
SIZES = (6, 8, 10)  # [mm]
SIZE_RUNS = [grains_case("sizes", size, slip, 1, NOT_FITTED, KIND) for size in SIZES for slip in SLIPS]
# What is not measured, changed one by one with the coarsest grains, at the slips of the largest
# misses
MISSED = (-0.5, 0.75)
ASSUMPTIONS: dict[str, Changes] = {
    "bed 0.12 m deep": {"depth": 0.12},
    "12 bars of 3.3 mm": {"grousers": cases.bars_of(12)},
    "friction of wheel and sand 0.4": {"wall_friction": 0.4},
    "0.48 m of travel, bed 0.70 m long": {"travel": 0.48, "length": 0.70},
}


def assumed_case(what: str, slip: float) -> Case:
    point = cases.nearest_point(KIND, slip)
    values: dict[str, Value] = {"diameter": 0.010, "young": SOFT, **NOT_FITTED, **ASSUMPTIONS[what]}
    name = f"assumed_{what.replace(' ', '_').replace(',', '')}_slip_{slip:g}"
    return cases.wheel_case(name, "assumed", point, what, cases.CHOSEN, FASTEST, **values)


ASSUMED = [assumed_case(what, slip) for slip in MISSED for what in ASSUMPTIONS]
RUNS = [*SIZE_RUNS, *ASSUMED]
# What was reached, plus the scatter from one pour to the next: size of the grains [mm] -> rms
REACHED = {8.0: 0.15, 6.0: 0.12}
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


def scatter_of_smooth(key: str) -> float:
    """Standard deviation of one run from one pour to the next, of the smooth wheel on these grains:
    the wheel with grousers has one pour."""
    rows = [row for row in read_rows(cases.HERE / "grounds.csv") if not row["fy_over_fz"]]
    mine = [row for row in rows if row["ground"] == GRAINS + BETWEEN_LAW]
    return scatter_of_pours([{**row, key: float(row[key])} for row in mine], key)


def limits_of(rows: Sequence[Row]) -> list[Row]:
    """Best estimates: a row for each slip that has all sizes."""
    pours = {key: scatter_of_smooth(key) for key in QUANTITIES}
    found = []
    for slip in sorted({row["slip"] for row in rows}):
        mine = [row for row in rows if row["slip"] == slip]
        if len(mine) == len(SIZES):
            found.append({**mine[0], "size_mm": 0.0, **limit_of(mine, pours)})
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
                fmt="o--" if size else "D", ms=4, capsize=3,
                label=f"{mine[0]['ground']}, {f'{size:g} mm' if size else 'best estimate'}",
            )  # fmt: skip
        panel.set(xlabel="slip", ylabel=label)
        panel.grid(alpha=0.3)
    panels[0].legend(fontsize=7)
    save(figure, path, dpi=75)


def evaluate(runner: Runner, output: Output) -> list[str]:
    rows, assumed = (
        [{**row_of(runner, case, record), "changed": case.what}
         for case in runs if (record := runner.record(case))]
        for runs in (SIZE_RUNS, ASSUMED)
    )  # fmt: skip
    output.table("grousers_assumed.csv", assumed)
    if not rows:
        return []
    output.table("grousers.csv", rows)
    limits = limits_of(rows)
    columns = ("ground", "slip", *LIMIT_COLUMNS)
    output.table("grousers_best_estimates.csv", [{k: row[k] for k in columns} for row in limits])
    reached = accuracy_rows([*rows, *limits])
    output.table("grousers_accuracy.csv", reached)
    draw(output.path("grousers.png"), [*rows, *limits])
    return [
        f"{row['size_mm']:g} mm: rms of Fx/Fz is {row['rms_fx_over_fz']}, limit {limit}"
        for row in reached
        if row["rms_fx_over_fz"] > (limit := REACHED.get(row["size_mm"], 1.0))
    ]


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", RUNS, evaluate)))
