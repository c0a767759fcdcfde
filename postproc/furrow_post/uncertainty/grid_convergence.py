# SPDX-License-Identifier: GPL-2.0-or-later
"""Extrapolation of a value to zero size of cells or grains, and its error: one procedure for all.

As ASME V&V 20 and Roache's grid convergence index have it. The values of at least three sizes h,
monotonic, are taken as

    f(h) = f0 + a h^p,

by least squares, weighted with the errors of the values; three sizes lie on the curve. p is the
observed order. Where it is above 2.1, the two finest sizes are extrapolated with the second order. The grid convergence index, a bound that holds in 95 of 100 cases, is the safety
factor times the distance of the finest value from f0; a standard error is half of it.

There is no extrapolated value, and the value is that of the finest size, where there are fewer than
three sizes, the series is not monotonic by more than the standard errors of its steps, its order is
below 0.5, or its ends differ by less than twice the scatter. The bound is then three times the range of the values; of two sizes it is
Roache's for first order. Values of one size, such as those of several packings, count as their mean.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..arrays import Floats

LEAST_SIZES = 3
LEAST_ORDER, FORMAL_ORDER = 0.5, 2.0
ASYMPTOTIC = 2.1  # largest order of a series that is in its asymptotic range
SAFE, UNSURE = 1.25, 3.0  # safety factors of such a series, and of any other
COVERAGE = 2.0  # standard errors in the index
LEAST_RELATIVE_ERROR = 1e-3  # of a value in a fit: no time average is taken to be better
TRIED_ORDERS = np.linspace(0.02, 8.0, 400)


@dataclass(frozen=True)
class Convergence:
    """Result of a series of sizes. Errors are standard errors; NaN: not known."""

    sizes: tuple[float, ...]  # the finest first
    values: tuple[float, ...]  # of each, means
    value: float  # at size zero, or that of the finest size
    index_error: float  # half of the grid convergence index
    noise: float  # uncertainty of value from errors of the values
    order: float = math.nan  # observed; NaN where none could be
    used_order: float = math.nan  # of the extrapolation
    slope: float = math.nan  # a
    spread: float = 1.0  # square of the scatter about the curve over what the errors allow
    reason: str = ""  # why the value is not extrapolated; empty where it is

    @property
    def extrapolated(self) -> bool:
        return not self.reason

    @property
    def error(self) -> float:
        return math.hypot(self.index_error, self.noise)

    def at(self, size: float) -> float:
        """Value of a size on the curve, or by a straight line between the values."""
        if self.extrapolated:
            return float(self.value + self.slope * size**self.used_order)
        return float(np.interp(size, self.sizes, self.values))

    def size_error(self, size: float) -> float:
        """Error of a run of this size: its distance from value, and the error of that."""
        return math.hypot(self.at(size) - self.value, self.error)


def grid_convergence(
    sizes: Sequence[float], values: Sequence[float], errors: Sequence[float] | None = None
) -> Convergence:
    """Grid convergence of values at these sizes; errors: standard errors of the values, of time and packing."""
    h, f, u = _grouped(sizes, values, [0.0] * len(sizes) if errors is None else errors)
    count, series = len(h), (tuple(h), tuple(f))

    def finest(index: float, reason: str, order: float = math.nan) -> Convergence:
        """Result of the finest size without extrapolation. index: bound of its error"""
        return Convergence(*series, float(f[0]), index / COVERAGE, float(u[0]), order, reason=reason)

    if count < 2:
        return finest(math.nan, "only one size")
    if count < LEAST_SIZES:
        return finest(UNSURE * abs(f[1] - f[0]) / (h[1] / h[0] - 1.0), "fewer than three sizes")
    widest = UNSURE * float(max(f) - min(f))
    if abs(f[-1] - f[0]) < COVERAGE * math.hypot(u[0], u[-1]):
        return finest(widest, "the sizes differ by less than twice their scatter")
    steps = np.sign(f[-1] - f[0]) * np.diff(f)
    if not np.all(steps > np.hypot(u[1:], u[:-1])):
        return finest(widest, "the series is not monotonic beyond its scatter")
    order = observed_order(h, f, u)
    if order < LEAST_ORDER:
        return finest(widest, f"the observed order is below {LEAST_ORDER:g}", order)
    used, factor, fitted = order, SAFE, count
    if order > ASYMPTOTIC:  # its coarse sizes are not in the asymptotic range
        used, factor, fitted = FORMAL_ORDER, UNSURE, 2
    weights = _weights(f, u)[:fitted]
    (slope, zero), left, *_ = np.polyfit(h[:fitted] ** used, f[:fitted], 1, w=weights, full=True)
    spread = max(float(left[0]) / (fitted - LEAST_SIZES), 1.0) if fitted > LEAST_SIZES else 1.0
    noise = 0.0
    if float(np.max(u)) > 0.0 or spread > 1.0:
        noise = math.sqrt(spread * zero_variance(h[:fitted], 1.0 / weights, used, slope if fitted > 2 else None))
    index_error = factor * abs(f[0] - zero) / COVERAGE
    return Convergence(*series, float(zero), float(index_error), noise, order, used, float(slope), spread)


def observed_order(h: Floats, f: Floats, u: Floats) -> float:
    """p of f0 + a h^p with the least weighted sum of squares; 0 where no positive one is best."""
    weights, tried = _weights(f, u), TRIED_ORDERS
    left = _residuals(h, f, weights, tried)
    best = int(np.argmin(left))
    if best == 0:
        return 0.0
    for _ in range(3):
        low, high = tried[max(best - 1, 0)], tried[min(best + 1, len(tried) - 1)]
        tried = np.linspace(low, high, 101)
        best = int(np.argmin(_residuals(h, f, weights, tried)))
    return float(tried[best])


def _residuals(h: Floats, f: Floats, weights: Floats, orders: Floats) -> Floats:
    """(n) weighted sums of squares that the best curve of each order leaves."""
    w = weights**2 / np.sum(weights**2)
    x = (h / h.max()) ** orders[:, None]
    x = x - (x @ w)[:, None]
    y = f - w @ f
    slope = (x * y) @ w / np.maximum((x * x) @ w, 1e-300)
    left: Floats = ((y - slope[:, None] * x) ** 2) @ weights**2
    return left


def zero_variance(sizes: npt.ArrayLike, errors: npt.ArrayLike, order: float, slope: float | None) -> float:
    """Variance of f0, from values with these errors, each above 0. slope: a, where the order is fitted too."""
    h, weights = np.asarray(sizes, float), 1.0 / np.asarray(errors, float)
    columns = [np.ones_like(h), h**order]
    if slope is not None:
        columns.append(slope * h**order * np.log(h))
    design = np.column_stack(columns) * weights[:, None]
    scale = np.abs(design).max(axis=0)
    inverse = np.linalg.pinv(design / scale, rcond=1e-12)
    return float((inverse[0] @ inverse[0]) / scale[0] ** 2)


def _grouped(sizes: Sequence[float], values: Sequence[float], errors: Sequence[float]) -> tuple[Floats, Floats, Floats]:
    """Sizes, the finest first, with the weighted means of their values and the errors of those."""
    groups: list[list[tuple[float, float, float]]] = []
    for one in sorted(zip(map(float, sizes), map(float, values), map(float, errors))):
        if not groups or not same_size(one[0], groups[-1][0][0]):
            groups.append([])
        groups[-1].append(one)
    found = []
    for group in groups:
        h, f, u = np.array(group).T
        known = u.max() > 0
        weight = 1.0 / np.maximum(u, 1e-3 * u.max()) ** 2 if known else np.ones_like(u)
        found.append((h.mean(), np.average(f, weights=weight), 1.0 / math.sqrt(weight.sum()) if known else 0.0))
    h, f, u = np.array(found).T
    return h, f, u


def _weights(f: Floats, u: Floats) -> Floats:
    """Weights of the fit: one over the errors, or over a thousandth of the value without known errors."""
    largest = float(np.max(u))
    least = 1e-3 * largest or LEAST_RELATIVE_ERROR * max(float(np.max(np.abs(f))), 1e-300)
    weights: Floats = 1.0 / np.maximum(u, least)
    return weights


# ---- runs that differ in packing or domain


def noise_of(value: float, error: float, packing: float) -> float:
    """Noise of one value: error of the time average, and scatter of packings (NaN: not known)."""
    least = max(error, LEAST_RELATIVE_ERROR * abs(value))
    return math.hypot(least, packing if math.isfinite(packing) else 0.0)


def same_size(a: float, b: float) -> bool:
    """True for sizes within 2 %, as packings have different means, or if one is not known."""
    return not abs(a - b) > 0.02 * abs(b)


def pooled_scatter(groups: Iterable[Sequence[float]]) -> float:
    """Standard deviation of one value about the mean of its group; NaN where none has two."""
    several = [np.asarray(group) for group in groups if len(group) > 1]
    if not several:
        return math.nan
    squares = sum(float(np.sum((group - group.mean()) ** 2)) for group in several)
    return math.sqrt(squares / sum(len(group) - 1 for group in several))


def mean_shift(pairs: Iterable[tuple[float, Sequence[float]]]) -> float:
    """|mean| over the pairs of how far a value is from the mean of others; NaN without pairs."""
    shifts = [value - float(np.mean(others)) for value, others in pairs if len(others)]
    return abs(float(np.mean(shifts))) if shifts else math.nan
