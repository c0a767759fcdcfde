# SPDX-License-Identifier: GPL-2.0-or-later
"""Pull, torque and hub drop of one run with a ramp of the slip, at the slips of steady runs."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.figures.style import annotate_panel, save, use_style
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

STRETCHES = {"continuum": 9, "scm": 20}  # of the cruise with the ramp
QUANTITIES = {"net_traction_coefficient": 0.02, "drive_torque": 0.05, "hub_drop": 0.02}
RELATIVE = ("drive_torque", "hub_drop")  # whose limit is a share of the value

Row = dict[str, float]


def at_slip(curve: Sequence[Row], slip: float, quantity: str) -> tuple[float, float]:
    """Value and standard error, linear between two stretches."""
    slips = [row["slip"] for row in curve]
    mean, error = (
        float(np.interp(slip, slips, [row[name] for row in curve]))
        for name in (quantity, f"{quantity}_error")
    )
    return mean, error


def rows_of(runs: Runs, ground: str, steady: Sequence[Run], curve: Sequence[Row]) -> list[dict[str, Any]]:
    rows = []
    for run in steady:
        (point,) = runs.resistance(run, "--csv")
        for quantity, limit in QUANTITIES.items():
            value, error = point[quantity], point[f"{quantity}_error"]
            ramp, ramp_error = at_slip(curve, point["slip"], quantity)
            allowed = limit * value if quantity in RELATIVE else limit
            rows.append(
                {
                    "ground": ground,
                    "slip": round(point["slip"], 4),
                    "quantity": quantity,
                    "steady": f"{value:.5g}",
                    "steady_error": f"{error:.2g}",
                    "ramp": f"{ramp:.5g}",
                    "ramp_error": f"{ramp_error:.2g}",
                    "difference": f"{ramp - value:.2g}",
                    "difference_error": f"{math.hypot(error, ramp_error):.2g}",
                    "limit": f"{allowed:.2g}",
                }
            )
    return rows


def draw(curves: dict[str, list[Row]], rows: Sequence[dict[str, Any]], target: Path) -> None:
    use_style()
    figure, panels = plt.subplots(1, len(curves), figsize=(8.0, 3.4), layout="constrained")
    for letter, axes, (ground, curve) in zip("ab", panels, curves.items()):
        slips = [row["slip"] for row in curve]
        pull = [row["net_traction_coefficient"] for row in curve]
        bars = [2.0 * row["net_traction_coefficient_error"] for row in curve]
        axes.errorbar(slips, pull, bars, fmt="-", capsize=2, lw=1.2, label="one run, ramp")
        points = [r for r in rows if r["ground"] == ground and r["quantity"] == "net_traction_coefficient"]
        axes.errorbar(
            [r["slip"] for r in points],
            [float(r["steady"]) for r in points],
            [2.0 * float(r["steady_error"]) for r in points],
            fmt="o", color="k", capsize=2, label="constant slip",
        )  # fmt: skip
        axes.set(xlabel="slip", ylabel="net traction coefficient")
        axes.legend(fontsize=8, loc="lower right")
        annotate_panel(axes, letter, ground)
    save(figure, target)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    rows: list[dict[str, Any]] = []
    curves = {}
    for ground, stretches in STRETCHES.items():
        ramp = runs.one(f"{ground}/ramp")
        steady = [run for run in runs.done(ground) if run is not ramp and not run.name.endswith("ramp")]
        if ramp is None or len(steady) < 3:
            return [f"not every run on {ground} is there"]
        curves[ground] = runs.resistance(ramp, "--curve", stretches)
        rows += rows_of(runs, ground, steady, curves[ground])
    output.table("results.csv", rows)
    draw(curves, rows, output.path("curves.png"))
    return [
        f"{row['ground']}, slip {row['slip']}: {row['quantity']} of the ramp differs by "
        f"{row['difference']}, limit {row['limit']}"
        for row in rows
        if abs(float(row["difference"])) > float(row["limit"]) + 2.0 * float(row["difference_error"])
    ]
