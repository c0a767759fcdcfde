# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil parameters from wheel tests: their posterior by Markov chain Monte Carlo with a surrogate.

Prior: uniform over the training range, in the logarithm for inputs that the surrogate scales so. The
likelihood is normal with the errors of the measurements and the covariance of the surrogate, which
all tests on one soil share. The sampler is that of Goodman and Weare [Goodman2010]: a walker moves on
the line through another walker, x' = y + Z (x - y).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import chi2

from ..arrays import Floats
from ..csv_table import read_columns
from ..errors import ResultsError
from .model import Surrogate

WALKERS, STEPS = 40, 400  # of which the first half is left out
STRETCH = 2.0  # largest Z
MOST_RHAT = 1.1  # ratio of the spread of the whole chain and within its quarters
NOT_IDENTIFIED = 0.8  # standard deviation of the posterior over that of the prior
COMBINED = 0.9  # correlation of two parameters that only their combination is identified
UNEXPLAINED = 1e-3  # probability of the misfit below which the tests contradict the surrogate
ERROR = "_error"  # behind the name of a measured column: its standard deviation


@dataclass(frozen=True)
class Tests:
    """Wheel tests on one soil: a row each."""

    known: Mapping[str, Floats]  # inputs of the surrogate
    measured: Mapping[str, tuple[Floats, Floats]]  # quantity -> values, standard deviations


@dataclass(frozen=True)
class Posterior:
    names: tuple[str, ...]
    samples: Floats  # (n, parameters), physical
    scaled: Floats  # of the same, in [0, 1]
    rhat: float
    misfit: float  # chi squared of the best sample
    values: int  # number of measured values

    @property
    def ratio(self) -> Floats:
        """Standard deviation of the posterior over that of the prior."""
        ratio: Floats = np.std(self.scaled, axis=0) * np.sqrt(12)
        return ratio

    def remarks(self) -> list[str]:
        """Remarks on what the tests cannot identify."""
        found = [
            f"{name} is not identified: its posterior is {100 * ratio:.0f} % as wide as the prior"
            for name, ratio in zip(self.names, self.ratio)
            if ratio > NOT_IDENTIFIED
        ]
        if len(self.names) > 1:
            correlation = np.corrcoef(self.scaled.T)
            for i, j in zip(*np.triu_indices(len(self.names), 1)):
                if abs(correlation[i, j]) > COMBINED:
                    found.append(
                        f"{self.names[i]} and {self.names[j]} are identified in combination only: "
                        f"their correlation is {correlation[i, j]:.2f}"
                    )
        freedom = max(self.values - len(self.names), 1)
        if chi2.sf(self.misfit, freedom) < UNEXPLAINED:
            found.append(
                f"the tests contradict the surrogate: chi squared is {self.misfit:.0f} for {freedom} degrees "
                "of freedom. Check units, wheel and errors of the measurements"
            )
        return found


def read_tests(file: Path, surrogate: Surrogate, constants: Mapping[str, float]) -> Tests:
    """A CSV with inputs, quantities and their errors. @raises ResultsError"""
    columns = {**read_columns(file)}
    rows = len(next(iter(columns.values()), ()))
    measured = {}
    for name in surrogate.processes:
        if name in columns:
            if name + ERROR not in columns:
                raise ResultsError(
                    f"{file}: '{name}' has no column '{name}{ERROR}' with its standard deviation"
                )
            measured[name] = (columns.pop(name), columns.pop(name + ERROR))
            if not np.all(measured[name][1] > 0):
                raise ResultsError(f"{file}: {name}{ERROR} must be above 0 in every row")
    if not measured:
        raise ResultsError(f"{file}: has none of the columns {', '.join(surrogate.processes)}")
    known = {**columns, **{name: np.full(rows, value) for name, value in constants.items()}}
    for name, values in known.items():
        if name not in surrogate.names:
            raise ResultsError(
                f"{file}: the surrogate has no input '{name}'; it has {', '.join(surrogate.names)}"
            )
        surrogate.require_range(name, values)
    if set(known) == set(surrogate.names):
        raise ResultsError(
            f"{file}: gives all inputs of the surrogate; leave out the parameters to identify"
        )
    return Tests(known, measured)


