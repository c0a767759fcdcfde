# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of the runs: tables, and the figures of loads, of the foam law and of densities."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

import cases

from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError, content_of
from furrow_post.figures.style import save
from furrow_post.figures.terrain import draw_density_section
from furrow_post.read.laboratory import PointRun, read_oedometer_reference
from furrow_post.read.terrain import Terrain, read_terrain_history
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner

HERE = Path(__file__).resolve().parent
OEDOMETER = HERE.parent / "snow_oedometer" / "reference.csv"
SPEED = 0.5  # [m/s] of the scene
DENSITY = 200.0  # [kg/m3] before
DEPTH = 0.5  # [m]
GOAL = 0.25  # of the measured peak
IN_FOAM_FIGURE = (
    "foam",
    "foam_fine",
    "foam_linear_finer",
    "foam_weightless",
    "foam_fitted",
    "foam_fitted_weightless",
    "foam_deep",
    "foam_box",
    "foam_remap_1",
)
IN_DENSITY_FIGURE = ("fresh", "oedometer", "foam", "field")


def reference() -> Mapping[str, float]:
    """diameter_m, sinkage_m, peak_load_N."""
    return read_numbers(HERE / "reference.csv")[0]


def curve_of(folder: Path) -> Floats:
    """(n, 4) step, sinkage [m], load [N], pressure [Pa]; no rows where there is none."""
    file = folder / "curve.txt"
    with content_of(file, "make the run again: remove its folder"):
        curve: Floats = np.loadtxt(file, ndmin=2) if file.exists() else np.empty((0, 4))
    return curve if curve.size else np.empty((0, 4))


def row_of(case: Case, folder: Path, record: Record, peak_load: float) -> dict[str, object]:
    curve = curve_of(folder)
    reached = float(curve[:, 1].max()) if curve.size else 0.0
    row: dict[str, object] = {
        "case": case.name,
        "what": case.what,
        "user_s": round(record.cpu_time, 1),
        "sinkage_reached_m": round(reached, 4),
        "error": record.error,
    }
    if record.error:
        return row
    if not curve.size:
        raise ResultsError(f"{folder}/curve.txt: has no rows; make the run again: remove its folder")
    peak = curve[:, 2].max()
    last = curve[:, 1] > reached - 0.005  # the load at the end, over half a centimetre
    history = read_terrain_history(folder)
    area = math.pi / 4 * reference()["diameter_m"] ** 2
    speed = float(str(case.variables.get("speed", SPEED)))
    row["peak_N"] = round(peak)
    row["peak_over_measured"] = round(peak / peak_load, 3)
    row["end_N"] = round(curve[last, 2].mean())
    row["inertia_N"] = round(speed**2 * DENSITY * area, 1)
    loss = history["numerical_loss"][-1] / history["contact_work"][-1]
    row["numerical_loss"] = round(float(loss), 4)
    return row


def mark_measured(axes: Axes, measured: Mapping[str, float]) -> None:
    peak = measured["peak_load_N"] / 1e3
    sinkage = 100 * measured["sinkage_m"]
    axes.plot(sinkage, peak, "k*", ms=12, label="measured peak")
    low, high = (1 - GOAL) * peak, (1 + GOAL) * peak
    axes.axhspan(low, high, color="0.9", zorder=0, label=f"goal: {100 * GOAL:.0f} %")


def draw_curves(runner: Runner, target: Path) -> None:
    """Load against sinkage of the cap laws and of the foam law as it is; dotted: stopped."""
    figure, axes = plt.subplots(figsize=(7, 4.5), constrained_layout=True)
    for case in cases.CASES:
        record = runner.ended(case)
        if record is None or case.name.startswith("foam_"):
            continue
        curve = curve_of(runner.folder(case))
        style = ":" if record.error else "-"
        colour = "k" if case.name == "foam" else None
        load = curve[:, 2] / 1e3
        axes.plot(100 * curve[:, 1], load, lw=1.1, ls=style, color=colour, label=case.what)
    mark_measured(axes, reference())
    axes.set(xlabel="sinkage [cm]", ylabel="load [kN]", ylim=(0, 5), xlim=(0, 24))
    axes.legend(frameon=False, fontsize=8)
    save(figure, target, dpi=90)


def draw_foam(runner: Runner, target: Path) -> None:
    """The laws in confined compression; loads of the foam law, and of a column under the plate."""
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(14, 4.6), width_ratios=(1, 1.2), constrained_layout=True
    )
    measured = reference()
    area = math.pi / 4 * measured["diameter_m"] ** 2
    sinkage = np.linspace(0, measured["sinkage_m"], 200)
    for case, colour in zip(cases.CONFINED, ("C3", "C0", "C1", "C2")):
        if not runner.record(case):
            continue
        columns = PointRun(runner.folder(case)).columns
        density, stress = columns["density"], columns["axial_stress"]
        left.semilogy(density[1:], stress[1:] / 1e3, color=colour, label=case.what)
        load = area * np.interp(DENSITY / (1 - sinkage / DEPTH), density, stress)
        label = f"column under the plate, {case.what}"
        place = 100 * sinkage[1:]
        right.semilogy(place, load[1:] / 1e3, "--", color=colour, lw=1, label=label)
    density, stress = np.array(read_oedometer_reference(OEDOMETER)).T
    left.plot(density, stress / 1e3, "k*", ms=10, label="measured (Abele and Gow)")
    left.set(
        xlabel="density [kg/m3]",
        ylabel="axial stress in confined compression [kPa]",
        xlim=(200, 600),
        ylim=(0.3, 3000),
    )
    left.legend(frameon=False, fontsize=8)
    known = {case.name: case for case in cases.CASES}
    for name in IN_FOAM_FIGURE:
        curve = curve_of(runner.folder(known[name]))
        if curve.size:
            load = np.maximum(curve[:, 2], 1) / 1e3
            right.semilogy(100 * curve[:, 1], load, lw=1.1, label=known[name].what)
    mark_measured(right, measured)
    right.set(xlabel="sinkage [cm]", ylabel="load [kN]", xlim=(0, 24), ylim=(0.1, 12))
    right.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, target, dpi=90)


def draw_density(runner: Runner, target: Path) -> None:
    """Density under the plate at the end, of the laws that came to the end."""
    shown = [case for case in cases.CASES if case.name in IN_DENSITY_FIGURE and runner.record(case)]
    shown.sort(key=lambda case: IN_DENSITY_FIGURE.index(case.name))
    if not shown:
        return
    figure, panels = plt.subplots(
        1, len(shown), figsize=(4.6 * len(shown), 4.4), constrained_layout=True, squeeze=False
    )
    for axes, case in zip(panels[0], shown):
        snow = Terrain.read(runner.folder(case))
        draw_density_section(figure, axes, snow, 0, 0.5 * snow.spacing)
        axes.set_title(case.what, fontsize=9)
    save(figure, target, dpi=90)


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    peak = reference()["peak_load_N"]
    tables = {
        name: [
            row_of(case, runner.folder(case), record, peak)
            for case in cases.CASES
            if case.stage == stage and (record := runner.ended(case))
        ]
        for name, stage in (("results.csv", "cap"), ("foam.csv", "foam"))
    }
    for name, rows in tables.items():
        output.table(name, rows)
    if any(tables.values()):
        draw_curves(runner, output.path("curves.png"))
        draw_density(runner, output.path("density.png"))
        draw_foam(runner, output.path("foam.png"))
    return []
