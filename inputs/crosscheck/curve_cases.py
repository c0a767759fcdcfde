# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates and oedometers on both grounds, beside formulas and measurements."""

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from cases import BASE, PROJECT, Made, OutputRow, Planned, known, output_row
from wheel_cases import BEKKER

from furrow_post.analyse import curves, empirical
from furrow_post.analyse.curves import Curve, CurveComparison, CurveKind, NumericalErrors
from furrow_post.arrays import Floats
from furrow_post.figures.curves import Line, draw_curves
from furrow_post.formatting import with_error
from furrow_post.read.laboratory import read_oedometer_reference
from furrow_post.study.output import Output
from furrow_post.study.tables import markdown

MEASURED_OEDOMETER = PROJECT / "inputs" / "validation" / "snow_oedometer" / "reference.csv"
MEASURED_FROM = 210.0  # [kg/m3] log strains of the measurements are counted from it


class CurveCase:
    """Curves of a case that are shown, each with its numerical errors from the checks."""

    def __init__(self, case: str, made: Made) -> None:
        self.case, self.made = case, made
        self.plans = [planned for planned in made.plans if not planned.is_check]
        self.curves = [self.read(planned) for planned in self.plans]

    def read(self, planned: Planned) -> Curve:
        value = "" if planned.role == BASE else f" {planned.role.rpartition('=')[2]}"
        return curves.read_curve(self.made.folder(planned), planned.ground + value)

    def errors(self, levels: Sequence[float]) -> list[NumericalErrors]:
        """Of every curve; only a base has checks."""
        return [
            curves.numerical_errors(curve, self.checks_of(planned), levels)
            for curve, planned in zip(self.curves, self.plans)
        ]

    def checks_of(self, planned: Planned) -> list[Curve]:
        if planned.role != BASE:
            return []
        return [
            self.read(other)
            for other in self.made.plans
            if other.is_check and other.ground == planned.ground
        ]


def measured_oedometer() -> list[tuple[float, float]]:
    """(density over that at the start, stress [Pa])."""
    reference = read_oedometer_reference(MEASURED_OEDOMETER)
    return [(rho / MEASURED_FROM, stress) for rho, stress in reference if stress <= 5e5]


def bekker_lines(curve: Curve) -> list[Line]:
    """Beside a plate on sand; b of a round plate is its radius."""
    z = np.linspace(1e-3, curve.x[-1], 60)
    radius = 0.5 * curve.facts["size"]
    return [
        Line(f"Bekker, {name}", z, empirical.terrain(name).plate_pressure(z, radius))
        for name in BEKKER
    ]


def curve_section(case: CurveCase, output: Output, out: list[OutputRow]) -> list[str]:
    """The section of the page; out: gets the lines of results.csv."""
    result = curves.compare_curves(case.curves, anyway=True)
    errors = case.errors(result.levels)
    totals = [
        curves.combined_errors(error, noise / value)
        for error, noise, value in zip(errors, result.errors.T, result.values.T)
    ]
    plate = result.kind is CurveKind.PLATE
    beside = bekker_lines(case.curves[0]) if plate and "sand" in case.case else []
    measured = measured_oedometer() if not plate and "snow" in case.case else []
    draw_curves(result, output.path(f"{case.case}.png"), measured, beside)
    unit = "kPa" if plate else "density ratio"
    head = ["sinkage mm" if plate else "axial stress kPa"]
    head += [f"{curve.label}, {unit}" for curve in result.curves]
    head += [f"{line.label}, kPa" for line in beside]
    rows = [curve_cells(result, totals, beside, place) for place in range(len(result.levels))]
    for place in range(len(result.levels)):
        out += curve_rows(case, result, errors, totals, beside, place)
    lines = [f"## {case.case.replace('_', ' ')}", "", *markdown(head, rows), ""]
    lines += [f"- differs: {difference}" for difference in result.differences]
    lines += [f"- {finding}" for finding in result.findings]
    if plate:
        lines += [
            f"- {curves.judge_curves(result, k, errors).sentence}"
            for k in range(1, len(totals))
            if totals[0] is not None and totals[k] is not None
        ]
    return [*lines, "", f"![{case.case}]({case.case}.png)", ""]


def curve_cells(
    result: CurveComparison, totals: Sequence[Floats | None], beside: Sequence[Line], place: int
) -> list[str]:
    """A line of the table: values at one level."""
    plate = result.kind is CurveKind.PLATE
    level = result.levels[place]
    cells = [f"{1e3 * level if plate else 1e-3 * level:.3g}"]
    for value, total in zip(result.values[place], totals):
        if not plate:
            cells.append(f"{value:.4g}")
        elif total is not None and total[place] > 0:
            cells.append(with_error(1e-3 * value, 1e-3 * value * total[place]))
        else:
            cells.append(f"{1e-3 * value:.3g}")
    return cells + [f"{1e-3 * np.interp(level, line.x, line.y):.3g}" for line in beside]


def curve_rows(
    case: CurveCase,
    result: CurveComparison,
    errors: Sequence[NumericalErrors],
    totals: Sequence[Floats | None],
    beside: Sequence[Line],
    place: int,
) -> Iterator[OutputRow]:
    plate = result.kind is CurveKind.PLATE
    level = f"{result.levels[place]:.4g}"
    for k, curve in enumerate(result.curves):
        value, total = float(result.values[place, k]), totals[k]
        numbers: dict[str, str] = {"value": f"{value:.6g}"}
        if total is not None and total[place] >= 0:
            numbers["uncertainty"] = f"{value * total[place]:.3g}"
        if plate:
            numbers["time"] = f"{result.errors[place, k]:.3g}"
        for part in curves.NUMERICAL_PARTS:
            numbers[part] = known(value * float(errors[k][part][place]))
        numbers |= case.made.cost_cells(case.plans[k])
        quantity = "pressure" if plate else "density_ratio"
        yield output_row(case.case, level, curve.label, quantity, **numbers)
    for line in beside:
        pressure = np.interp(result.levels[place], line.x, line.y)
        yield output_row(case.case, level, line.label, "pressure", value=f"{pressure:.6g}")
