# SPDX-License-Identifier: GPL-2.0-or-later
"""A Gaussian process of many runs on a fast ground, corrected by few runs on a better one [Kennedy2000].

y_better(x) = rho y_fast(x) + delta(x). y_fast is the process of the fast runs, and delta is a Gaussian process of the
residuals. rho comes from least squares with delta's covariance, an intercept and a prior. Both errors add:
s^2 = f^2 (rho^2 s_fast^2 + s_delta^2). Each better run is predicted without it, with rho and delta of the others.
These held-out runs set f.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.stats import t as student

from ..arrays import Floats
from ..errors import ResultsError
from ..uncertainty.statistics import rms
from .gaussian_process import Z_95, HeldOut, Process, factor_of, likeliest

MORE_RUNS = 3  # better runs beyond the number of inputs, at least
ROUNDS = 3  # of the search of rho and delta
RHO = (1.0, 1.0)  # mean and standard deviation of its prior: few runs leave rho open


@dataclass
class Corrected:
    """Process of one quantity on the better ground. factor: of the standard deviation, by calibration."""

    fast: Process
    rho: float
    delta: Process  # its x: of the better runs
    factor: float = 1.0

    def mean_at(self, x: Floats) -> Floats:
        """Mean at points (m, inputs)."""
        mean: Floats = self.rho * self.fast.mean_at(x) + self.delta.mean_at(x)
        return mean

    def predict(self, x: Floats) -> tuple[Floats, Floats]:
        """Mean and calibrated standard deviation at points (m, inputs)."""
        (fast, fast_deviation), (delta, deviation) = self.fast.predict(x), self.delta.predict(x)
        return self.rho * fast + delta, self.factor * np.hypot(self.rho * fast_deviation, deviation)

    def joint(self, x: Floats) -> tuple[Floats, Floats]:
        """Mean and covariance of sets of points (..., m, inputs)."""
        (fast, fast_covariance), (delta, covariance) = self.fast.joint(x), self.delta.joint(x)
        return self.rho * fast + delta, self.factor**2 * (self.rho**2 * fast_covariance + covariance)


@dataclass(frozen=True)
class Gain:
    """Rms errors at the better runs: of the fast process, and of held-out runs by a process of the better runs alone."""

    fast: float
    better: float


def correct(fast: Process, x: Floats, y: Floats) -> tuple[Corrected, HeldOut, Gain]:
    """x, y: the better runs. @raises ResultsError for too few"""
    fewest = x.shape[1] + MORE_RUNS
    if len(y) < fewest:
        raise ResultsError(
            f"a correction over {x.shape[1]} inputs needs {fewest} better runs or more (got {len(y)}); add runs"
        )
    whole, alone = _corrected(fast, x, y, None), likeliest(x, y, None)
    predicted, deviation = _held_out(x, y, lambda a, b: _corrected(fast, a, b, whole))
    z = (y - predicted) / deviation
    fitted = x.shape[1] + 2  # lengths, rho and intercept
    whole.factor = widening(z, fitted)
    inside = [abs(z[k]) <= Z_95 * widening(np.delete(z, k), fitted) for k in range(len(z))]
    by_better = _held_out(x, y, lambda a, b: likeliest(a, b, alone))[0]
    share, error = float(np.mean(inside)), rms(y - predicted)
    held = HeldOut(predicted, whole.factor * deviation, whole.factor, share, error, float(np.std(y)))
    return whole, held, Gain(rms(y - fast.mean_at(x)), rms(y - by_better))


def widening(z: Floats, fitted: int) -> float:
    """Factor of the standard deviation by few held-out runs; z: error over standard deviation of each.

    Few runs do not show a band that is too wide, so it is at least 1. Student's t, with a degree of freedom for each
    run beyond the fitted numbers, widens it.
    """
    return max(factor_of(z), 1.0) * float(student.ppf(0.975, max(len(z) - fitted, 1))) / Z_95


def _held_out(x: Floats, y: Floats, fit: Callable[[Floats, Floats], Process | Corrected]) -> tuple[Floats, Floats]:
    """Prediction and standard deviation of each run by a fit of the others."""
    predicted, deviation = np.empty_like(y), np.empty_like(y)
    for k in range(len(y)):
        rest = np.arange(len(y)) != k
        (predicted[k],), (deviation[k],) = fit(x[rest], y[rest]).predict(x[k : k + 1])
    return predicted, deviation


def _corrected(fast: Process, x: Floats, y: Floats, start: Corrected | None) -> Corrected:
    """rho and delta alternately. start: where the search begins."""
    known = fast.mean_at(x)
    basis = np.column_stack([np.ones(len(y)), known])
    rho = start.rho if start else RHO[0]
    delta = likeliest(x, y - rho * known, start.delta if start else None)
    for _ in range(ROUNDS):
        matrix, right = (solve_triangular(delta.factored, part, lower=True) for part in (basis, y))
        weight = delta.deviation / RHO[1]  # of the prior, a row more
        matrix, right = np.vstack([matrix, [0.0, weight]]), np.append(right, weight * RHO[0])
        rho = float(np.linalg.lstsq(matrix, right, rcond=None)[0][1])
        delta = likeliest(x, y - rho * known, delta)
    return Corrected(fast, rho, delta)
