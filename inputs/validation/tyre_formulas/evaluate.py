# SPDX-License-Identifier: GPL-2.0-or-later
"""Tyres estimated from their sizes, and the formulas that hold for them."""

from collections.abc import Iterator
from functools import cache
from statistics import fmean
from typing import Any

from furrow_post.laws.cone_files import Soil, soil_of
from furrow_post.laws.cone_formulas import Formulas, formulas_for
from furrow_post.uncertainty.whole_error import budgets_of
from furrow_post.cli.answer_command import Compared, EstimatedTyre, compared, estimate_tyre
from furrow_post.errors import ResultsError
from furrow_post.run.summary import Summary
from furrow_post.soil.material import find_ground
from furrow_post.study.runs import Run

# Size: load [N], inflation [kPa]
TYRES = {
    "205/55R16": (4000, 220),
    "265/70R17": (6000, 200),
    "14.00R20": (25000, 300),
    "18.4R38": (20000, 100),
    "31x15.50-15": (6000, 80),
    "22x11.00-10": (2000, 50),
}
SOILS = ("sand_loose", "sand_medium", "sand_firm", "clay_soft", "clay_medium", "clay_stiff")  # in inputs/materials
ON_CLAY = "265/70R17"  # the tyre that runs on clay too
SLIP = 0.2  # of the driven tyres
CELL, DEPTH, TRAVEL = 0.15, 1.3, 3.7  # over the radius of the belt


@cache
def estimate(size: str) -> EstimatedTyre:
    load, pressure = TYRES[size]
    return estimate_tyre(size, load, pressure, "furrow-post fit tyre")


def soil_named(name: str) -> Soil:
    """Kind and index of the virtual cone of a material file."""
    soil = soil_of(find_ground(name))
    if soil is None:
        raise ResultsError(f"{name}: has no cone index; give the material file a line 'cone_index: 131e3'")
    return soil


def tyre_text(size: str) -> str:
    return estimate(size).text


def combinations() -> Iterator[dict[str, Any]]:
    """Every tyre on every sand and one on every clay, towed and driven."""
    for size, (load, pressure) in TYRES.items():
        radius = estimate(size).radius
        lengths = {"cell": CELL * radius, "depth": DEPTH * radius, "fine_depth": 0.5 * radius, "distance": TRAVEL * radius}
        for soil in SOILS:
            if soil_named(soil).kind == "clay" and size != ON_CLAY:
                continue
            for drive, motion in (("towed", "mode towed"), ("driven", f"mode slip slip {SLIP}")):
                yield {
                    "tyre": size.replace("/", "_"), "size": size, "soil": soil, "drive": drive, "motion": motion, "load": load,
                    "pressure": 1e3 * pressure, "radius": f"{radius:.4f}", **{name: f"{value:.4f}" for name, value in lengths.items()},
                }  # fmt: skip


@cache
def formulas(size: str, soil: str, slip: float = SLIP) -> Formulas:
    """Formulas for one tyre on the cone index of one soil."""
    ground = soil_named(soil)
    return formulas_for(ground.kind, ground.cone_index, estimate(size).tyre, slip)


def compared_with_formulas(run: Run) -> list[dict[str, Any]]:
    """Values of a run of which the formulas speak, with their whole errors."""
    soil, _, name = run.name.partition("/")
    size, _, drive = name.rpartition("_")
    size = size.replace("_", "/")
    needed = {"rut_depth", "resistance_coefficient" if drive == "towed" else "net_traction_coefficient"}
    if missing := needed - Summary(run.folder).quantities.keys():
        raise ResultsError(f"{run.folder}: its summary has no {' and '.join(sorted(missing))}; repeat the run")
    rows = compared(run.folder, formulas(size, soil), drive == "towed")
    if soil_named(soil).kind == "clay" and drive == "towed":
        rows += _resistance_on_clay(run, size, soil)
    return [{"size": size, "soil": soil, "drive": drive, **row._asdict()} for row in rows]


def _resistance_on_clay(run: Run, size: str, soil: str) -> list[Compared]:
    """Towed resistance on clay: that of the formulas without slip, whose limit of slip does not apply."""
    answers = [one.resistance for one in formulas(size, soil, 1e-6).answers if all(limit.startswith("slip ") for limit in one.outside)]
    if not answers:
        return []
    error = budgets_of(run.folder)["resistance_coefficient"]
    value = Summary(run.folder).quantities["resistance_coefficient"]["mean"]
    return [Compared("resistance_coefficient", float(value), error.total, fmean(answers), min(answers), max(answers), error.missing_text())]
