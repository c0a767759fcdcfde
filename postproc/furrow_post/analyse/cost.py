# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against cost of the runs of one scene, and which run to take for a wanted error."""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..csv_table import in_cells, write_rows
from ..errors import ResultsError
from ..formatting import duration
from ..read.wheel_run import cells_or_grains
from . import cost_table
from .budget import Budget
from .cost_table import QUANTITY_KEYS, FamilyKey, Row

ByQuantity = dict[str, float]  # key of a quantity -> number


class HasErrors:
    """What has a relative error of each quantity, NaN where it is not known."""

    errors: ByQuantity

    @property
    def error(self) -> float:
        """The worst; NaN where one is not known."""
        errors = self.errors.values()
        return max(errors) if all(math.isfinite(e) for e in errors) else math.nan

    @property
    def worst(self) -> str:
        return max(self.errors, key=lambda key: self.errors[key])


@dataclass
class Assessed(HasErrors):
    """A run with its relative numerical error, worst of hub drop and coefficient."""

    row: Row
    errors: ByQuantity  # relative, NaN: not known
    parts: dict[str, Budget]  # in the quantity's unit
    references: ByQuantity  # best estimates of the wanted wheel
    reference_errors: ByQuantity  # their standard errors, of standing in too
    orders: ByQuantity  # of the family's extrapolation to zero size; NaN where there is none
    models: ByQuantity  # relative error of standing in for the wanted wheel; 0: it is that
    pareto: bool = False  # nothing is cheaper and better

    @property
    def cpu_time(self) -> float:
        """[s] of one core."""
        return self.row.cpu_time

    def describe(self) -> str:
        row = self.row
        kind = cells_or_grains(row.ground)
        return f"{row.ground}, {kind} of {1e3 * row.size:.3g} mm, {row.model} model, {row.wheel}"


def assess(rows: Sequence[Row], wheel: str = "") -> list[Assessed]:
    """Every base run of every family with its error against the best estimate of its own family.

    wheel: the one that is wanted. A run of another wheel errs by the difference of the two
    families' best estimates on its ground too.
    """
    families = cost_table.families(rows)
    found = []
    for family in families.values():
        target: cost_table.Family | None = family
        if wheel and family.key.wheel != wheel:
            same_ground = [
                other
                for key, other in families.items()
                if key.ground == family.key.ground and key.wheel == wheel
            ]
            target = same_ground[0] if same_ground else None
        found += [_assess_run(row, family, target) for row in family.bases]
    best = math.inf
    known = (a for a in found if math.isfinite(a.error))
    for assessed in sorted(known, key=lambda a: (a.row.cpu_time, a.error)):
        assessed.pareto = assessed.error < best
        best = min(best, assessed.error)
    return sorted(found, key=lambda a: (a.row.family, a.row.cpu_time))


def _assess_run(row: Row, family: cost_table.Family, target: cost_table.Family | None) -> Assessed:
    """target: the family of the wanted wheel, None where the table has none."""
    result = Assessed(row, {}, {}, {}, {}, {}, {})
    for key in QUANTITY_KEYS:
        component = family.components(key, row.size, row.value(key)[1])
        own, own_error = family.reference(key)
        reference, reference_error = target.reference(key) if target else (own, math.nan)
        series = family.convergence(key)
        result.orders[key] = series.used_order if series else math.nan
        result.models[key] = abs(own - reference) / abs(reference)
        if target is not family:
            reference_error = math.hypot(reference_error, own_error)
        result.parts[key], result.references[key] = component, reference
        result.reference_errors[key] = reference_error
        # A best estimate that is open by more than half of it says nothing of errors
        resolved = math.isfinite(component.size) and reference_error < 0.5 * abs(reference)
        total = math.nan
        if resolved:
            other_wheel = reference_error if target is not family else 0.0  # own: in the component
            total = math.hypot(component.total, other_wheel, own - reference)
        result.errors[key] = total / abs(reference)
    return result


def recommend(
    assessed: Sequence[Assessed], error: float, grounds: Collection[str] | None = None
) -> tuple[Assessed, bool]:
    """The cheapest run within the relative error, else that of least error; whether it is within.

    @raises ResultsError where the error of no run is known
    """
    known = [
        a
        for a in assessed
        if math.isfinite(a.error) and (grounds is None or a.row.ground in grounds)
    ]
    if not known:
        raise ResultsError(
            "no family of the table has two sizes whose difference stands out from their noise, so "
            "that no error is known; add a run of another size, or longer runs"
        )
    within = [a for a in known if a.error <= error]
    if within:
        return min(within, key=lambda a: a.row.cpu_time), True
    return min(known, key=lambda a: a.error), False


class Extrapolation(NamedTuple):
    """What a family would need for a wanted error."""

    family: FamilyKey
    size: float  # [m]
    cpu_time: float  # [s] of one core, by a power law through the family's runs


