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
    "18x8.50-8": (1200, 50),
    "13x5.00-6": (600, 100),
}
SOILS = ("sand_loose", "sand_medium", "sand_firm", "clay_soft", "clay_medium", "clay_stiff")  # in inputs/materials
LOAM = "sandy_loam"  # for the tyre of the curve
SLIP = 0.2  # of the driven tyres
CURVE = ("265/70R17", ("sand_medium", "clay_medium"), (0.05, 0.1, 0.2, 0.3, 0.4))  # tyre, soils and slips of a curve
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


def keys_of(size: str, soil: str, motion: str) -> dict[str, Any]:
    load, pressure = TYRES[size]
    radius = estimate(size).radius
    lengths = {"cell": CELL * radius, "depth": DEPTH * radius, "fine_depth": 0.5 * radius, "distance": TRAVEL * radius}
    return {
        "tyre": size.replace("/", "_"), "size": size, "soil": soil, "motion": motion, "load": load, "pressure": 1e3 * pressure,
        "radius": f"{radius:.4f}", **{name: f"{value:.4f}" for name, value in lengths.items()},
    }  # fmt: skip


def combinations() -> Iterator[dict[str, Any]]:
    """Every tyre on every soil, towed and driven."""
    for size in TYRES:
        for soil in (*SOILS, LOAM) if size == CURVE[0] else SOILS:
            yield {"drive": "towed", **keys_of(size, soil, "mode towed")}
            yield {"drive": "driven", **keys_of(size, soil, f"mode slip slip {SLIP}")}


def curve() -> Iterator[dict[str, Any]]:
    """One tyre over slip."""
    size, soils, slips = CURVE
    for soil in soils:
        for slip in slips:
            yield {"slip": slip, **keys_of(size, soil, f"mode slip slip {slip}")}


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
    _require(run, {"rut_depth", "resistance_coefficient" if drive == "towed" else "net_traction_coefficient"})
    rows = compared(run.folder, formulas(size, soil), drive == "towed")
    if soil_named(soil).kind == "clay" and drive == "towed":
        rows += _resistance_on_clay(run, size, soil)
    return [{"size": size, "soil": soil, "drive": drive, **row._asdict(), "steady": _steady(run, row.quantity)} for row in rows]


def pull_at_slip(run: Run) -> dict[str, Any]:
    """Net traction of a run of the curve, with its whole error, and that of the formulas."""
    _, soil, slip = run.name.split("/")
    _require(run, {"net_traction_coefficient"})
    rows = compared(run.folder, formulas(CURVE[0], soil, float(slip)), towed=False)
    pull = next(row for row in rows if row.quantity == "net_traction_coefficient")
    return {"soil": soil, "slip": float(slip), **pull._asdict(), "steady": _steady(run, pull.quantity)}


def _steady(run: Run, quantity: str) -> str:
    return "yes" if Summary(run.folder).quantities[quantity]["steady"] else "no"


def _require(run: Run, needed: set[str]) -> None:
    if missing := needed - Summary(run.folder).quantities.keys():
        raise ResultsError(f"{run.folder}: its summary has no {' and '.join(sorted(missing))}; repeat the run")


def _resistance_on_clay(run: Run, size: str, soil: str) -> list[Compared]:
    """Towed resistance on clay: that of the formulas without slip, whose limit of slip does not apply."""
    answers = [one.resistance for one in formulas(size, soil, 1e-6).answers if all(limit.startswith("slip ") for limit in one.outside)]
    if not answers:
        return []
    error = budgets_of(run.folder)["resistance_coefficient"]
    value = Summary(run.folder).quantities["resistance_coefficient"]["mean"]
    return [Compared("resistance_coefficient", float(value), error.total, fmean(answers), min(answers), max(answers), error.missing_text())]
