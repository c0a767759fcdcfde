# SPDX-License-Identifier: GPL-2.0-or-later
"""Result of an empirical formula, and the range in which its tests support it."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import ResultsError
from ..formatting import with_error


class OutOfRange(ResultsError):
    """A formula was asked for something its tests do not cover."""


@dataclass(frozen=True)
class Limit:
    """A quantity that must lie in [low, high], with the reason."""

    name: str
    value: float
    low: float
    high: float
    unit: str
    why: str

    @property
    def met(self) -> bool:
        slack = 1e-9 * max(abs(self.low), abs(self.high) if np.isfinite(self.high) else 0.0)
        return self.low - slack <= self.value <= self.high + slack

    def text(self) -> str:
        if not np.isfinite(self.high):
            allowed = f"at least {self.low:g}"
        elif not np.isfinite(self.low):
            allowed = f"at most {self.high:g}"
        else:
            allowed = f"{self.low:g} to {self.high:g}"
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.name} {self.value:.4g}{unit}, allowed {allowed} ({self.why})"


@dataclass(frozen=True)
class PredictedValue:
    """A further result of a formula."""

    name: str
    value: float
    unit: str


@dataclass(frozen=True)
class Prediction:
    """Result of a formula. Scatter: standard deviation of measurements about it, NaN: not known."""

    method: str
    source: str
    sinkage: float  # [m]
    resistance: float  # motion resistance [N]
    load: float  # [N]
    sinkage_scatter: float = math.nan
    coefficient_scatter: float = math.nan
    outside: tuple[str, ...] = ()  # the limits that are not met, in words
    extra: tuple[PredictedValue, ...] = ()

    def __post_init__(self) -> None:
        values = (self.sinkage, self.resistance, self.load, *(r.value for r in self.extra))
        if not np.isfinite(values).all():
            raise ResultsError(f"{self.method}: gives no finite number for these values; check their units (SI)")

    @property
    def coefficient(self) -> float:
        return self.resistance / self.load

    def report(self) -> str:
        """Lines of the printed report."""
        sinkage = f"{1e3 * self.sinkage:.1f} mm"
        if self.sinkage_scatter > 0:
            sinkage += f"  (scatter of tests {1e3 * self.sinkage_scatter:.0f} mm)"
        coefficient = f"{self.coefficient:.4f}"
        if self.coefficient_scatter > 0:
            coefficient = f"{with_error(self.coefficient, self.coefficient_scatter)}  (scatter of tests)"
        rows = [
            ("sinkage", sinkage),
            ("motion resistance", f"{self.resistance:.4g} N"),
            ("resistance coefficient", coefficient),
            *((r.name, f"{r.value:.4g} {r.unit}") for r in self.extra),
        ]
        return report_of(self.method, self.source, rows, 22, [f"EXTRAPOLATED: {limit}" for limit in self.outside])


def report_of(
    title: str, source: str, rows: Iterable[tuple[str, str]], wide: int, notes: Iterable[str] = ()
) -> str:
    """Lines of a report: title with source, names and values in columns, notes."""
    lines = [*(f"{name:{wide}} {value}" for name, value in rows), *notes]
    return "\n".join([f"{title}  ({source})", *(f"  {line}" for line in lines)])


def require_range(method: str, limits: Sequence[Limit], extrapolate: bool) -> tuple[str, ...]:
    """Limits that are not met, in words. @raises OutOfRange for any, unless told to extrapolate"""
    outside = tuple(limit.text() for limit in limits if not limit.met)
    if outside and not extrapolate:
        remedy = "--extrapolate uses it all the same, and says so"
        raise OutOfRange(f"{method} is not valid here: {'; '.join(outside)}; {remedy}")
    return outside


# Load over diameter and width [Pa], by a wide margin: microrovers on the Moon have 100 Pa, lorries 1e5
WHEEL_PRESSURES = (20.0, 5e5)


def require_wheel(method: str, load: float, diameter: float, width: float) -> None:
    """@raises ResultsError for what no wheel has, such as a load in kN or a width in mm"""
    require_positive(method, load=load, diameter=diameter, width=width)
    pressure, (low, high) = load / (diameter * width), WHEEL_PRESSURES
    if not low <= pressure <= high:
        raise ResultsError(
            f"{method}: {load:g} N on a wheel of {diameter:g} m x {width:g} m are {pressure:.3g} Pa over "
            f"diameter and width; allowed: {low:g} to {high:g} Pa. Give N and m"
        )


def require_positive(method: str, **values: float) -> None:
    """@raises ResultsError naming the first that is not a finite number above 0"""
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise ResultsError(f"{method}: {name} is {value:g}, a finite number above 0 is needed")