def needed(assessed: Sequence[Assessed], error: float) -> list[Extrapolation]:
    """Size and time at which the fits come down to this error, cheapest first; extrapolated by the observed
    order, or by the first where there is none."""
    found = []
    for key, family in cost_table.families([a.row for a in assessed]).items():
        finest = min((a for a in assessed if a.row.family == key), key=lambda a: a.row.size)
        if not math.isfinite(finest.error) or len({row.size for row in family.bases}) < 2:
            continue
        sizes = []
        for quantity, parts in finest.parts.items():
            reference = finest.references[quantity]
            total = (finest.errors[quantity] * reference) ** 2
            rest = math.sqrt(max(total - parts.size**2, 0.0))
            room = (error * reference) ** 2 - rest**2
            reachable = room > 0 and parts.size > 0
            order = finest.orders[quantity]
            power = 1 / order if math.isfinite(order) else 1.0
            sizes.append(finest.row.size * (math.sqrt(room) / parts.size) ** power if reachable else 0.0)
        if min(sizes) > 0:
            size, time = np.log([[row.size, row.cpu_time] for row in family.bases]).T
            slope, level = np.polyfit(size, time, 1)
            cpu_time = float(np.exp(level + slope * math.log(min(sizes))))
            found.append(Extrapolation(key, min(sizes), cpu_time))
    return sorted(found, key=lambda e: e.cpu_time)


def advice(assessed: Sequence[Assessed], error: float) -> list[str]:
    """Sentences: the choice and why."""
    try:
        choice, within = recommend(assessed, error)
    except ResultsError as trouble:
        return [f"No recommendation: {trouble}."]
    cost = f"{duration(choice.row.cpu_time)} of one core"
    if within:
        lines = [
            f"For {100 * error:g} % error use {choice.describe()}: it takes {cost}, "
            f"error {100 * choice.error:.0f} % ({choice.worst})."
        ]
    else:
        lines = [
            f"No run of the table reaches {100 * error:g} %; the best is {choice.describe()}: "
            f"{100 * choice.error:.0f} % ({choice.worst}), {cost}.",
            *extrapolation_advice(assessed, error),
        ]
    for ground in sorted({a.row.ground for a in assessed} - {choice.row.ground}):
        try:
            other, reached = recommend(assessed, error, {ground})
        except ResultsError:
            lines.append(f"{ground.capitalize()}: error not known.")
            continue
        lines.append(
            f"{ground.capitalize()}: {'at the least' if reached else 'at best'} "
            f"{other.describe()}, {100 * other.error:.0f} %, {duration(other.row.cpu_time)}."
        )
    return lines


def extrapolation_advice(assessed: Sequence[Assessed], error: float) -> list[str]:
    """What the cheapest family would need, as a sentence, or nothing."""
    return [
        f"By its fit, {family.ground} would need {cells_or_grains(family.ground)} of about "
        f"{1e3 * size:.2g} mm and {duration(cpu_time)} of one core: an extrapolation."
        for family, size, cpu_time in needed(assessed, error)[:1]
    ]


def cost_report(assessed: Sequence[Assessed], error: float) -> str:
    """The table of runs and the advice, for a person."""
    wide = max(len(a.row.run) for a in assessed)
    lines = [
        f"{'run':{wide}}  {'ground':10} {'model':6} {'wheel':12} {'size':>7} {'sinkage':>9} "
        f"{'error':>7} {'coeff.':>8} {'error':>7} {'cost':>9}"
    ]
    for a in assessed:
        row = a.row
        sinkage_error, coefficient_error = (
            f"{100 * e:.1f} %" if math.isfinite(e) else "?"
            for e in (a.errors["sinkage"], a.errors["coefficient"])
        )
        lines.append(
            f"{row.run:{wide}}  {row.ground:10} {row.model:6} {row.wheel:12} "
            f"{1e3 * row.size:4.3g} mm {1e3 * row.sinkage:6.1f} mm {sinkage_error:>7} "
            f"{row.coefficient:8.4f} {coefficient_error:>7} {duration(row.cpu_time):>9}"
            f"{'  *' if a.pareto else ''}"
        )
    return "\n".join(
        [
            *lines,
            "",
            "Errors are numerical: time average, size (against the best estimate of the same ground, "
            "grid convergence index), domain and packing",
            "where the table has runs for them. They do not hold what the law or the grains' "
            "contact lack. * nothing is cheaper and better,",
            "? the best estimate is open by more than half of it, or there is one size only.",
            "",
            *advice(assessed, error),
        ]
    )


def write_csv(path: Path, assessed: Sequence[Assessed]) -> None:
    """The assessed runs as a table."""
    rows = []
    for a in assessed:
        row: dict[str, object] = {"run": a.row.run, **a.row.family._asdict()}
        row |= {"size_m": a.row.size, "cpu_time_s": a.row.cpu_time, "pareto": int(a.pareto)}
        row |= {f"error_{key}": a.errors[key] for key in QUANTITY_KEYS}
        for key in QUANTITY_KEYS:
            row |= {f"{key}_{part}": a.parts[key].part(part) for part in Budget.NUMERICAL}
        rows.append(in_cells(row, 6))
    write_rows(path, rows, ["# relative numerical errors, CPU seconds of one core; empty: not known"])
