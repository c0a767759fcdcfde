# SPDX-License-Identifier: GPL-2.0-or-later
"""A number that a test gives, with its error; what several kinds of tests need to find one.

The standard errors of means are those of blocks of the curve, those of fits come from the
covariance of the residuals.
"""

from dataclasses import dataclass

import numpy as np

from ..uncertainty.statistics import block_mean
from ..arrays import Floats


@dataclass(frozen=True)
class LaboratoryQuantity:
    """A number that a test gives; error: standard error, NaN where it is not known."""

    name: str
    value: float
    error: float
    unit: str
    meaning: str

    def line(self) -> str:
        return (
            f"  {self.name:26} {self.value:12.5g} ± {self.error:<10.3g} {self.unit:6} "
            f"{self.meaning}"
        )


def degrees(radians: Floats) -> tuple[float, float]:
    """Mean and standard error in degrees."""
    mean, error = block_mean(radians)
    return float(np.degrees(mean)), float(np.degrees(error))


def around_peak(values: Floats) -> tuple[int, int, float]:
    """Place of the peak of a smoothed curve, half the width about it, and the smoothed peak."""
    window = max(len(values) // 40, 3)
    smooth = np.convolve(values, np.ones(window) / window, mode="valid")
    return int(np.argmax(smooth)) + window // 2, window, float(smooth.max())
