# SPDX-License-Identifier: GPL-2.0-or-later
"""A Gaussian process with Matérn's kernel, nu = 5/2, and one length per input [Rasmussen2006].

k(a, b) = s (1 + q + q^2/3) exp(-q), q^2 = 5 sum_i ((a_i - b_i)/l_i)^2. With the values y at X, the
noise variance v and A = (K + v I)^-1, the mean at x is k(x, X) A y and the covariance
k(x, x') - k(x, X) A k(X, x') + v delta. scikit-learn finds s, l and v by maximum likelihood.
"""

import math
import warnings
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.linalg import cho_solve, solve_triangular

from ..arrays import Floats
from ..errors import ResultsError
from ..programs import optional_module

FOLDS = 10
FEWEST_RUNS = 40  # below, 90 to 98 % inside the band cannot be checked
Z_95 = 1.959964  # half width of the 95 % band of a normal distribution in standard deviations
COVERAGE = (0.90, 0.98)  # accepted share of held-out runs inside the band
LARGEST_ERROR = 0.25  # accepted rms error of held-out runs over the spread of all runs
LEAST_NOISE, MOST_SIGNAL = 1e-6, 1e3  # v, s: keep the matrix well conditioned


@dataclass
class Process:
    """Gaussian process of one quantity. Inputs in [0, 1]; factor: of the standard deviation, by calibration."""

    x: Floats  # (n, inputs)
    y: Floats  # (n)
    lengths: Floats
    signal: float  # s, of (y - mean)/deviation
    noise: float  # v, of the same
    factor: float = 1.0
    mean: float = field(init=False)
    deviation: float = field(init=False)
    factored: Floats = field(init=False, repr=False)  # lower L of K + v I = L L^T
    weights: Floats = field(init=False, repr=False)  # A y

    def __post_init__(self) -> None:
        self.mean, self.deviation = float(np.mean(self.y)), float(np.std(self.y)) or 1.0
        matrix = self.kernel(self.x, self.x) + self.noise * np.eye(len(self.x))
        self.factored = np.linalg.cholesky(matrix)
        self.weights = cho_solve((self.factored, True), (self.y - self.mean) / self.deviation)

    def kernel(self, a: Floats, b: Floats) -> Floats:
        """(..., n, m) of points (..., n, inputs) and (..., m, inputs)."""
        a, b = a / self.lengths, b / self.lengths
        products = a @ np.swapaxes(b, -1, -2)
        squares = np.sum(a * a, -1)[..., :, None] + np.sum(b * b, -1)[..., None, :] - 2 * products
        q = np.sqrt(5 * np.maximum(squares, 0))
        values: Floats = self.signal * (1 + q + q * q / 3) * np.exp(-q)
        return values

    def mean_at(self, x: Floats) -> Floats:
        """Mean of the process at points (m, inputs)."""
        mean: Floats = self.mean + self.deviation * (self.kernel(x, self.x) @ self.weights)
        return mean

    def predict(self, x: Floats) -> tuple[Floats, Floats]:
        """Mean and calibrated standard deviation at points (m, inputs)."""
        k = self.kernel(x, self.x)
        reduction = solve_triangular(self.factored, k.T, lower=True)
        variance = self.signal + self.noise - np.sum(reduction**2, axis=0)
        deviation = self.factor * self.deviation * np.sqrt(np.maximum(variance, self.noise))
        return self.mean + self.deviation * (k @ self.weights), deviation

    def joint(self, x: Floats) -> tuple[Floats, Floats]:
        """Mean and covariance of sets of points (..., m, inputs)."""
        k = self.kernel(x, self.x)
        flat = solve_triangular(self.factored, k.reshape(-1, len(self.y)).T, lower=True)
        reduction = flat.T.reshape(k.shape)
        covariance = self.kernel(x, x) - reduction @ np.swapaxes(reduction, -1, -2)
        covariance += self.noise * np.eye(x.shape[-2])
        mean: Floats = self.mean + self.deviation * (k @ self.weights)
        return mean, (self.factor * self.deviation) ** 2 * covariance


