# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits parameters to data by least squares, and states how well the data determine each of them.

Residuals r are (model - measured)/deviation or ln(model/measured)/deviation, of any number of tests. Positive parameters
are fitted in their logarithm, others in value/scale: z. A parameter with a prior has a spread, the standard deviation
of z about its start. Rows that are held out count in neither the fit nor the errors.

Uncertainties come from the Jacobian J of the residuals by z at the solution: covariance = (J^T J/s^2 + P)^-1, P the
inverse variances of the priors. The scatter s follows from the residuals, s^2 = sum r^2/(data - parameters used). For
data with known deviations it is at least 1 (Birge's ratio): the law misses them by more than their deviations. Residuals
of further samples at the solution, such as other packings, give s too. The covariance is linear: it is valid near the
solution, for small errors.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import norm

from ..arrays import Booleans, Floats
from ..errors import ResultsError
from ..uncertainty.statistics import rms

# A direction with a singular value below this part of the largest is within the noise of the slopes
LEAST_SINGULAR = 1e-5
# A parameter known no better than this (of ln, or of its scale) is not determined: a factor of e
LARGEST_DEVIATION = 1.0
KEPT = 100  # residuals of so many places: a slope asks for those of the step before
PARTNER = 0.1  # least part of a parameter in a direction that is reported

Residuals = Callable[[Floats], Floats]  # of the values of the parameters. @raises NotComputed


class NotComputed(ResultsError):
    """Refusal of a trial: impossible parameters, or a model without a solution."""


@dataclass(frozen=True)
class Parameter:
    """A number to be fitted; bounds may be infinite. spread: of a prior, in z about the start."""

    name: str
    unit: str
    start: float
    lower: float
    upper: float
    spread: float = math.inf
    linear: bool = False  # never in its logarithm

    @property
    def logarithmic(self) -> bool:
        return self.lower >= 0 and self.start > 0 and not self.linear

    @property
    def bounded(self) -> bool:
        """True for a parameter with bounds on both sides, in z."""
        return math.isfinite(self.low) and math.isfinite(self.high)

    @property
    def scale(self) -> float:
        """Scale s of z = value/s."""
        interval = self.upper - self.lower
        return interval if math.isfinite(interval) else abs(self.start) or 1.0

    @cached_property
    def low(self) -> float:
        return self.z(self.lower)

    @cached_property
    def high(self) -> float:
        return self.z(self.upper)

    @property
    def first(self) -> float:
        """z of the start, at a bound a thousandth inside."""
        margin = 1e-3 * (self.high - self.low if self.bounded else 1.0)
        return min(max(self.z(self.start), self.low + margin), self.high - margin)

    def z(self, value: float) -> float:
        if not self.logarithmic:
            return value / self.scale
        return math.log(value) if value > 0 else -math.inf

    def value(self, z: float) -> float:
        """Rounding does not leave the range."""
        value = math.exp(z) if self.logarithmic else z * self.scale
        return min(max(value, self.lower), self.upper)

    def in_units(self, deviation: float, value: float) -> float:
        """A small deviation of z as one of the value."""
        return deviation * (value if self.logarithmic else self.scale)

    def bound_met(self, z: float) -> str:
        """ "stands at its upper bound 0.04", or empty"""
        margin = 2e-3 * (self.high - self.low) if self.bounded else 0.0
        if z - self.low <= margin:
            return f"stands at its lower bound {self.lower:.10g}"
        if self.high - z <= margin:
            return f"stands at its upper bound {self.upper:.10g}"
        return ""


@dataclass(frozen=True)
class Search:
    """How a fit goes. step: of z for slopes; central: differences to both sides, else to one; update: slopes by
    differences once, then Broyden's updates, for models that take long."""

    step: float = 1e-4
    central: bool = True
    update: bool = False
    ftol: float = 1e-12
    xtol: float = 1e-9
    scale: str | float = "jac"  # of the first step
    evaluations: int = 400  # of the residuals, those of slopes apart


@dataclass(frozen=True)
class Fitted:
    """One parameter after the fit."""

    parameter: Parameter
    value: float
    deviation: float  # standard deviation, linearised; infinite where not determined, NaN: unknown
    determined: bool
    remark: str  # reason why the parameter is not determined, or its bound
    share: float = math.nan  # of the prior's variance that the data removed

    def interval(self, coverage: float = 0.95) -> tuple[float, float]:
        """Range that holds the value with this probability, of a normal distribution of z, within the bounds."""
        p = self.parameter
        half = float(norm.ppf(0.5 + 0.5 * coverage)) * self.deviation / p.in_units(1.0, self.value)
        return p.value(p.z(self.value) - half), p.value(p.z(self.value) + half)


@dataclass(frozen=True)
class Fit:
    """The result of a fit. slope: J of the rows that were fitted; directions: column k belongs to singular value k."""

    parameters: tuple[Fitted, ...]
    z: Floats
    start: Floats  # residuals at the start, held-out rows too
    residuals: Floats  # of the rows that were fitted
    held: Floats  # of those held out
    slope: Floats
    correlation: Floats
    singular_values: Floats
    directions: Floats
    scatter: float  # s
    known: bool
    evaluations: int = 0
    end: str = ""  # reason for the end of the iteration
    converged: bool = True

    @property
    def values(self) -> Floats:
        return np.array([fitted.value for fitted in self.parameters])

    @property
    def rms(self) -> float:
        return rms(self.residuals)

    @property
    def rms_held(self) -> float:
        """Rms of the rows held out: what the fit predicts; NaN of none."""
        return rms(self.held)

    @property
    def value_slope(self) -> Floats:
        """Slopes by the values in place of z."""
        slope: Floats = self.slope / np.array([f.parameter.in_units(1.0, f.value) for f in self.parameters])
        return slope

    def with_samples(self, samples: Sequence[Floats]) -> "Fit":
        """Errors with the scatter of further samples: their residuals at the solution, of the rows that were fitted."""
        parameters = [fitted.parameter for fitted in self.parameters]
        wider = assess(parameters, self.z, self.residuals, self.slope, self.known, None, samples)
        kept = ("start", "held", "evaluations", "end", "converged")
        return replace(wider, **{name: getattr(self, name) for name in kept})

    def weak(self, share: float) -> list[tuple[float, Floats]]:
        """Singular values below a share of the largest, over it, with their directions."""
        largest = max(float(self.singular_values[0]), 1e-300)
        pairs = zip(self.singular_values / largest, self.directions.T)
        return [(float(value), direction) for value, direction in pairs if value < share]

    def next_step(self, share: float) -> Floats:
        """Gauss-Newton step in z, inside the bounds; none along directions below a share of the largest."""
        step = -np.linalg.pinv(self.slope, rcond=share) @ self.residuals
        low, high = (np.array([getattr(f.parameter, end) for f in self.parameters]) for end in ("low", "high"))
        inside: Floats = np.clip(self.z + step, low, high) - self.z
        return inside


class _Problem:
    """Residuals and slopes as functions of z, with those of the priors."""

    def __init__(self, parameters: Sequence[Parameter], residuals: Residuals, search: Search, held: Booleans | None):
        self.parameters, self.residuals, self.search = parameters, residuals, search
        self.fitted: slice | Booleans = slice(None) if held is None else ~held
        self.evaluations = 0
        self.low, self.high, self.first = (np.array([getattr(p, end) for p in parameters]) for end in ("low", "high", "first"))
        self.weight = np.array([1.0 / p.spread for p in parameters])
        self.last: tuple[Floats, Floats, Floats] | None = None  # z, residuals and slopes of the last update
        self.cache: dict[bytes, Floats] = {}

    def values(self, z: Floats) -> Floats:
        return np.array([p.value(one) for p, one in zip(self.parameters, z)])

    def at(self, z: Floats) -> Floats:
        """Residuals of all rows. @raises NotComputed"""
        key = z.tobytes()
        if key not in self.cache:
            self.evaluations += 1
            if len(self.cache) > KEPT:
                self.cache.clear()
            self.cache[key] = np.asarray(self.residuals(self.values(z)), float)
        return self.cache[key]

    def whole(self, z: Floats) -> Floats:
        """Rows that are fitted, then those of priors; NaN where they cannot be computed: SciPy shortens its step."""
        prior = ((z - self.first) * self.weight)[self.weight > 0]
        try:
            return np.concatenate((self.at(z)[self.fitted], prior))
        except NotComputed:
            return np.full(self.size, np.nan)

    def whole_slope(self, z: Floats) -> Floats:
        return np.vstack((self.slope(z), np.diag(self.weight)[self.weight > 0]))

    def slope(self, z: Floats) -> Floats:
        """Slopes of the rows that are fitted."""
        here = self.at(z)[self.fitted]
        if self.search.update and self.last is not None:
            before, residuals, slope = self.last
            if np.array_equal(before, z):
                return slope
            step = z - before
            slope = slope + np.outer(here - residuals - slope @ step, step) / (step @ step)
        else:
            slope = self.differences(z, here)
        self.last = (z.copy(), here, slope)
        return slope

    def differences(self, z: Floats, here: Floats) -> Floats:
        """@raises ResultsError where a parameter can go neither way"""
        columns = []
        for j, place in enumerate(z):
            if self.search.central:
                ends = [self._end(z, j, way) or (place, here) for way in (-1, 1)]
            else:
                ends = [(place, here), self._end(z, j, 1) or self._end(z, j, -1) or (place, here)]
            (behind, low), (ahead, high) = ends
            if behind == ahead:
                raise ResultsError(
                    "fit: the curves cannot be computed on either side of "
                    f"{self.parameters[j].name} = {self.parameters[j].value(place):g}; narrow its bounds"
                )
            columns.append((high - low) / (ahead - behind))
        return np.array(columns).T

    def _end(self, z: Floats, j: int, way: int) -> tuple[float, Floats] | None:
        """Place and residuals a step away, with central differences up to the bound; None where there are none."""
        moved, place = z.copy(), z[j] + way * self.search.step
        moved[j] = min(max(place, self.low[j]), self.high[j])
        if moved[j] != place and not self.search.central:
            return None
        try:
            return moved[j], self.at(moved)[self.fitted]
        except NotComputed:
            return None

    @property
    def size(self) -> int:
        return len(self.at_start[self.fitted]) + int(np.count_nonzero(self.weight))

    @cached_property
    def at_start(self) -> Floats:
        return self.at(self.first)


def fit(
    parameters: Sequence[Parameter],
    residuals: Residuals,
    search: Search = Search(),
    known: bool = True,
    held: Booleans | None = None,
) -> Fit:
    """Fits parameters to the residuals of all tests. known: the deviations of the data are; held: rows that are held
    out.

    @raises ResultsError where residuals cannot be computed at the start or around the solution
    """
    problem = _Problem(parameters, residuals, search, held)
    start = problem.at_start
    # From the start on: the size of a logarithm, by which xtol is measured, depends on units
    found = least_squares(
        lambda way: problem.whole(problem.first + way),
        np.zeros(len(problem.first)),
        jac=lambda way: problem.whole_slope(problem.first + way),
        bounds=(problem.low - problem.first, problem.high - problem.first),
        x_scale=search.scale,
        ftol=search.ftol,
        xtol=search.xtol,
        gtol=None,
        max_nfev=search.evaluations,
    )
    z: Floats = problem.first + found.x
    rows = problem.at(z)
    ends = {0: f"{search.evaluations} evaluations were not enough", 2: "the sum of squares no longer falls"}
    return replace(
        assess(parameters, z, rows, found.jac[: len(rows[problem.fitted])], known, held),
        start=start,
        evaluations=problem.evaluations,
        end=ends.get(found.status, "the parameters no longer change"),
        converged=found.status > 0,
    )


def plain(start: Sequence[float], lower: Sequence[float], upper: Sequence[float]) -> list[Parameter]:
    """Parameters without names that are never fitted in their logarithm."""
    return [Parameter(f"x{k}", "", *values, linear=True) for k, values in enumerate(zip(start, lower, upper))]


def slopes(parameters: Sequence[Parameter], residuals: Residuals, z: Floats, search: Search = Search()) -> Floats:
    """Slopes of the residuals at z by differences."""
    problem = _Problem(parameters, residuals, search, None)
    return problem.differences(z, problem.at(z))


def assess(
    parameters: Sequence[Parameter],
    z: Floats,
    rows: Floats,
    slope: Floats,
    known: bool = True,
    held: Booleans | None = None,
    samples: Sequence[Floats] = (),
) -> Fit:
    """Uncertainties at a solution, and what the data leave open. slope: of the rows that were fitted"""
    at_end = rows if held is None else rows[~held]
    weight = np.array([1.0 / parameter.spread for parameter in parameters])
    _, singular, directions = np.linalg.svd(slope, full_matrices=False)
    priors = bool(weight.any())
    information = slope.T @ slope
    spare = float(len(at_end) - len(z))
    if priors:
        used = np.trace(np.linalg.solve(information + np.diag(weight**2), information))
        spare = max(len(at_end) - float(used), 1.0)
    birge = math.sqrt(float(at_end @ at_end) / spare) if spare > 0 else 1.0
    scatter = max(1.0, birge) if known else birge
    if len(samples):
        apart = np.var([at_end, *samples], axis=0, ddof=1)
        scatter = max(scatter, float(np.sqrt(np.mean(apart))))

    covariance = np.zeros((len(z), len(z)))
    left_open: dict[int, str] = {}  # parameter -> reason why it is not determined
    names = [parameter.name for parameter in parameters]
    if priors:
        covariance = np.linalg.inv(information / scatter**2 + np.diag(weight**2))
    for value, direction in zip(singular, directions) if not priors else ():
        if singular[0] > 0 and value > LEAST_SINGULAR * singular[0]:
            covariance += np.outer(direction, direction) * (scatter / value) ** 2
            continue
        partners = np.flatnonzero(np.abs(direction) > PARTNER)
        why = f"the curves depend only on a combination of {', '.join(names[i] for i in partners)}"
        if len(partners) == 1:
            why = "the curves do not depend on it"
        left_open.update(dict.fromkeys(partners.tolist(), why))
    deviations = np.sqrt(np.diag(covariance))
    product = np.outer(deviations, deviations)
    correlation = np.divide(covariance, product, out=np.zeros_like(product), where=product > 0)
    np.fill_diagonal(correlation, 1.0)

    def fitted(i: int) -> Fitted:
        parameter = parameters[i]
        deviation = math.inf if i in left_open or spare < 0 else float(deviations[i])
        value = parameter.value(z[i])
        remark, determined = left_open.get(i, ""), i not in left_open
        if determined and deviation > LARGEST_DEVIATION:
            determined = False
            remark = "known no better than its range or size"
            if parameter.logarithmic:
                remark = "known to no better than a factor of e"
        elif determined and spare == 0 and not known:
            deviation = math.nan
            remark = "as many data as parameters: no scatter to judge by, unless the deviation of the data is given"
        if bound := parameter.bound_met(z[i]):
            remark, determined = bound, False
        share = 1.0 - (deviation / parameter.spread) ** 2 if math.isfinite(parameter.spread) else math.nan
        return Fitted(parameter, value, parameter.in_units(deviation, value), determined, remark, share)

    return Fit(
        parameters=tuple(fitted(i) for i in range(len(z))),
        z=z,
        start=rows,
        residuals=at_end,
        held=rows[held] if held is not None else np.zeros(0),
        slope=slope,
        correlation=correlation,
        singular_values=singular,
        directions=directions.T,
        scatter=scatter,
        known=known,
    )
