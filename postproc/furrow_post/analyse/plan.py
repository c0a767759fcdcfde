# SPDX-License-Identifier: GPL-2.0-or-later
"""Which runs bring the error of a scene's value at zero size down to a goal most cheaply.

That value is f0 of the curve f0 + a h^p through a family's runs (grid_convergence.py), which must
have shown their order p. What its error will be when runs are added follows from their sizes and
scatters alone, before they are made:

    var f0 = s [(X^T W X)^-1]_00 + (g a h_min^p)^2,  W = diag(1/(u_time^2 + u_packing^2)),
    X = (1, h^p, a h^p ln h)

with s, not below 1, the scatter of the present runs about the curve over what their errors allow,
and g half of the safety factor of the grid convergence index. The error of the domain is added in
squares; no run of the plan lowers it. Runs are chosen one after
the other, each that which lowers the sum over both quantities of ln(error/goal), where that is
above 0, most for its time.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ..errors import ResultsError
from ..formatting import duration
from ..read.wheel_run import cells_or_grains
from .cost import ByQuantity
from .cost_table import QUANTITY_KEYS, Family, Row
from .grid_convergence import COVERAGE, SAFE, Convergence, noise_of, zero_variance
from .verdict import QUANTITIES, Quantity

LONGER = 4.0  # times the length: half of the time average's error
FINER = 0.8  # times the finest size
MOST_STEPS = 20


@dataclass(frozen=True)
class Point:
    """A run on the curve, made or planned: its size [m], time averages' errors, cost [s]."""

    name: str
    size: float
    errors: tuple[float, ...]  # of QUANTITY_KEYS
    cpu_time: float
    length: float = 1.0  # times that of the run as it was made


class Step(NamedTuple):
    """A run to make, and what the errors at zero size will then be."""

    action: str
    cpu_time: float  # [s] of one core
    errors: ByQuantity


@dataclass(frozen=True)
class Plan:
    """Plan of one family: errors now, steps in their order, what must be learnt before all of them."""

    family: Family
    values: ByQuantity  # at zero size
    goals: ByQuantity  # in the quantity's unit
    present: ByQuantity
    unknown: list[str]
    steps: list[Step]
    points: list[Point]  # all runs when all steps are made

    @property
    def errors(self) -> ByQuantity:
        """When all steps are made."""
        return self.steps[-1].errors if self.steps else self.present

    @property
    def reached(self) -> bool:
        return all(self.errors[key] <= self.goals[key] for key in QUANTITY_KEYS)

    @property
    def cpu_time(self) -> float:
        return sum(step.cpu_time for step in self.steps)


class _Series:
    """What is known of a family's sizes: the curve, scatter of packings, domain."""

    def __init__(self, family: Family) -> None:
        self.points = [
            Point(
                row.run,
                row.size,
                tuple(row.value(key)[1] for key in QUANTITY_KEYS),
                row.cpu_time,
            )
            for row in family.rows_of_series
        ]
        self._curves = {key: _known(family, key) for key in QUANTITY_KEYS}
        self._packing = {key: family.packing(key) for key in QUANTITY_KEYS}
        domains = {key: family.domain_error(key) for key in QUANTITY_KEYS}
        self._domain = {key: u if math.isfinite(u) else 0.0 for key, u in domains.items()}

    def value(self, key: str) -> float:
        return self._curves[key].value

    def errors(self, points: Sequence[Point]) -> ByQuantity:
        """At zero size, of these runs."""
        sizes = [p.size for p in points]
        found = {}
        for index, key in enumerate(QUANTITY_KEYS):
            curve, packing = self._curves[key], self._packing[key]
            noise = [noise_of(curve.at(p.size), p.errors[index], packing) for p in points]
            variance = curve.spread * zero_variance(sizes, noise, curve.used_order, curve.slope)
            of_size = SAFE / COVERAGE * abs(curve.at(min(sizes)) - curve.value)
            found[key] = math.hypot(math.sqrt(variance), of_size, self._domain[key])
        return found


def _known(family: Family, key: str) -> Convergence:
    """@raises ResultsError where the sizes do not extrapolate"""
    series = family.convergence(key)
    reason = series.reason if series else "only one size"
    if series is None or reason:
        raise ResultsError(
            f"{' '.join(family.key)}, {key}: {reason}, so that no value at zero size is known; add a "
            f"run with finer {cells_or_grains(family.key.ground)}, or longer runs"
        )
    return series


def plan(family: Family, relative: ByQuantity, absolute: ByQuantity) -> Plan:
    """The cheapest way to the goals, run by run.

    relative: goals over the value at zero size; absolute: in the quantity's unit; of either the
    larger. @raises ResultsError where the family's sizes do not extrapolate
    """
    series = _Series(family)
    goals = {
        key: max(absolute.get(key, 0.0), relative.get(key, 0.0) * abs(series.value(key)))
        for key in QUANTITY_KEYS
    }
    points = list(series.points)
    steps: list[Step] = []
    errors = present = series.errors(points)
    while _missing(errors, goals) > 0 and len(steps) < MOST_STEPS:
        action, cpu_time, more = max(
            _candidates(family, points),
            key=lambda c: (_missing(errors, goals) - _missing(series.errors(c[2]), goals)) / c[1],
        )
        after = series.errors(more)
        if _missing(after, goals) >= _missing(errors, goals) * (1 - 1e-9):
            break
        steps.append(Step(action, cpu_time, after))
        errors, points = after, more
    values = {key: series.value(key) for key in QUANTITY_KEYS}
    return Plan(family, values, goals, present, _unknown(family), steps, points)


