# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of runs that differ in size, packing and domain: their line to size zero, their scatter.

The value at size h (edge of a cell, diameter of a grain) is taken as f0 + C h.
"""

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..arrays import Floats

LEAST_RELATIVE_ERROR = 1e-3  # of a value in a fit: no time average is taken to be better


class Fit(NamedTuple):
    """f = at_zero + slope h, with standard errors."""

    at_zero: float
    slope: float
    at_zero_error: float
    slope_error: float
    spread: float  # square of the scatter about the line over what the errors allow; 1 or more

    def at(self, size: float) -> float:
        return self.at_zero + self.slope * size


def line_covariance(sizes: npt.ArrayLike, errors: npt.ArrayLike) -> Floats:
    """(2, 2) of at_zero and slope, of values (n) with these errors, each above 0."""
    design = _weighted(sizes, errors)
    inverse: Floats = np.linalg.inv(design.T @ design)
    return inverse


def fit_line(sizes: npt.ArrayLike, values: npt.ArrayLike, errors: npt.ArrayLike) -> Fit:
    """By least squares, weighted with the errors (all of n) of the values, each above 0.

    Where the values scatter about the line by more than their errors, that scatter counts.
    """
    h, f = np.asarray(sizes, float), np.asarray(values, float)
    weight = 1.0 / np.asarray(errors, float)
    design, inverse = _weighted(h, errors), line_covariance(h, errors)
    at_zero, slope = inverse @ design.T @ (f * weight)
    spread = 1.0
    if len(h) > 2:
        residuals = (f - at_zero - slope * h) * weight
        spread = float(max(np.sum(residuals**2) / (len(h) - 2), 1.0))
    found = np.sqrt(spread * np.diag(inverse))
    return Fit(float(at_zero), float(slope), float(found[0]), float(found[1]), spread)


def _weighted(sizes: npt.ArrayLike, errors: npt.ArrayLike) -> Floats:
    """(n, 2): of each value the factors of at_zero and slope, over its error."""
    h, weight = np.asarray(sizes, float), 1.0 / np.asarray(errors, float)
    design: Floats = np.column_stack([np.ones_like(h), h]) * weight[:, None]
    return design


def noise_of(value: float, error: float, packing: float) -> float:
    """For a fit: error of the time average, and scatter of packings (NaN: not known)."""
    least = max(error, LEAST_RELATIVE_ERROR * abs(value))
    return math.hypot(least, packing if math.isfinite(packing) else 0.0)


def same_size(a: float, b: float) -> bool:
    """Within 2 %: grains of another packing have another mean. Not known is no difference."""
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
