#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plate of 20.32 cm into 50 cm of fresh snow, continuum, against the measured peak load. See
README.md.

Makes the runs that are missing and writes results.csv (cap laws and Cam clay), foam.csv, curves.png,
foam.png and density.png.
--check makes one of them, in seconds.
"""

import math
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError, content_of
from furrow_post.figures.style import save
from furrow_post.figures.terrain import draw_density_section
from furrow_post.read.laboratory import PointRun, read_oedometer_reference
from furrow_post.read.terrain import Terrain, read_terrain_history
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import point_case, script_case
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

SCENE = PROJECT / "inputs/scenes/plate_on_snow.lig"
MATERIALS = PROJECT / "inputs/materials"
OEDOMETER = PROJECT / "inputs/validation/snow_oedometer/reference.csv"
TIME_LIMIT = 3600.0  # [s] of one run
SPEED = 0.5  # [m/s] of the scene
DENSITY = 200.0  # [kg/m3] before
DEPTH = 0.5  # [m]
GOAL = 0.25  # of the measured peak
CHECKED = "fresh"  # run that is a test
FRESH, REPORT, FOAM, FITTED = (
    MATERIALS / f"fresh_snow{name}.yaml" for name in ("", "_shoop", "_foam", "_foam_oedometer")
)


def on_snow(name: str, what: str, stage: str, variables: Mapping[str, Value]) -> Case:
    return script_case(
        name, SCENE, variables, what=what, stage=stage, time_limit=TIME_LIMIT, may_fail=True
    )


def plate(name: str, what: str, **variables: Value) -> Case:
    """The scene with a cap law, fresh_snow unless a material is given."""
    given: dict[str, Value] = {"material": FRESH, **variables}
    return on_snow(name, what, "cap", given)


def report(name: str, what: str, **variables: Value) -> Case:
    """The scene with the report's reading of the cap law."""
    given: dict[str, Value] = {"material": REPORT, **variables}
    return plate(name, what, **given)


def foam(name: str, what: str, **variables: Value) -> Case:
    """The scene with the foam law, whose porous elasticity has no E to scale."""
    given: dict[str, Value] = {"material": FOAM, "modulus_scale": 1, **variables}
    return on_snow(name, what, "foam", given)


def with_material(case: Case, text: str) -> Case:
    """The case with a material file of its own."""
    variables: dict[str, Value] = {**case.variables, "material": f"{FOLDER}/material.yaml"}
    return replace(case, variables=variables, files={"material.yaml": text})


def variant(name: str, what: str, text: str) -> Case:
    """fresh_snow with other keys."""
    return with_material(plate(name, what), f"title: {what}\nbase: {FRESH}\n{text}\n")


def steep(name: str, beta: float) -> Case:
    """The report's cap law with a steeper cone [degrees] and the same confined compression.

    p_b such that sigma_1 = p_b (1 + 2/3 tan beta) + 2/3 d stays as it was.
    """

    def rise(angle: float) -> float:
        return 1 + 2 / 3 * math.tan(math.radians(angle))

    text = REPORT.read_text()
    p, eps = (_numbers(text, key) for key in ("p", "eps_vol_pl"))
    strengths = [float(value) * rise(22.53) / rise(beta) for value in p.strip("[]").split(",")]
    eccentricity = 0.95 * strengths[0] / 5e3
    case = report(name, f"the report's, beta {beta} degrees, same confined compression")
    return with_material(
        case,
        f"title: Fresh snow, beta {beta}\nbase: {REPORT}\n"
        f"law: {{beta: {beta}, R: {eccentricity:.4g}}}\n"
        f"hardening: {{type: table, p: {strengths}, eps_vol_pl: {eps}, interpolation: linear, "
        "beyond: extrapolate}\n",
    )


def _numbers(text: str, key: str) -> str:
    """The list behind a key of a material file, as it stands there."""
    found = re.search(rf"^  {key}: *(\[.*\])", text, re.M)
    assert found
    return found[1]


def linear(name: str, what: str, **variables: Value) -> Case:
    """The foam law with linear elasticity instead of the porous one, which takes three times."""
    text = (
        f"title: Foam law, linear elasticity\nbase: {FOAM}\n"
        "elasticity: {type: linear, E: 13.79e6, nu: 0.3}\n"
    )
    return with_material(foam(name, what, **variables), text)


