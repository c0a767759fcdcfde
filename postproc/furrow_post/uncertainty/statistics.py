# SPDX-License-Identifier: GPL-2.0-or-later
"""Means, scatter and fits of series. Standard errors of steady values: see furrow-resistance."""

import math
from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from ..arrays import Floats

Item = TypeVar("Item")
Key = TypeVar("Key", bound=Hashable)
BLOCKS = 8  # number of blocks of a series, for the standard error of its mean


def rms(values: npt.ArrayLike) -> float:
    """Root of the mean square; NaN of nothing."""
    numbers = np.asarray(values, float)
    return float(np.sqrt(np.mean(np.square(numbers)))) if numbers.size else math.nan


def block_mean(values: Floats, blocks: int = BLOCKS) -> tuple[float, float]:
    """Mean and its standard error from the means of blocks; the error of one block is NaN."""
    parts = [part.mean() for part in np.array_split(values, min(blocks, len(values)))]
    if len(parts) < 2:
        return float(np.mean(values)), math.nan
    return float(np.mean(values)), float(np.std(parts, ddof=1) / np.sqrt(len(parts)))


def drift(values: Floats) -> float:
    """Mean of the second half of a series less that of the first."""
    middle = values.size // 2
    return float(values[middle:].mean() - values[:middle].mean())


def line_fit(x: Floats, y: Floats) -> tuple[float, float, Floats]:
    """Slope, intercept and their covariance (2, 2) by least squares.

    Two points have no residual, so no error: NaN.
    """
    design = np.column_stack((x, np.ones_like(x)))
    solution, *_ = np.linalg.lstsq(design, y, rcond=None)
    slope, intercept = float(solution[0]), float(solution[1])
    if len(x) < 3:
        return slope, intercept, np.full((2, 2), np.nan)
    variance = np.sum((y - design @ solution) ** 2) / (len(x) - 2)
    return slope, intercept, variance * np.linalg.inv(design.T @ design)


def moving_mean(values: Floats, window: int) -> Floats:
    """Means over a window of entries, which is cut off at both ends."""
    ones = np.ones(window)
    return np.convolve(values, ones, "same") / np.convolve(np.ones_like(values), ones, "same")


def commonest(values: Sequence[str]) -> str:
    """The value that stands most often in a list; of several the first in order."""
    return max(sorted(set(values)), key=list(values).count)


def place_of_greatest(x: Floats, values: Floats, count: int) -> float:
    """Mean of x (n) over the entries with so many of the greatest values (n)."""
    return float(x[np.argsort(values)[-count:]].mean())


def grouped(items: Iterable[Item], key: Callable[[Item], Key]) -> dict[Key, list[Item]]:
    """Items by their keys, both in the order in which they come."""
    groups: dict[Key, list[Item]] = {}
    for item in items:
        groups.setdefault(key(item), []).append(item)
    return groups