def _missing(errors: ByQuantity, goals: ByQuantity) -> float:
    return sum(max(0.0, math.log(errors[key] / goals[key])) for key in QUANTITY_KEYS)


def _candidates(family: Family, points: Sequence[Point]) -> list[tuple[str, float, list[Point]]]:
    """What could be done next: words, cost [s], all runs afterwards."""
    found = []
    for i, point in enumerate(points):
        longer = replace(
            point,
            errors=tuple(e / math.sqrt(LONGER) for e in point.errors),
            cpu_time=LONGER * point.cpu_time,
            length=LONGER * point.length,
        )
        name = f"{point.name} {longer.length:g} times as long"
        found.append((name, (LONGER - 1) * point.cpu_time, [*points[:i], longer, *points[i + 1 :]]))
        if family.key.ground != "continuum":
            again = replace(point, name=f"another packing of {_size_text(point)}")
            found.append((again.name + _length_text(again), again.cpu_time, [*points, again]))
    finest = min(points, key=lambda p: p.size)
    finer = replace(
        finest,
        size=FINER * finest.size,
        cpu_time=finest.cpu_time * FINER ** _cost_exponent(family.bases),
    )
    finer = replace(finer, name=_size_text(finer))
    name = f"a run with {cells_or_grains(family.key.ground)} of {finer.name}{_length_text(finer)}"
    found.append((name, finer.cpu_time, [*points, finer]))
    return found


def _length_text(point: Point) -> str:
    return f", {point.length:g} times as long" if point.length != 1 else ""


def _size_text(point: Point) -> str:
    return f"{1e3 * point.size:.3g} mm"


def _cost_exponent(bases: Sequence[Row]) -> float:
    """b of cost ~ size^b, through the family's runs."""
    size, time = np.log([[row.size, row.cpu_time] for row in bases]).T
    return float(np.polyfit(size, time, 1)[0])


def _unknown(family: Family) -> list[str]:
    """What the table says nothing about, and the cheapest run that would."""
    cheapest = min(family.bases, key=lambda row: row.cpu_time)
    ways = {
        "packing": f"a run like {cheapest.run} with another seed of the packing",
        "domain": f"a run like {cheapest.run} on a wider and longer ground",
    }
    parts = family.components(QUANTITY_KEYS[0], cheapest.size)
    return [
        f"{part}: {way} ({duration(cheapest.cpu_time)})"
        for part, way in ways.items()
        if part in parts.unknown
    ]


def family_of(families: Sequence[Family], ground: str) -> list[Family]:
    """Those of a ground, or all. @raises ResultsError where there is none"""
    found = [family for family in families if not ground or family.key.ground == ground]
    if not found:
        known = sorted({family.key.ground for family in families})
        raise ResultsError(f"the table has no runs on {ground}; it has {', '.join(known)}")
    return found


def plan_report(made: Plan) -> str:
    """The plan as a table for a person: each kind of run with how many of it and their cost."""
    actions = list(dict.fromkeys(step.action for step in made.steps))
    wide = max(len(text) for text in ("as it stands", *actions))
    values = ", ".join(_with_unit(q, made.values[q.key], ".4g", q.key) for q in QUANTITIES)
    heads = "  ".join(f"{'± ' + q.key:>13}" for q in QUANTITIES)
    lines = [
        f"{' '.join(made.family.key)}, at zero size: {values}",
        f"  {'':{wide}} {'runs':>5} {'cost':>9}  {heads}",
        _line_of("as it stands", wide, made.present),
    ]
    for action in actions:
        costs = [step.cpu_time for step in made.steps if step.action == action]
        lines.append(f"  {action:{wide}} {len(costs):5} {duration(sum(costs)):>9}")
    if made.steps:
        lines.append(_line_of("then", wide, made.errors, made.cpu_time))
    lines.append(_line_of("goal", wide, made.goals))
    if made.unknown:
        lines.append("  not known, to be made first: " + "; ".join(made.unknown))
    if not made.reached:
        lines.append(f"  The goal is not reached by {len(made.steps)} runs: {_why_not(made)}.")
    return "\n".join(lines)


def _line_of(name: str, wide: int, errors: ByQuantity, cost: float = math.nan) -> str:
    texts = "  ".join(f"{_with_unit(q, errors[q.key], '.3g', ''):>13}" for q in QUANTITIES)
    return f"  {name:{wide}} {'':5} {duration(cost):>9}  {texts}"


def _with_unit(quantity: Quantity, value: float, form: str, name: str) -> str:
    """ "sinkage 101 mm"."""
    return f"{name} {quantity.scale * value:{form}} {quantity.unit}".strip()


def _why_not(made: Plan) -> str:
    size = made.family.bases[-1].size
    for key in QUANTITY_KEYS:
        domain = made.family.components(key, size).domain
        if domain > made.goals[key]:
            return f"the domain alone leaves more in the {key}: take a wider and longer ground"
    return "runs far finer or far more of them would be needed"
