# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, best estimates of the peak, the figure of layers."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

import cases

from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError, content_of
from furrow_post.figures.style import save
from furrow_post.read.terrain import Terrain, read_terrain_history
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner

HERE = Path(__file__).resolve().parent
LAYERS = 10
UNDER = 0.8  # of the plate's radius: where densities below it are taken
BESIDE = (0.02, 0.08)  # [m] from its edge: where those beside it are taken

Row = dict[str, object]


def table_of(
    cases: Sequence[Case], runner: Runner, numbers_of: Callable[[Path], Row]
) -> list[Row]:
    """A row for each case that ended: its error, or what it cost and the numbers of its folder."""
    rows: list[Row] = []
    for case in cases:
        if (record := runner.ended(case)) is None:
            continue
        row: Row = {"case": case.name, "what": case.what, "error": record.error}
        if not record.error:
            row["user_s"] = round(record.cpu_time, 1)
            row.update(numbers_of(runner.folder(case)))
        rows.append(row)
    return rows


def field_numbers(folder: Path) -> Row:
    """The greatest force and where it is; rising: how much more the last 2 cm bring, per cm."""
    curve = curve_of(folder)
    sinkage, load = curve[:, 1], curve[:, 2]
    last = sinkage > sinkage[-1] - 0.02
    slope = np.polyfit(100 * sinkage[last], load[last], 1)[0] / load[last].mean()
    return {
        "peak_N": round(load.max()),
        "at_cm": round(100 * float(sinkage[load.argmax()]), 1),
        "at_10_cm_N": round(float(np.interp(0.1, sinkage, load))),
        "rising_per_cm": round(float(slope), 3),
    }


def reference() -> Mapping[str, float]:
    """peak_load_N, density_1 ..."""
    return read_numbers(HERE / "reference.csv")[0]


def measured_layers() -> Floats:
    return np.array([reference()[f"density_{n}"] for n in range(1, LAYERS + 1)])


def curve_of(folder: Path) -> Floats:
    """(n, 4) step, sinkage [m], load [N], pressure [Pa]. @raises ResultsError"""
    file = folder / "curve.txt"
    with content_of(file, "make the run again: remove its folder"):
        curve: Floats = np.loadtxt(file, ndmin=2)
    if not curve.size:
        raise ResultsError(f"{file}: has no rows; make the run again: remove its folder")
    return curve


def layers_of(snow: Terrain, plate: float) -> Floats:
    """Densities below the plate, whose lower face is at this z [m], from there to the base."""
    r = np.hypot(snow.x[:, 0], snow.x[:, 1])
    edges = np.linspace(plate, snow.level - cases.DEPTH, LAYERS + 1)
    z = snow.x[:, 2]
    return np.array(
        [
            snow.mean_density((r < UNDER * cases.RADIUS) & (z < high) & (z > low))
            for high, low in zip(edges[:-1], edges[1:])
        ]
    )


def laboratory_numbers(folder: Path) -> Row:
    """The peak, densities below and beside the plate, and what slide and grid took."""
    measured = reference()
    curve, snow = curve_of(folder), Terrain.read(folder)
    layers = layers_of(snow, snow.level - float(curve[:, 1].max()))
    r, before = (np.hypot(x[:, 0], x[:, 1]) for x in (snow.x, snow.initial_position))
    beside = (r > cases.RADIUS + BESIDE[0]) & (r < cases.RADIUS + BESIDE[1])
    edge = (before < cases.RADIUS) & (before > UNDER * cases.RADIUS)
    history = read_terrain_history(folder)
    work = history["contact_work"][-1]
    return {
        "peak_N": round(curve[:, 2].max()),
        "peak_over_measured": round(curve[:, 2].max() / measured["peak_load_N"], 3),
        "rms_ln_density": round(rms(np.log(layers / measured_layers())), 3),
        "beside_kg_m3": round(snow.mean_density(beside)),
        "greatest_kg_m3": round(float(snow.density.max())),
        "edge_moved_out_mm": round(1e3 * float(np.mean(r[edge] - before[edge])), 1),
        "slide_loss": round(float(history["slide_loss"][-1] / work), 4),
        "numerical_loss": round(float(history["numerical_loss"][-1] / work), 4),
        **{f"density_{n}": round(value) for n, value in enumerate(layers, 1)},
    }


def best_estimates(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, object]]:
    """The peak of the variants that were run in three sizes or more, extrapolated to zero cell size
    where the sizes allow it."""
    peaks = {row["case"]: float(row["peak_N"]) for row in rows if row.get("peak_N")}
    measured = reference()["peak_load_N"]
    found: list[dict[str, object]] = []
    for name in ("cap", "cap_slide"):
        known = [
            (cell, peaks[cases.name_of(name, cell)])
            for cell in (*cases.ALL_CELLS, cases.FINEST)
            if cases.name_of(name, cell) in peaks
        ]
        if len(known) < 3:
            continue
        series = grid_convergence(*zip(*known))
        found.append(
            {
                "case": name,
                "best_estimate_N": round(series.value),
                "error_N": round(series.error),
                "order": round(series.order, 2),
                "extrapolated": "yes" if series.extrapolated else "no",
                "over_measured": round(series.value / measured, 3),
            }
        )
    return found


def draw(runner: Runner, target: Path) -> None:
    """Load against sinkage, and density below the plate, in the coarse cells."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
    heights = np.arange(LAYERS) + 0.5
    right.plot(measured_layers(), heights, "k*-", ms=9, lw=0.8, label="measured")
    for case in cases.CASES:
        if runner.record(case) is None or case.variables["cell"] != cases.COARSE:
            continue
        curve, snow = curve_of(runner.folder(case)), Terrain.read(runner.folder(case))
        left.plot(100 * curve[:, 1], curve[:, 2] / 1e3, lw=1.1, label=case.what)
        layers = layers_of(snow, snow.level - float(curve[:, 1].max()))
        right.plot(layers, heights, "o-", ms=3, lw=1.1, label=case.what)
    left.axhline(reference()["peak_load_N"] / 1e3, color="k", ls=":", label="measured maximum")
    left.set(xlabel="sinkage [cm]", ylabel="load [kN]", xlim=(0, 24), ylim=(0, 5))
    left.legend(frameon=False, fontsize=8)
    right.set(xlabel="density [kg/m3]", ylabel="layer, from the plate to the base", xlim=(150, 600))
    right.invert_yaxis()
    save(figure, target, dpi=90)


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    rows = table_of(cases.CASES, runner, laboratory_numbers)
    output.table("results.csv", rows)
    output.table("best_estimates.csv", best_estimates(rows))
    output.table("field.csv", table_of(cases.FIELD_CASES, runner, field_numbers))
    if rows:
        draw(runner, output.path("layers.png"))
    return []
