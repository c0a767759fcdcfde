#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plate in the laboratory's snow, 180 kg/m3: cap law, cap law with a slide surface under the
plate's edge, foam law with it; load, and density below the plate layer by layer. See README.md.

Makes the runs that are missing and writes results.csv, size_zero.csv, field.csv and
layers.png.
"""

import math
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.statistics import at_size_zero, rms
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError, content_of
from furrow_post.figures.style import save
from furrow_post.read.terrain import Terrain, read_terrain_history
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

SCENE = PROJECT / "inputs/scenes/plate_on_snow.lig"
MATERIALS = PROJECT / "inputs/materials"
FRESH, REPORT, FOAM, FITTED = (
    MATERIALS / f"fresh_snow{name}.yaml" for name in ("", "_shoop", "_foam", "_foam_oedometer")
)
TIME_LIMIT = 3600.0  # [s] of one run
RADIUS, DEPTH = 0.1016, 0.5  # [m] of the plate, of the snow
DENSITY = 180.0  # [kg/m3] before
OTHERS_DENSITY = 200.0  # [kg/m3] of the snow of the material files
NO_SLIP = 10.0  # friction of a plate that holds the snow, as the report's does
SLIDE_FRICTION = 0.3
COARSE, FINE, FINER, FINEST = 0.0416667, 0.03125, 0.025, 0.02  # [m] cells
LAYERS = 10
UNDER = 0.8  # of the plate's radius: where densities below it are taken
BESIDE = (0.02, 0.08)  # [m] from its edge: where those beside it are taken


def numbers_of(text: str, key: str) -> list[float]:
    """The list behind a key of a material file."""
    found = re.search(rf"^  {key}: *\[(.*)\]", text, re.M)
    assert found
    return [float(value) for value in found[1].split(",")]


def report_hardening() -> str:
    """Strengths at the densities where they were, the first at the snow's own."""
    text = REPORT.read_text()
    lighter = math.log(OTHERS_DENSITY / DENSITY)
    strains = [round(strain + lighter, 4) for strain in numbers_of(text, "eps_vol_pl")[1:]]
    return (
        f"hardening: {{type: table, p: {numbers_of(text, 'p')}, eps_vol_pl: {[0.0, *strains]}, "
        "interpolation: linear, beyond: extrapolate}"
    )


def fresh_hardening() -> str:
    """As report_hardening."""
    text = FRESH.read_text()
    return (
        f"hardening: {{type: by_density, p: {numbers_of(text, 'p')}, "
        f"rho: {[DENSITY, *numbers_of(text, 'rho')[1:]]}, interpolation: log, beyond: extrapolate}}"
    )


# A foam law counts voids against ice of 900 kg/m3: e0 = 900/180 - 1
FOAM_VOIDS = "elasticity: {e0: 4.0}\nhardening: {e0: 4.0}"


def plate(
    name: str, what: str, base: Path, keys: str, slide: bool, cell: float = COARSE, **more: Value
) -> Case:
    """The scene with a material file of its own, and with a slide surface or without one.

    The surface stands outside of the particles that the plate touches.
    """
    variables: dict[str, Value] = {
        "material": f"{FOLDER}/material.yaml",
        "friction": NO_SLIP,
        "cell": cell,
        **more,
    }
    if slide:
        surface = f"slide_cylinder 0 0 {RADIUS + 0.25 * cell:.4f}"
        variables["terrain_keywords"] = f"{surface} slide_friction {SLIDE_FRICTION}"
    material = f"title: {what}\nbase: {base}\nlaw: {{density: {DENSITY:.0f}}}\n{keys}\n"
    return script_case(
        name,
        SCENE,
        variables,
        what=what,
        time_limit=TIME_LIMIT,
        may_fail=True,
        files={"material.yaml": material},
    )


def name_of(variant: str, cell: float) -> str:
    """Of a run in cells of this size [m]."""
    return variant if cell == COARSE else f"{variant}_{1e3 * cell:.0f}"


def sizes(
    name: str, what: str, base: Path, keys: str, slide: bool, cells: Sequence[float], **more: Value
) -> tuple[Case, ...]:
    """The same in several cells [m]."""
    return tuple(
        plate(
            name_of(name, cell),
            what if cell == COARSE else f"the same, cells of {100 * cell:.1f} cm",
            base,
            keys,
            slide,
            cell,
            **more,
        )
        for cell in cells
    )


