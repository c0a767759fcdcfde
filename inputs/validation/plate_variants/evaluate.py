# SPDX-License-Identifier: GPL-2.0-or-later
"""Load, densities below and next to the plate, best estimates of the peak, the figure of layers."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.evaluations import whole_plate_curve
from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.figures.style import save
from furrow_post.read.terrain import Terrain, read_terrain_history
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

REFERENCE = read_numbers(Path(__file__).resolve().parent / "reference.csv")[0]  # peak_load_N, density_1
RADIUS, DEPTH = 0.1016, 0.5  # [m] of the plate, of the snow
COARSE = 0.0416667  # [m] cells
SIZES = {"": COARSE, "_31": 0.03125, "_25": 0.025, "_20": 0.02}  # suffix of a run -> cells [m]
LAYERS = 10
UNDER = 0.8  # of the plate's radius: where densities below it are taken
BESIDE = (0.02, 0.08)  # [m] from its edge: where those next to it are taken
MEASURED = np.array([REFERENCE[f"density_{n}"] for n in range(1, LAYERS + 1)])

Row = dict[str, Any]


def field_numbers(run: Run) -> Row:
    """The greatest force and where it is; rising: how much more the last 2 cm bring, per cm."""
    curve = whole_plate_curve(run.folder)
    sinkage, load = curve[:, 1], curve[:, 2]
    last = sinkage > sinkage[-1] - 0.02
    slope = np.polyfit(100 * sinkage[last], load[last], 1)[0] / load[last].mean()
    return {
        "peak_N": round(load.max()),
        "at_cm": round(100 * float(sinkage[load.argmax()]), 1),
        "at_10_cm_N": round(float(np.interp(0.1, sinkage, load))),
        "rising_per_cm": round(float(slope), 3),
    }


def layers_of(snow: Terrain, plate: float) -> Floats:
    """Densities below the plate, whose lower face is at this z [m], from there to the base."""
    r = np.hypot(snow.x[:, 0], snow.x[:, 1])
    edges = np.linspace(plate, snow.level - DEPTH, LAYERS + 1)
    z = snow.x[:, 2]
    return np.array(
        [
            snow.mean_density((r < UNDER * RADIUS) & (z < high) & (z > low))
            for high, low in zip(edges[:-1], edges[1:])
        ]
    )


def laboratory_numbers(run: Run) -> Row:
    """The peak, densities below and next to the plate, and what slide and grid took."""
    curve, snow = whole_plate_curve(run.folder), Terrain.read(run.folder)
    layers = layers_of(snow, snow.level - float(curve[:, 1].max()))
    r, before = (np.hypot(x[:, 0], x[:, 1]) for x in (snow.x, snow.initial_position))
    beside = (r > RADIUS + BESIDE[0]) & (r < RADIUS + BESIDE[1])
    edge = (before < RADIUS) & (before > UNDER * RADIUS)
    history = read_terrain_history(run.folder)
    work = history["contact_work"][-1]
    return {
        "peak_N": round(curve[:, 2].max()),
        "peak_over_measured": round(curve[:, 2].max() / REFERENCE["peak_load_N"], 3),
        "rms_ln_density": round(rms(np.log(layers / MEASURED)), 3),
        "beside_kg_m3": round(snow.mean_density(beside)),
        "greatest_kg_m3": round(float(snow.density.max())),
        "edge_moved_out_mm": round(1e3 * float(np.mean(r[edge] - before[edge])), 1),
        "slide_loss": round(float(history["slide_loss"][-1] / work), 4),
        "numerical_loss": round(float(history["numerical_loss"][-1] / work), 4),
        **{f"density_{n}": round(value) for n, value in enumerate(layers, 1)},
    }


def row_of(run: Run) -> Row:
    """Its error, or what it cost and its numbers."""
    row: Row = {"case": run.name, "what": run.what, "failure": run.error}
    if not run.error:
        row["user_s"] = run.seconds
        row.update(field_numbers(run) if run.case.stage == "field" else laboratory_numbers(run))
    return row


def best_estimates(rows: Sequence[Mapping[str, Any]]) -> list[Row]:
    """The peak of the variants that were run in three sizes or more, extrapolated to zero cell size
    where the sizes allow it."""
    peaks = {row["case"]: float(row["peak_N"]) for row in rows if row.get("peak_N")}
    found: list[Row] = []
    for name in peaks:
        known = {cell: peaks[name + end] for end, cell in SIZES.items() if name + end in peaks}
        if len(known) < 3:
            continue
        series = grid_convergence(list(known), list(known.values()))
        found.append(
            {
                "case": name,
                "best_estimate_N": round(series.value),
                "error_N": round(series.error),
                "order": round(series.order, 2),
                "extrapolated": "yes" if series.extrapolated else "no",
                "over_measured": round(series.value / REFERENCE["peak_load_N"], 3),
            }
        )
    return found


def draw(runs: Runs, target: Path) -> None:
    """Load against sinkage, and density below the plate, in the coarse cells."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
    heights = np.arange(LAYERS) + 0.5
    right.plot(MEASURED, heights, "k*-", ms=9, lw=0.8, label="measured")
    for run in runs.done(""):
        if run.number("cell") != COARSE:
            continue
        curve, snow = whole_plate_curve(run.folder), Terrain.read(run.folder)
        left.plot(100 * curve[:, 1], curve[:, 2] / 1e3, lw=1.1, label=run.what)
        layers = layers_of(snow, snow.level - float(curve[:, 1].max()))
        right.plot(layers, heights, "o-", ms=3, lw=1.1, label=run.what)
    left.axhline(REFERENCE["peak_load_N"] / 1e3, color="k", ls=":", label="measured maximum")
    left.set(xlabel="sinkage [cm]", ylabel="load [kN]", xlim=(0, 24), ylim=(0, 5))
    left.legend(frameon=False, fontsize=8)
    right.set(xlabel="density [kg/m3]", ylabel="layer, from the plate to the base", xlim=(150, 600))
    right.invert_yaxis()
    save(figure, target, dpi=90)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    rows = [row_of(run) for run in runs.ended("")]
    output.table("results.csv", rows)
    output.table("best_estimates.csv", best_estimates(rows))
    output.table("field.csv", [row_of(run) for run in runs.ended("field")])
    if rows:
        draw(runs, output.path("layers.png"))
    return []
