# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits parameters of a law to measured curves by least squares, and judges how well the data
determine each of them.

Residuals: r = (model - measured)/deviation, or ln(model/measured)/deviation for relative data.
Positive parameters are fitted in their logarithm, others in value/scale: z.
Uncertainties come from the Jacobian J of the residuals by z at the solution: covariance =
s² (JᵀJ)⁻¹. If the deviation of the data is unknown, s² = sum r²/(data - parameters).
With known deviations s is that ratio too (Birge's) where it is above 1: the law misses the data by
more than their deviations. The covariance is linear: it is valid near the solution, for small errors.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from ..arrays import Floats
from ..errors import ResultsError
from .statistics import rms

MOST_EVALUATIONS = 400  # of the residuals, those of slopes apart
STEP = 1e-4  # of z for slopes
# A direction with a singular value below this part of the largest is within the noise of the slopes
LEAST_SINGULAR = 1e-5
# A parameter known no better than this (of ln, or of its scale) is not determined: a factor of e
LARGEST_DEVIATION = 1.0
PARTNER = 0.1  # least part of a parameter in a direction that is reported

# Values of the parameters -> each curve at its points. @raises NotComputed
Model = Callable[[Floats], Sequence[Floats]]


class NotComputed(ResultsError):
    """The law does not exist for these parameters, or cannot follow the path of a curve."""


@dataclass(frozen=True)
class Parameter:
    """A number of a material; bounds may be infinite."""

    name: str
    unit: str
    start: float
    lower: float
    upper: float

    @property
    def logarithmic(self) -> bool:
        return self.lower >= 0 and self.start > 0

    @property
    def bounded(self) -> bool:
        """On both sides, in z."""
        return math.isfinite(self.low) and math.isfinite(self.high)

    @property
    def scale(self) -> float:
        """Of z = value/scale."""
        interval = self.upper - self.lower
        return interval if math.isfinite(interval) else abs(self.start)

    @cached_property
    def low(self) -> float:
        return self._z(self.lower)

    @cached_property
    def high(self) -> float:
        return self._z(self.upper)

    @property
    def first(self) -> float:
        """z of the start, at a bound a thousandth inside."""
        margin = 1e-3 * (self.high - self.low if self.bounded else 1.0)
        return min(max(self._z(self.start), self.low + margin), self.high - margin)

    def _z(self, value: float) -> float:
        if not self.logarithmic:
            return value / self.scale
        return math.log(value) if value > 0 else -math.inf

    def value(self, z: float) -> float:
        """Rounding does not leave the range."""
        value = math.exp(z) if self.logarithmic else z * self.scale
        return min(max(value, self.lower), self.upper)

    def bound_met(self, z: float) -> str:
        """ "stands at its upper bound 0.04", or empty"""
        margin = 2e-3 * (self.high - self.low) if self.bounded else 0.0
        if z - self.low <= margin:
            return f"stands at its lower bound {self.lower:.10g}"
        if self.high - z <= margin:
            return f"stands at its upper bound {self.upper:.10g}"
        return ""


@dataclass(frozen=True)
class Curve:
    """A measured curve; measured is NaN where there is none."""

    name: str
    path: str  # its type
    driven_by: str  # with its unit, as compared
    driven: Floats
    channel: str
    compared: str
    measured: Floats
    relative: bool  # compare logarithms
    deviation: float  # of a value, of its logarithm where relative; 0: unknown, the same for all


@dataclass(frozen=True)
class Fitted:
    """One parameter after the fit."""

    parameter: Parameter
    value: float
    deviation: float  # standard deviation, linearised; infinite where not determined, NaN: unknown
    determined: bool
    remark: str  # why it is not determined, or that it stands at a bound


@dataclass(frozen=True)
class LawFit:
    parameters: tuple[Fitted, ...]
    start: tuple[Floats, ...]  # the curves at their points
    fitted: tuple[Floats, ...]
    data: int
    rms_start: float
    rms: float  # of the residuals
    scatter: float  # s
    known: bool  # the deviations of all curves
    correlation: Floats  # of the determined part
    singular_values: Floats  # of J, largest first
    directions: Floats  # column k: direction of singular value k in z
    evaluations: int
    end: str  # why the iteration ended
    converged: bool

    @property
    def values(self) -> Floats:
        return np.array([parameter.value for parameter in self.parameters])


class _Residuals:
    """Residuals of all curves as a function of z."""

    def __init__(self, parameters: Sequence[Parameter], curves: Sequence[Curve], model: Model):
        self.parameters, self.curves, self.model = parameters, curves, model
        self.evaluations = 0
        self.low = np.array([parameter.low for parameter in parameters])
        self.high = np.array([parameter.high for parameter in parameters])

    def values(self, z: Floats) -> Floats:
        return np.array([p.value(one) for p, one in zip(self.parameters, z)])

    def curves_at(self, z: Floats) -> tuple[Floats, ...]:
        """@raises NotComputed"""
        self.evaluations += 1
        return tuple(self.model(self.values(z)))

    def of(self, curves: Sequence[Floats]) -> Floats:
        """@raises NotComputed for a value that is not finite, or has no logarithm"""
        parts = []
        for curve, computed in zip(self.curves, curves):
            known = np.isfinite(curve.measured)
            model, measured = computed[known], curve.measured[known]
            if not np.all(np.isfinite(model)):
                raise NotComputed(f"curve {curve.name}: {curve.channel} is not finite")
            if curve.relative and np.any(model <= 0):
                raise NotComputed(
                    f"curve {curve.name}: {curve.channel} is {model.min():g} and is compared in "
                    "logarithms; use scale: linear"
                )
            difference = np.log(model / measured) if curve.relative else model - measured
            parts.append(difference / (curve.deviation or 1.0))
        return np.concatenate(parts)

    def at(self, z: Floats) -> Floats:
        """@raises NotComputed"""
        return self.of(self.curves_at(z))

    def slope(self, z: Floats) -> Floats:
        """By central differences, one-sided at a bound or where one side cannot be computed.

        @raises ResultsError where a parameter can go neither way
        """
        columns = []
        for j in range(len(z)):
            ends = []
            for step in (-STEP, STEP):
                moved = z.copy()
                moved[j] = min(max(z[j] + step, self.low[j]), self.high[j])
                try:
                    ends.append((moved[j], self.at(moved)))
                except NotComputed:
                    ends.append((z[j], self.at(z)))
            (behind, low), (ahead, high) = ends
            if ahead == behind:
                raise ResultsError(
                    "fit: the curves cannot be computed on either side of "
                    f"{self.parameters[j].name} = {self.parameters[j].value(z[j]):g}; narrow its bounds"
                )
            columns.append((high - low) / (ahead - behind))
        return np.array(columns).T


def fit_law(parameters: Sequence[Parameter], curves: Sequence[Curve], model: Model) -> LawFit:
    """@raises ResultsError where the curves cannot be computed at the start or around the solution"""
    residuals = _Residuals(parameters, curves, model)
    first = np.array([parameter.first for parameter in parameters])
    start = residuals.curves_at(first)
    at_start = residuals.of(start)

    def residuals_or_none(z: Floats) -> Floats:
        """NaN where they cannot be computed: SciPy then shortens its step."""
        try:
            return residuals.at(z)
        except NotComputed:
            return np.full(len(at_start), np.nan)

    # The curves themselves are known to the paths' tolerance, 1e-10 unless changed
    found = least_squares(
        residuals_or_none,
        first,
        jac=residuals.slope,
        bounds=(residuals.low, residuals.high),
        x_scale="jac",
        ftol=1e-12,
        xtol=1e-9,
        gtol=None,
        max_nfev=MOST_EVALUATIONS,
    )
    z = found.x
    ends = {
        0: f"{MOST_EVALUATIONS} evaluations were not enough",
        2: "the sum of squares no longer falls",
    }
    fitted = residuals.curves_at(z)
    at_end = residuals.of(fitted)
    judged = _judge(residuals, z, at_end, found.jac)
    return LawFit(
        start=start,
        fitted=fitted,
        data=len(at_end),
        rms_start=rms(at_start),
        rms=rms(at_end),
        evaluations=residuals.evaluations,
        end=ends.get(found.status, "the parameters no longer change"),
        converged=found.status > 0,
        **judged,
    )


def _judge(residuals: _Residuals, z: Floats, at_end: Floats, slope: Floats) -> dict[str, Any]:
    """Uncertainties at the solution, and what the data leave open: members of LawFit."""
    _, singular, directions = np.linalg.svd(slope, full_matrices=False)
    names = [parameter.name for parameter in residuals.parameters]
    spare = len(at_end) - len(z)
    known = all(curve.deviation > 0 for curve in residuals.curves)
    birge = math.sqrt(float(at_end @ at_end) / spare) if spare > 0 else 1.0
    scatter = max(1.0, birge) if known else birge

    covariance = np.zeros((len(z), len(z)))
    left_open: dict[int, str] = {}  # parameter -> why it is not determined
    for value, direction in zip(singular, directions):
        if singular[0] > 0 and value > LEAST_SINGULAR * singular[0]:
            covariance += np.outer(direction, direction) * (scatter / value) ** 2
            continue
        partners = np.flatnonzero(np.abs(direction) > PARTNER)
        combined = ", ".join(names[i] for i in partners)
        why = f"the curves depend only on a combination of {combined}"
        if len(partners) == 1:
            why = "the curves do not depend on it"
        left_open.update(dict.fromkeys(partners.tolist(), why))
    deviations = np.sqrt(np.diag(covariance))
    product = np.outer(deviations, deviations)
    correlation = np.divide(covariance, product, out=np.zeros_like(product), where=product > 0)
    np.fill_diagonal(correlation, 1.0)

    def fitted(i: int) -> Fitted:
        parameter = residuals.parameters[i]
        deviation = math.inf if i in left_open else float(deviations[i])
        value = parameter.value(z[i])
        remark, determined = left_open.get(i, ""), i not in left_open
        if determined and deviation > LARGEST_DEVIATION:
            determined = False
            remark = (
                "known to no better than a factor of e"
                if parameter.logarithmic
                else "known no better than its range or size"
            )
        elif determined and spare == 0 and not known:
            deviation = math.nan
            remark = (
                "as many data as parameters: no scatter to judge by, unless the deviation of the "
                "data is given"
            )
        if bound := parameter.bound_met(z[i]):
            remark, determined = bound, False
        in_units = deviation * (value if parameter.logarithmic else parameter.scale)
        return Fitted(parameter, value, in_units, determined, remark)

    return {
        "parameters": tuple(fitted(i) for i in range(len(z))),
        "scatter": scatter,
        "known": known,
        "correlation": correlation,
        "singular_values": singular,
        "directions": directions.T,
    }
