# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs of grounds.py: grounds.csv, best_estimates.csv, accuracy.csv, grounds.png."""

import csv
import math
import subprocess
from collections.abc import Mapping, Sequence
from itertools import combinations
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import cases

from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.analyse.statistics import rms
from furrow_post.csv_table import read_rows
from furrow_post.figures.style import save
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner

# [m] of travel, for the steady values: from its end; run.py's ends beyond the last row of some of
# these runs
WINDOW = (0.1, 0.002)
RADIUS = 58.0  # [mm]
QUANTITIES = {"fx_over_fz": "fx_over_fz_error", "sinkage_mm": "sinkage_error_mm"}
LIMIT_COLUMNS = tuple(
    column
    for key, error in QUANTITIES.items()
    for column in ("measured_" + key, key, error, f"{key}_order")
)
Row = dict[str, Any]  # of a table

GRAINS, CONTINUUM = "grains", "continuum"
STRONG, BETWEEN = (f", rolling friction {value:g}" for value in (0.5, 0.35))
COLOURS = {
    GRAINS: "tab:blue",
    CONTINUUM: "tab:red",
    GRAINS + BETWEEN: "tab:cyan",
    GRAINS + STRONG: "tab:green",
    CONTINUUM + STRONG: "tab:orange",
}


def surface_over_grain() -> float:
    """Effective surface above the level of the mass, fitted on the plates by run.py."""
    rows = {row["candidate"]: row for row in read_rows(cases.HERE / "calibration.csv")}
    return float(rows[cases.CHOSEN]["surface_over_grain"])


def ground_of(case: Case) -> str:
    ground = GRAINS if "rolling" in case.variables else CONTINUUM
    named = {"rolling_0.5": STRONG, "rolling_0.35": BETWEEN}
    return ground + "".join(words for part, words in named.items() if part in case.name)


def wheel_of(case: Case) -> str:
    """One of cases.WHEELS."""
    return "grouser" if float(str(case.variables.get("grouser_height", 0.0))) else "smooth"


def what_of(case: Case) -> str:
    """What is changed beside size and slip."""
    changed = [
        f"{words} {case.variables[key]}"
        for key, base, words in (
            ("slip_angle", 0.0, "slip angle"),
            ("wall_friction", cases.WHEEL_FRICTION, "friction of wheel and sand"),
            ("width", cases.WHEEL_BED["width"], "width"),
        )
        if case.variables.get(key, base) != base
    ]
    if case.variables.get("seed", cases.BASE["seed"]) != cases.BASE["seed"]:
        changed.append("another pour")
    return ", ".join(changed)


