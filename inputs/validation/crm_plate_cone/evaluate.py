# SPDX-License-Identifier: GPL-2.0-or-later
"""Sinkage of the plate, resistance of the cone: at zero cell size, with the effect of the speed."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.evaluations import whole_plate_curve
from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.arrays import Floats
from furrow_post.figures.style import KILOPASCAL, MILLIMETRE, save, use_style
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

PRESSURES = (10e3, 20e3, 30e3)  # [Pa] of the plate
DEPTHS = (0.05, 0.10, 0.15)  # [m] of the apex of the cone
WINDOW = 0.005  # [m] on both sides of a depth
SMOOTHED = 0.004  # [m] of the curves of the cone in the figure

Row = dict[str, Any]


def resistance(curve: Floats, depth: float) -> float:
    """Pressure [Pa] on the base of the cone at a depth, of a straight line through its window."""
    near = np.abs(curve[:, 1] - depth) < WINDOW
    return float(np.polyval(np.polyfit(curve[near, 1] - depth, curve[near, 3], 1), 0.0))


def numbers(run: Run) -> Row:
    curve = whole_plate_curve(run.folder)
    if run.case.stage == "plate":
        sinkage, pressure = MILLIMETRE * curve[:, 1], curve[:, 3]
        return {
            f"sinkage_{KILOPASCAL * p:.0f}_mm": float(np.interp(p, pressure, sinkage))
            for p in PRESSURES
        }
    return {f"resistance_{100 * d:.0f}_kPa": KILOPASCAL * resistance(curve, d) for d in DEPTHS}


def is_of_series(run: Run) -> bool:
    """Whether it differs from others in the size of cells alone."""
    return run.name.count("_") == 1


def row_of(run: Run) -> Row:
    facts = run.record.facts
    values = {key: round(value, 2) for key, value in numbers(run).items()}
    return {"case": run.name, "what": run.what, "user_s": run.seconds, **facts, **values}


def estimates(runs: Runs) -> list[Row]:
    """Each quantity at zero cell size.

    The cone of these series moves at one speed. Slower runs in coarse cells give the ratio of its
    resistance at zero speed. This ratio may be another in finer cells, so the estimate is the
    middle between it and 1, and half of their distance is a standard error.
    """
    found: list[Row] = []
    for stage in ("plate", "cone"):
        series = [run for run in runs.done(stage) if is_of_series(run)]
        slower = runs.done("cone_7", "cone_7_half", "cone_7_quarter") if stage == "cone" else []
        for quantity in numbers(series[0]) if len(series) > 2 else ():
            cells = grid_convergence(
                [run.number("cell") for run in series], [numbers(run)[quantity] for run in series]
            )
            ratio, ratio_error = 1.0, 0.0
            if len(slower) > 2:
                by_speed = grid_convergence(
                    [run.number("speed") for run in slower],
                    [numbers(run)[quantity] for run in slower],
                )
                fast = numbers(slower[0])[quantity]
                ratio, ratio_error = by_speed.value / fast, by_speed.error / fast
            middle, spread = 0.5 * (1.0 + ratio), 0.5 * (1.0 - ratio)
            value = cells.value * middle
            parts = (cells.error * middle, cells.value * spread, cells.value * ratio_error)
            error = float(np.linalg.norm(parts))
            found.append(
                {
                    "quantity": quantity,
                    "best_estimate": round(value, 2),
                    "error": round(error, 2),
                    "order": round(cells.order, 2),
                    "extrapolated": "yes" if cells.extrapolated else "no",
                    "speed_ratio": round(ratio, 3),
                    "speed_error": round(ratio_error, 3),
                }
            )
    return found


def smooth(curve: Floats) -> Floats:
    """Sinkage and pressure, means over SMOOTHED of travel."""
    bins = (curve[:, 1] / SMOOTHED).astype(int)
    return np.array([curve[bins == k][:, [1, 3]].mean(axis=0) for k in np.unique(bins)])


def draw(runs: Runs, best: Sequence[Mapping[str, Any]], target: Path) -> None:
    use_style()
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), layout="constrained")
    for axes, stage in ((left, "plate"), (right, "cone")):
        for run in runs.done(stage):
            curve = whole_plate_curve(run.folder)
            style = "-" if is_of_series(run) else "--"
            shown = smooth(curve) if stage == "cone" else curve[:, [1, 3]]
            x, y = KILOPASCAL * shown[:, 1], MILLIMETRE * shown[:, 0]
            axes.plot(x, y, style, lw=1.1, label=run.what)
        axes.invert_yaxis()
        axes.legend(fontsize=7)
    by_name = {row["quantity"]: row for row in best}
    for pressure in PRESSURES:
        row = by_name[f"sinkage_{KILOPASCAL * pressure:.0f}_mm"]
        y, error = row["best_estimate"], 2 * row["error"]
        left.errorbar(KILOPASCAL * pressure, y, yerr=error, fmt="kD", capsize=3)
    for depth in DEPTHS:
        row = by_name[f"resistance_{100 * depth:.0f}_kPa"]
        x, error = row["best_estimate"], 2 * row["error"]
        right.errorbar(x, MILLIMETRE * depth, xerr=error, fmt="kD", capsize=3)
    left.set(xlabel="pressure on the plate [kPa]", ylabel="sinkage [mm]", xlim=(0, 32), ylim=(6, 0))
    right.set(xlabel="cone resistance [kPa]", ylabel="depth of the apex [mm]", xlim=(0, 450))
    save(figure, target)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    rows = [row_of(run) for run in runs.done("plate", "cone")]
    best = estimates(runs)
    output.table("results.csv", rows)
    output.table("best_estimates.csv", best)
    if len(best) == len(PRESSURES) + len(DEPTHS):
        draw(runs, best, output.path("curves.png"))
    return []
