# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits parameters of a law to measured curves."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from .fitter import Fit, Fitted, NotComputed, Parameter, fit
from ..uncertainty.statistics import rms

# Values of the parameters -> each curve at its points. @raises NotComputed
Model = Callable[[Floats], Sequence[Floats]]


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
class LawFit:
    """A fit with its curves at their points."""

    fit: Fit
    start: tuple[Floats, ...]
    fitted: tuple[Floats, ...]

    @property
    def parameters(self) -> tuple[Fitted, ...]:
        return self.fit.parameters

    @property
    def values(self) -> Floats:
        return self.fit.values

    @property
    def data(self) -> int:
        return len(self.fit.residuals)

    @property
    def rms_start(self) -> float:
        return rms(self.fit.start)


def residuals_of(curves: Sequence[Curve], computed: Sequence[Floats]) -> Floats:
    """@raises NotComputed for a value that is not finite, or has no logarithm"""
    parts = []
    for curve, values in zip(curves, computed):
        known = np.isfinite(curve.measured)
        model, measured = values[known], curve.measured[known]
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


def fit_law(parameters: Sequence[Parameter], curves: Sequence[Curve], model: Model) -> LawFit:
    """@raises ResultsError where the curves cannot be computed at the start or around the solution"""
    known = all(curve.deviation > 0 for curve in curves)
    # The curves themselves are known to the paths' tolerance, 1e-10 unless changed
    found = fit(parameters, lambda values: residuals_of(curves, model(values)), known=known)
    first = np.array([parameter.value(parameter.first) for parameter in parameters])
    return LawFit(found, tuple(model(first)), tuple(model(found.values)))