def steady_values(runner: Runner, folder: Path, travel: float) -> dict[str, float]:
    """furrow-resistance's own evaluation over the last part of the travel [m]."""
    program = runner.tools.program("furrow-resistance")
    window = [f"{travel - end:.4g}" for end in WINDOW]
    command = [str(program), "--csv", "--distance", *window, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    row = next(csv.DictReader(done.stdout.splitlines()))
    return {key: float(value) for key, value in row.items() if key != "folder"}


def row_of(runner: Runner, case: Case, record: Record) -> Row:
    values = steady_values(runner, runner.folder(case), float(str(case.variables["travel"])))
    ground = ground_of(case)
    size = 1000 * float(str(case.variables["diameter" if ground.startswith(GRAINS) else "cell"]))
    surface = surface_over_grain() * size if ground.startswith(GRAINS) else 0.0
    point = cases.nearest_point(wheel_of(case), float(str(case.variables["slip"])))
    sideways = "slip_angle" in case.variables
    fz = values["force_z"]
    return {
        "run": case.name,
        "ground": ground,
        "size_mm": round(size, 2),
        "changed": what_of(case),
        "slip": point["slip"],
        "measured_fx_over_fz": "" if sideways else round(point["force_N"] / point["load_N"], 4),
        "fx_over_fz": round(-values["resistance_coefficient"], 4),
        "fx_over_fz_error": round(values["resistance_coefficient_error"], 4),
        "measured_sinkage_mm": "" if sideways else point["sinkage_mm"],
        "sinkage_mm": round(1000 * values["hub_drop"] + surface, 2),
        "sinkage_error_mm": round(1000 * values["sinkage_error"], 2),
        "fy_over_fz": round(values["lateral_force"] / fz, 4) if sideways else "",
        "fy_over_fz_error": round(values["lateral_force_error"] / fz, 4) if sideways else "",
        "torque_over_fz_r": round(1000 * values["drive_torque"] / fz / RADIUS, 4),
        "cpu_s": round(record.cpu_time + record.system_time, 1),
    }


def straight(rows: Sequence[Row]) -> list[Row]:
    """Those with nothing changed but size, slip, law and pour."""
    return [row for row in rows if row["changed"] in ("", "another pour")]


def scatter_of_pours(rows: Sequence[Row], key: str) -> float:
    """Standard deviation of one run, from pairs of pours."""
    pairs = [
        one[key] - other[key]
        for one, other in combinations(rows, 2)
        if all(one[same] == other[same] for same in ("ground", "size_mm", "slip"))
    ]
    return rms(pairs) / math.sqrt(2.0) if pairs else math.nan


def limit_of(
    rows: Sequence[Row], pours: Mapping[str, float], errors: Mapping[str, str] = QUANTITIES
) -> Row:
    """Of one ground at one slip: the best estimate of all its sizes.

    pours: standard deviation of a run on grains from one pour to the next, by quantity; a continuum
    has none, and its error in time counts. errors: columns of the quantities' errors.
    """
    poured = rows[0]["ground"].startswith(GRAINS)
    sizes = [row["size_mm"] for row in rows]
    found: Row = {}
    for key, error in errors.items():
        scatter = pours[key] if poured else rms([row[error] for row in rows])
        series = grid_convergence(sizes, [row[key] for row in rows], [scatter] * len(rows))
        found.update({key: round(series.value, 4), error: round(series.error, 4)})
        found[f"{key}_order"] = round(series.used_order, 2) if series.extrapolated else ""
    return found


def limit_table(rows: Sequence[Row]) -> list[Row]:
    """A row for each ground and slip with two sizes or more."""
    rows = straight(rows)
    pours = {key: scatter_of_pours(rows, key) for key in QUANTITIES}
    found = []
    for ground in COLOURS:
        for slip in sorted({row["slip"] for row in rows}):
            mine = [row for row in rows if row["ground"] == ground and row["slip"] == slip]
            sizes = [row["size_mm"] for row in mine]
            if len(set(sizes)) < 2:
                continue
            head = {"ground": ground, "slip": slip, "runs": len(mine), "finest_mm": min(sizes)}
            limit = {**mine[0], **limit_of(mine, pours)}
            found.append({**head, **{name: limit[name] for name in LIMIT_COLUMNS}})
    return found


def accuracy(rows: Sequence[Row]) -> float:
    """rms of Fx/Fz over all rows; pours of one point count as their mean."""
    points: dict[float, list[Row]] = {}
    for row in rows:
        points.setdefault(row["slip"], []).append(row)
    return rms(
        [
            float(np.mean([row["fx_over_fz"] for row in mine])) - mine[0]["measured_fx_over_fz"]
            for mine in points.values()
        ]
    )


def accuracy_table(rows: Sequence[Row], limits: Sequence[Row]) -> list[Row]:
    """A row for each ground and size that has all slips."""
    slips = {row["slip"] for row in rows}
    sized = [*rows, *({**row, "size_mm": 0.0} for row in limits)]
    found = []
    for ground in COLOURS:
        for size in sorted({row["size_mm"] for row in sized}, reverse=True):
            mine = [r for r in sized if r["ground"] == ground and r["size_mm"] == size]
            if {row["slip"] for row in mine} == slips:
                found.append(
                    {"ground": ground, "size_mm": size, "rms_fx_over_fz": round(accuracy(mine), 3)}
                )
    return found


def report(
    runner: Runner, output: Output, runs: Sequence[Case]
) -> dict[tuple[str, float], float]:
    """@return rms of Fx/Fz of each ground and size [mm]"""
    rows = [row_of(runner, case, record) for case in runs if (record := runner.record(case))]
    output.table("grounds.csv", rows)
    limits = limit_table(rows)
    output.table("best_estimates.csv", limits)
    reached = accuracy_table(straight(rows), limits)
    output.table("accuracy.csv", reached)
    if limits:
        draw(output.path("grounds.png"), straight(rows), limits)
    return {(row["ground"], row["size_mm"]): row["rms_fx_over_fz"] for row in reached}


def draw(path: Path, rows: Sequence[Row], limits: Sequence[Row]) -> None:
    """A column for each slip: Fx/Fz above, sinkage below, against the size."""
    slips = sorted({row["slip"] for row in limits})
    figure, axes = plt.subplots(
        2, len(slips), figsize=(4 * len(slips), 6), sharex=True, sharey="row", squeeze=False
    )
    for line, (key, error), label in zip(axes, QUANTITIES.items(), ("Fx/Fz", "sinkage [mm]")):
        for panel, slip in zip(line, slips):
            for ground, colour in COLOURS.items():
                for table, marker in ((rows, "o"), (limits, "D")):
                    mine = [r for r in table if r["ground"] == ground and r["slip"] == slip]
                    panel.errorbar(
                        [r.get("size_mm", 0.0) for r in mine],
                        [r[key] for r in mine],
                        [r[error] for r in mine],
                        fmt=marker, color=colour, ms=5, capsize=3,
                        label=ground if marker == "o" and mine else None,
                    )  # fmt: skip
            measured = next(r["measured_" + key] for r in rows if r["slip"] == slip)
            panel.axhline(measured, color="black", lw=1, label="measured")
            panel.grid(alpha=0.3)
        line[0].set_ylabel(label)
    for panel, slip in zip(axes[0], slips):
        panel.set_title(f"slip {slip:g}")
    for panel in axes[1]:
        panel.set_xlabel("grains or cells [mm]; 0: best estimate")
    axes[0][0].legend(fontsize=7)
    save(figure, path, dpi=75)