LINEAR = "foam law, linear elasticity"
FITTED_LAMBDA = "foam law, lambda from the oedometer"
CASES = (
    plate("fresh", "fresh_snow: crushed in place"),
    plate("fresh_fine", "the same, cells of 3.1 cm", cell=0.03125),
    plate("fresh_finer", "the same, cells of 2.5 cm", cell=0.025),
    plate("fresh_smooth", "the same, no friction on plate and edge", friction=0),
    plate("fresh_slow", "the same, half the speed", speed=0.25),
    variant("fresh_d", "the same, d = 2 kPa", "law: {d: 2e3}"),
    variant("fresh_linear", "the same, straight in p", "hardening: {interpolation: linear}"),
    plate(
        "clay",
        "Cam clay with the same oedometer and K0",
        material=MATERIALS / "fresh_snow_cam_clay.yaml",
    ),
    plate(
        "clay_fine",
        "the same, cells of 3.1 cm",
        material=MATERIALS / "fresh_snow_cam_clay.yaml",
        cell=0.03125,
    ),
    plate(
        "clay_finer",
        "the same, cells of 2.5 cm",
        material=MATERIALS / "fresh_snow_cam_clay.yaml",
        cell=0.025,
    ),
    plate("field", "field_snow, 220 kg/m3", material=MATERIALS / "field_snow.yaml"),
    report("oedometer", "the report's reading, beta 22.5 degrees"),
    report("fine", "the report's, cells of 3.1 cm", cell=0.03125),
    report("finer", "the report's, cells of 2.5 cm", cell=0.025),
    report(
        "log",
        "the report's, hardening straight in ln p",
        material=MATERIALS / "fresh_snow_shoop_log.yaml",
    ),
    report(
        "p_0413",
        "the report's, hardening read as p = 0.413 sigma1",
        material=MATERIALS / "fresh_snow_p_0413.yaml",
    ),
    steep("beta_45", 45),
    steep("beta_60", 60),
    foam("foam", "foam law"),
    foam("foam_fine", "foam law, cells of 3.1 cm", cell=0.03125),
    foam("foam_weightless", "foam law, no weight", gravity=0),
    foam("foam_fitted", FITTED_LAMBDA, material=FITTED),
    foam("foam_fitted_weightless", f"{FITTED_LAMBDA}, no weight", material=FITTED, gravity=0),
    foam("foam_deep", "foam law, 80 cm of snow", depth=0.8),
    foam("foam_box", "foam law, walls 1 m apart", box=1.0),
    linear("foam_linear", LINEAR),
    linear("foam_linear_finer", f"{LINEAR}, cells of 2.5 cm", cell=0.025),
    foam("foam_smooth", "foam law, no friction on plate and edge", friction=0),
    foam("foam_remap_1", "foam law, remapping at each step", remap_interval=1),
    foam(
        "foam_column",
        "foam law, plate as wide as the box",
        shape="square",
        size=0.6,
        friction=0,
        cell=0.05,
    ),
)
CONFINED = tuple(
    point_case(
        f"confined/{material.stem}",
        material.stem,
        material,
        "{type: confined, strain: [1.1], steps: 400}",
        what=what,
        stage="confined",
    )
    for material, what in (
        (FRESH, "cap law"),
        (REPORT, "cap law, the report's"),
        (FOAM, "foam law"),
        (FITTED, FITTED_LAMBDA),
    )
)
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
    for case in CASES:
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
    for case, colour in zip(CONFINED, ("C3", "C0", "C1", "C2")):
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
    cases = {case.name: case for case in CASES}
    for name in IN_FOAM_FIGURE:
        curve = curve_of(runner.folder(cases[name]))
        if curve.size:
            load = np.maximum(curve[:, 2], 1) / 1e3
            right.semilogy(100 * curve[:, 1], load, lw=1.1, label=cases[name].what)
    mark_measured(right, measured)
    right.set(xlabel="sinkage [cm]", ylabel="load [kN]", xlim=(0, 24), ylim=(0.1, 12))
    right.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    save(figure, target, dpi=90)


def draw_density(runner: Runner, target: Path) -> None:
    """Density under the plate at the end, of the laws that came to the end."""
    cases = [case for case in CASES if case.name in IN_DENSITY_FIGURE and runner.record(case)]
    cases.sort(key=lambda case: IN_DENSITY_FIGURE.index(case.name))
    if not cases:
        return
    figure, panels = plt.subplots(
        1, len(cases), figsize=(4.6 * len(cases), 4.4), constrained_layout=True, squeeze=False
    )
    for axes, case in zip(panels[0], cases):
        snow = Terrain.read(runner.folder(case))
        draw_density_section(figure, axes, snow, 0, 0.5 * snow.spacing)
        axes.set_title(case.what, fontsize=9)
    save(figure, target, dpi=90)


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    peak = reference()["peak_load_N"]
    tables = {
        name: [
            row_of(case, runner.folder(case), record, peak)
            for case in CASES
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


if __name__ == "__main__":
    study = Study(
        Path(__file__),
        __doc__ or "",
        (*CASES, *CONFINED),
        evaluate,
        checked=lambda case: case.name == CHECKED,
    )
    sys.exit(run_study(study))
