# SPDX-License-Identifier: GPL-2.0-or-later
"""Peaks of the load on plates, and the figures of loads and of densities."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

from furrow_post.analyse.evaluations import plate_curve
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError
from furrow_post.figures.style import save
from furrow_post.figures.terrain import draw_density_section
from furrow_post.read.terrain import Terrain, read_terrain_history
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

REFERENCE = read_numbers(Path(__file__).resolve().parent / "reference.csv")[0]
SPEED = 0.5  # [m/s] of the scene
DENSITY = 200.0  # [kg/m3] before
GOAL = 0.25  # of the measured peak
IN_DENSITY_FIGURE = ("fresh", "oedometer", "foam", "field")


def row_of(run: Run) -> dict[str, Any]:
    curve = plate_curve(run.folder)
    reached = float(curve[:, 1].max()) if curve.size else 0.0
    row: dict[str, Any] = {
        "case": run.name,
        "what": run.what,
        "user_s": run.seconds,
        "sinkage_reached_m": round(reached, 4),
        "failure": run.error,
    }
    if run.error:
        return row
    if not curve.size:
        raise ResultsError(f"{run.folder}/curve.txt: has no rows; make the run again: remove its folder")
    peak = curve[:, 2].max()
    last = curve[:, 1] > reached - 0.005  # the load at the end, over half a centimetre
    history = read_terrain_history(run.folder)
    area = math.pi / 4 * REFERENCE["diameter_m"] ** 2
    row["peak_N"] = round(peak)
    row["peak_over_measured"] = round(peak / REFERENCE["peak_load_N"], 3)
    row["end_N"] = round(curve[last, 2].mean())
    row["inertia_N"] = round(run.number("speed", SPEED) ** 2 * DENSITY * area, 1)
    loss = history["numerical_loss"][-1] / history["contact_work"][-1]
    row["numerical_loss"] = round(float(loss), 4)
    return row


def draw_curves(runs: Runs, target: Path) -> None:
    """Load against sinkage of the cap laws and of the foam law as it is; dotted: stopped."""
    figure, axes = plt.subplots(figsize=(7, 4.5), constrained_layout=True)
    for run in (*runs.ended("cap"), *runs.ended("foam")):
        if run.name.startswith("foam_"):
            continue
        curve = plate_curve(run.folder)
        style, colour = ":" if run.error else "-", "k" if run.name == "foam" else None
        axes.plot(100 * curve[:, 1], curve[:, 2] / 1e3, lw=1.1, ls=style, color=colour, label=run.what)
    peak = REFERENCE["peak_load_N"] / 1e3
    axes.plot(100 * REFERENCE["sinkage_m"], peak, "k*", ms=12, label="measured peak")
    low, high = (1 - GOAL) * peak, (1 + GOAL) * peak
    axes.axhspan(low, high, color="0.9", zorder=0, label=f"goal: {100 * GOAL:.0f} %")
    axes.set(xlabel="sinkage [cm]", ylabel="load [kN]", ylim=(0, 5), xlim=(0, 24))
    axes.legend(frameon=False, fontsize=8)
    save(figure, target, dpi=90)


def draw_density(runs: Runs, target: Path) -> None:
    """Density under the plate at the end, of the laws that came to the end."""
    shown = [run for name in IN_DENSITY_FIGURE if (run := runs.one(name))]
    if not shown:
        return
    figure, panels = plt.subplots(
        1, len(shown), figsize=(4.6 * len(shown), 4.4), constrained_layout=True, squeeze=False
    )
    for axes, run in zip(panels[0], shown):
        snow = Terrain.read(run.folder)
        draw_density_section(figure, axes, snow, 0, 0.5 * snow.spacing)
        axes.set_title(run.what, fontsize=9)
    save(figure, target, dpi=90)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    for name, stage in (("results.csv", "cap"), ("foam.csv", "foam")):
        output.table(name, [row_of(run) for run in runs.ended(stage)])
    if runs.ended("cap", "foam"):
        draw_curves(runs, output.path("curves.png"))
        draw_density(runs, output.path("density.png"))
    return []