@dataclass(frozen=True)
class HeldOut:
    """Predictions of each run by a process that was fitted without it."""

    predicted: Floats
    deviation: Floats  # calibrated
    factor: float
    coverage: float  # share of runs inside the 95 % band
    rms_error: float
    spread: float  # standard deviation of all runs


def fit_process(x: Floats, y: Floats) -> tuple[Process, HeldOut]:
    """@raises ResultsError without scikit-learn or enough runs"""
    if len(y) < FEWEST_RUNS:
        raise ResultsError(
            f"a surrogate needs {FEWEST_RUNS} runs or more to check its intervals (got {len(y)}); "
            "repeat the sweep with a larger --samples"
        )
    process = likeliest(x, y, None)
    fold = np.random.default_rng(0).permutation(len(y)) % FOLDS
    predicted, deviation = np.empty_like(y), np.empty_like(y)
    for k in range(FOLDS):
        rest = likeliest(x[fold != k], y[fold != k], process)
        predicted[fold == k], deviation[fold == k] = rest.predict(x[fold == k])
    factor, coverage = calibrate((y - predicted) / deviation, fold)
    process.factor = factor
    error = float(np.sqrt(np.mean((y - predicted) ** 2)))
    return process, HeldOut(
        predicted, factor * deviation, factor, coverage, error, float(np.std(y))
    )


def calibrate(z: Floats, fold: Any) -> tuple[float, float]:
    """Factor of the standard deviation, and the share of held-out runs inside the 95 % band.

    z: error over standard deviation of each held-out run. The factor brings 95 % of the runs inside.
    To count a fold, the factor comes from the other folds.
    """
    inside = [
        np.abs(z[fold == k]) <= Z_95 * factor_of(z[fold != k]) for k in range(int(np.max(fold)) + 1)
    ]
    return factor_of(z), float(np.mean(np.concatenate(inside)))


def factor_of(z: Floats) -> float:
    """Factor of the standard deviation that brings 95 % of the runs inside the band; of few runs all."""
    rank = min(math.ceil(0.95 * (len(z) + 1)), len(z))
    return float(np.sort(np.abs(z))[rank - 1]) / Z_95


def require_calibrated(name: str, held: HeldOut) -> None:
    """@raises ResultsError with the number"""
    low, high = COVERAGE
    if not low <= held.coverage <= high:
        raise ResultsError(
            f"{name}: {100 * held.coverage:.1f} % of the held-out runs lie inside the 95 % band, not "
            f"{100 * low:.0f} to {100 * high:.0f} %; add runs or narrow the ranges of the sweep"
        )
    if held.rms_error > LARGEST_ERROR * held.spread:
        raise ResultsError(
            f"{name}: the error of held-out runs is {100 * held.rms_error / held.spread:.0f} % of the spread "
            f"of all runs, not below {100 * LARGEST_ERROR:.0f} %; add runs or narrow the ranges of the sweep"
        )


def likeliest(x: Floats, y: Floats, start: Process | None) -> Process:
    """The process of maximum likelihood. start: where the search begins; None: from several places."""
    library = optional_module("sklearn.gaussian_process", "python3-sklearn")
    kernels = library.kernels
    lengths = np.ones(x.shape[1]) if start is None else start.lengths
    signal, noise = (1.0, 1e-3) if start is None else (start.signal, start.noise)
    kernel = kernels.ConstantKernel(signal, (1e-3, MOST_SIGNAL)) * kernels.Matern(
        lengths, (0.05, 100.0), nu=2.5
    ) + kernels.WhiteKernel(noise, (LEAST_NOISE, 1.0))
    model = library.GaussianProcessRegressor(
        kernel, normalize_y=True, n_restarts_optimizer=1 if start is None else 0, random_state=0
    )
    one_thread = optional_module("threadpoolctl", "python3-sklearn").threadpool_limits(
        1
    )  # small matrices
    with one_thread, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a length at its bound: an input without influence
        model.fit(x, y)
    product, white = model.kernel_.k1, model.kernel_.k2
    return Process(
        x,
        y,
        np.broadcast_to(product.k2.length_scale, x.shape[1]).copy(),
        float(product.k1.constant_value),
        float(white.noise_level),
    )