ALL_CELLS, TWO, ONE = (COARSE, FINE, FINER), (COARSE, FINE), (COARSE,)
CASES = (
    *sizes("cap", "report's cap law", REPORT, report_hardening(), False, (*ALL_CELLS, FINEST)),
    *sizes("cap_slide", "cap law, slide surface", REPORT, report_hardening(), True, ALL_CELLS),
    *sizes("foam", "foam law", FOAM, FOAM_VOIDS, False, ONE, modulus_scale=1),
    *sizes("foam_slide", "foam law, slide surface", FOAM, FOAM_VOIDS, True, ONE, modulus_scale=1),
    *sizes(
        "foam_fitted_slide",
        "foam law, lambda of the oedometer, slide surface",
        FITTED,
        FOAM_VOIDS,
        True,
        ONE,
        modulus_scale=1,
    ),
    *sizes("fresh", "crushed in place", FRESH, fresh_hardening(), False, TWO),
    *sizes("fresh_slide", "crushed in place, slide surface", FRESH, fresh_hardening(), True, TWO),
)


# The field's plate: 20 cm on 40 cm of snow of 200 kg/m3, to its ultimate resistance
FIELD_DEPTH, FIELD_PLATE, FIELD_SINKAGE = 0.4, 0.2, 0.225  # [m]


def field(name: str, what: str, material: Path, cell: float, slide: bool, **more: Value) -> Case:
    """In the snow of the material file itself, as wide as the field is: 1.2 m."""
    variables: dict[str, Value] = {
        "material": material,
        "friction": NO_SLIP,
        "cell": cell,
        "depth": FIELD_DEPTH,
        "size": FIELD_PLATE,
        "sinkage": FIELD_SINKAGE,
        "box": 1.2,
        **more,
    }
    if slide:
        surface = f"slide_cylinder 0 0 {0.5 * FIELD_PLATE + 0.25 * cell:.4f}"
        variables["terrain_keywords"] = f"{surface} slide_friction {SLIDE_FRICTION}"
    return script_case(
        name,
        SCENE,
        variables,
        what=what,
        stage="field",
        time_limit=TIME_LIMIT,
        may_fail=True,
    )


FIELD_CASES = (
    field("field_cap", "report's cap law", REPORT, 0.05, False),
    field("field_cap_40", "the same, cells of 4 cm", REPORT, 0.04, False),
    field("field_cap_slide_40", "the same, slide surface", REPORT, 0.04, True),
    field("field_fresh_40", "crushed in place, cells of 4 cm", FRESH, 0.04, False),
    field("field_foam_slide", "foam law, slide surface", FOAM, 0.05, True, modulus_scale=1),
)


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
    edges = np.linspace(plate, snow.level - DEPTH, LAYERS + 1)
    z = snow.x[:, 2]
    return np.array(
        [
            snow.mean_density((r < UNDER * RADIUS) & (z < high) & (z > low))
            for high, low in zip(edges[:-1], edges[1:])
        ]
    )


def laboratory_numbers(folder: Path) -> Row:
    """The peak, densities below and beside the plate, and what slide and grid took."""
    measured = reference()
    curve, snow = curve_of(folder), Terrain.read(folder)
    layers = layers_of(snow, snow.level - float(curve[:, 1].max()))
    r, before = (np.hypot(x[:, 0], x[:, 1]) for x in (snow.x, snow.initial_position))
    beside = (r > RADIUS + BESIDE[0]) & (r < RADIUS + BESIDE[1])
    edge = (before < RADIUS) & (before > UNDER * RADIUS)
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


def size_zero(rows: Sequence[Mapping[str, Any]]) -> list[dict[str, object]]:
    """The peak in cells of size zero, from the two finest sizes, of the variants that were run in
    three sizes or more; and from the two sizes before, as a check, which the error reaches."""
    peaks = {row["case"]: float(row["peak_N"]) for row in rows if row.get("peak_N")}
    measured = reference()["peak_load_N"]
    found: list[dict[str, object]] = []
    for name in ("cap", "cap_slide"):
        known = [
            (cell, peaks[name_of(name, cell)])
            for cell in (*ALL_CELLS, FINEST)
            if name_of(name, cell) in peaks
        ]
        if len(known) < 3:
            continue
        value, error = at_size_zero(*known[-2:])
        check, _ = at_size_zero(*known[-3:-1])
        found.append(
            {
                "case": name,
                "size_zero_N": round(value),
                "error_N": round(max(error, abs(value - check))),
                "size_zero_coarser_N": round(check),
                "over_measured": round(value / measured, 3),
            }
        )
    return found


def draw(runner: Runner, target: Path) -> None:
    """Load against sinkage, and density below the plate, in the coarse cells."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), constrained_layout=True)
    heights = np.arange(LAYERS) + 0.5
    right.plot(measured_layers(), heights, "k*-", ms=9, lw=0.8, label="measured")
    for case in CASES:
        if runner.record(case) is None or case.variables["cell"] != COARSE:
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
    rows = table_of(CASES, runner, laboratory_numbers)
    output.table("results.csv", rows)
    output.table("size_zero.csv", size_zero(rows))
    output.table("field.csv", table_of(FIELD_CASES, runner, field_numbers))
    if rows:
        draw(runner, output.path("layers.png"))
    return []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", CASES + FIELD_CASES, evaluate)))