def identify(surrogate: Surrogate, tests: Tests, seed: int = 0, steps: int = STEPS) -> Posterior:
    """@raises ResultsError where the chain has not converged"""
    names = tuple(name for name in surrogate.names if name not in tests.known)
    columns = [surrogate.names.index(name) for name in names]
    rows = len(next(iter(tests.measured.values()))[0])
    base = np.zeros((rows, len(surrogate.names)))
    for name, values in tests.known.items():
        k = surrogate.names.index(name)
        base[:, k] = surrogate.inputs[k].scaled(values)

    def misfit(u: Floats) -> tuple[Floats, Floats]:
        """Chi squared, and log likelihood, of (n, parameters)."""
        x = np.broadcast_to(base, (len(u), *base.shape)).copy()
        x[:, :, columns] = u[:, None, :]
        squares, determinants = np.zeros(len(u)), np.zeros(len(u))
        for name, (values, errors) in tests.measured.items():
            mean, covariance = surrogate.processes[name].joint(x)
            factor = np.linalg.cholesky(covariance + np.diag(errors**2))
            residual = np.linalg.solve(factor, (values - mean)[..., None])[..., 0]
            squares += np.sum(residual**2, -1)
            determinants += np.sum(np.log(np.diagonal(factor, axis1=-2, axis2=-1)), -1)
        return squares, -0.5 * squares - determinants

    random = np.random.default_rng(seed)
    walkers = random.random((WALKERS, len(names)))
    likelihood = misfit(walkers)[1]
    chain = np.empty((steps, WALKERS, len(names)))
    half = WALKERS // 2
    for step in range(steps):
        for mine, others in (
            (slice(0, half), slice(half, None)),
            (slice(half, None), slice(0, half)),
        ):
            partner = walkers[others][random.integers(0, half, half)]
            z = ((STRETCH - 1) * random.random(half) + 1) ** 2 / STRETCH
            proposed = partner + z[:, None] * (walkers[mine] - partner)
            inside = np.all((proposed >= 0) & (proposed <= 1), axis=1)
            candidate = np.full(half, -np.inf)
            if inside.any():
                candidate[inside] = misfit(proposed[inside])[1]
            gain = candidate - likelihood[mine] + (len(names) - 1) * np.log(z)
            taken = np.log(random.random(half)) < gain
            likelihood[mine] = np.where(taken, candidate, likelihood[mine])
            walkers[mine] = np.where(taken[:, None], proposed, walkers[mine])
        chain[step] = walkers
    rhat = _rhat(chain[steps // 2 :])
    if rhat > MOST_RHAT:
        raise ResultsError(
            f"the chain has not converged: R-hat is {rhat:.2f}, not below {MOST_RHAT}; give more tests, or fewer "
            "unknown parameters by --set"
        )
    scaled = chain[steps // 2 :].reshape(-1, len(names))
    samples = np.column_stack(
        [surrogate.inputs[k].physical(scaled[:, i]) for i, k in enumerate(columns)]
    )
    some = scaled[random.integers(0, len(scaled), 500)]
    count = rows * len(tests.measured)
    return Posterior(names, samples, scaled, rhat, float(misfit(some)[0].min()), count)


def _rhat(chain: Floats) -> float:
    """R-hat of Gelman and Rubin over the quarters of the chain of all walkers; the largest of the parameters."""
    parts = chain[: len(chain) // 4 * 4].reshape(4, -1, chain.shape[-1])
    within = np.mean(np.var(parts, axis=1, ddof=1), axis=0)
    between = np.var(np.mean(parts, axis=1), axis=0, ddof=1)
    return float(np.max(np.sqrt(1 + between / within)))
