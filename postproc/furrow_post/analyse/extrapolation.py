# SPDX-License-Identifier: GPL-2.0-or-later
"""Two runs of one family, extrapolated to size zero: often cheaper than one fine run.

With the order p of their family, which at least three sizes have shown (grid_convergence.py), and
sizes h1 > h2,

    f0 = (h1^p f2 - h2^p f1)/(h1^p - h2^p),

so that independent errors u of the two runs count as hypot(h1^p u2, h2^p u1)/(h1^p - h2^p): more
than one run's. The error of f0 is its distance from the best estimate of the whole family, with the
error of that, of time averages and packings so enlarged, and of the domain, which both share.
"""

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ..read.wheel_run import cells_or_grains
from .cost import Assessed, ByQuantity, HasErrors
from .cost_table import QUANTITY_KEYS


@dataclass(frozen=True)
class Pair(HasErrors):
    """Two runs of a family and the relative numerical error of what they come to at size zero."""

    coarse: Assessed
    fine: Assessed
    errors: ByQuantity  # relative, NaN: not known

    @property
    def runs(self) -> tuple[Assessed, Assessed]:
        return self.coarse, self.fine

    @property
    def cpu_time(self) -> float:
        """[s] of one core, of both."""
        return self.coarse.cpu_time + self.fine.cpu_time

    @property
    def references(self) -> ByQuantity:
        """Best estimates of the family."""
        return self.fine.references

    def describe(self) -> str:
        row, sizes = self.fine.row, [1e3 * run.row.size for run in self.runs]
        return (
            f"{row.ground}, {cells_or_grains(row.ground)} of {sizes[0]:.3g} and {sizes[1]:.3g} mm "
            f"extrapolated to size zero, {row.model} model, {row.wheel}"
        )

    def at_size_zero(
        self, key: str, coarse: tuple[float, float], fine: tuple[float, float]
    ) -> tuple[float, float]:
        """Value and standard error at size zero; coarse, fine: value and standard error of each."""
        order = self.fine.orders[key]
        h1, h2 = self.coarse.row.size**order, self.fine.row.size**order
        (f1, u1), (f2, u2) = coarse, fine
        return (h1 * f2 - h2 * f1) / (h1 - h2), math.hypot(h1 * u2, h2 * u1) / (h1 - h2)


def pairs(assessed: Sequence[Assessed]) -> Iterator[Pair]:
    """Pairs of runs of one family that is the wanted wheel's, with different sizes and known orders."""
    for one, other in itertools.combinations(assessed, 2):
        fine, coarse = sorted((one, other), key=lambda a: a.row.size)
        stands_in = any(model > 0 for model in fine.models.values())
        same = one.row.family == other.row.family and coarse.row.size > fine.row.size
        known = all(math.isfinite(order) for order in fine.orders.values())
        if not same or stands_in or not known:
            continue
        yield _assessed_pair(coarse, fine)


def _assessed_pair(coarse: Assessed, fine: Assessed) -> Pair:
    pair = Pair(coarse, fine, {})
    for key in QUANTITY_KEYS:
        reference, parts = fine.references[key], fine.parts[key]
        value, time_error = pair.at_size_zero(key, coarse.row.value(key), fine.row.value(key))
        _, packing_error = pair.at_size_zero(key, (0.0, parts.packing), (0.0, parts.packing))
        # what is not known counts as in Budget.total
        known = [e for e in (packing_error, parts.domain) if math.isfinite(e)]
        total = math.hypot(value - reference, fine.reference_errors[key], time_error, *known)
        resolved = math.isfinite(fine.errors[key])
        pair.errors[key] = total / abs(reference) if resolved else math.nan
    return pair


def better_pair(
    assessed: Sequence[Assessed], error: float, run: Assessed, within: bool
) -> Pair | None:
    """The pair to take instead of this run, if any.

    It is within the relative error and cheaper than a run that is; or, where no run is, the
    cheapest within the error, else that of the least error if less than the run's.
    """
    known = [pair for pair in pairs(assessed) if math.isfinite(pair.error)]
    good = [pair for pair in known if pair.error <= error]
    if within:
        good = [pair for pair in good if pair.cpu_time < run.cpu_time]
    if good or within:
        return min(good, key=lambda pair: pair.cpu_time) if good else None
    best = min(known, key=lambda pair: pair.error, default=None)
    return best if best and best.error < run.error else None
