# SPDX-License-Identifier: GPL-2.0-or-later
"""Empirical formulas of mobility to lay beside computed runs, with source and range of validity.

Nothing is extrapolated unless asked: outside of the range a formula raises OutOfRange, which names
every value that is outside. SI units; angles in degrees in the interface.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..csv_table import read_rows
from ..errors import ResultsError
from ..formatting import with_error


class OutOfRange(ResultsError):
    """A formula was asked for something its tests do not cover."""


@dataclass(frozen=True)
class Limit:
    """A quantity that must lie in [low, high], and who says so."""

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
class Result:
    """A further result of a formula."""

    name: str
    value: float
    unit: str


@dataclass(frozen=True)
class Prediction:
    """What a formula says. Scatter: standard deviation of measurements about it, NaN: not known."""

    method: str
    source: str
    sinkage: float  # [m]
    resistance: float  # motion resistance [N]
    load: float  # [N]
    sinkage_scatter: float = math.nan
    coefficient_scatter: float = math.nan
    outside: tuple[str, ...] = ()  # the limits that are not met, in words
    extra: tuple[Result, ...] = ()

    def __post_init__(self) -> None:
        values = (self.sinkage, self.resistance, self.load, *(r.value for r in self.extra))
        if not np.isfinite(values).all():
            raise ResultsError(
                f"{self.method}: gives no finite number for these values; check their units (SI)"
            )

    @property
    def coefficient(self) -> float:
        return self.resistance / self.load

    def report(self) -> str:
        """Lines for a person."""
        known = self.coefficient_scatter > 0
        sinkage = f"{1e3 * self.sinkage:.1f} mm"
        if self.sinkage_scatter > 0:
            sinkage += f"  (scatter of tests {1e3 * self.sinkage_scatter:.0f} mm)"
        coefficient = f"{self.coefficient:.4f}"
        if known:
            coefficient = with_error(self.coefficient, self.coefficient_scatter)
            coefficient += "  (scatter of tests)"
        return "\n".join(
            [
                f"{self.method}  ({self.source})",
                f"  sinkage                {sinkage}",
                f"  motion resistance      {self.resistance:.4g} N",
                f"  resistance coefficient {coefficient}",
                *(f"  {r.name:22} {r.value:.4g} {r.unit}" for r in self.extra),
                *(f"  EXTRAPOLATED: {limit}" for limit in self.outside),
            ]
        )


def _outside(method: str, limits: Sequence[Limit], extrapolate: bool) -> tuple[str, ...]:
    """Limits that are not met, in words. @raises OutOfRange for any, unless told to extrapolate"""
    outside = tuple(limit.text() for limit in limits if not limit.met)
    if outside and not extrapolate:
        raise OutOfRange(
            f"{method} is not valid here: {'; '.join(outside)}; --extrapolate uses it all the "
            "same, and says so"
        )
    return outside


def _require_positive(method: str, **values: float) -> None:
    """@raises ResultsError naming the first that is not a finite number above 0"""
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise ResultsError(f"{method}: {name} is {value:g}, a finite number above 0 is needed")


# --- snow -----------------------------------------------------------------------------------------

NRMM_SOURCE = (
    "NRMM shallow snow, P. W. Richmond et al.; S. A. Shoop, ERDC/CRREL TR-01-16 (2001), eq 29-33"
)
# The tests that [Shoop2001] holds against the formula (Table 11), which gives no other range.
# Radius: 10 % to both sides of its only wheel.
NRMM_TESTS = "tests of Shoop (2001), Table 11"
NRMM_DENSITY = (105.0, 225.0)  # [kg/m3] rows of 110 to 220, which are rounded to 10
NRMM_DEPTH = (0.13, 0.38)  # [m]
NRMM_RADIUS = (0.342, 0.418)  # [m]
DENSEST = 0.917  # ice: largest final density [Mg/m3]
# rms of the formula against the rows of Table 11 in inputs/validation/snow_wheel/reference.csv:
# coefficient from the measured sinkage, sinkage [m] at 179 kPa; held by empirical_test.py
NRMM_COEFFICIENT_RMS, NRMM_SINKAGE_RMS = 0.031, 0.0126


def nrmm_final_density(pressure: float) -> float:
    """Density [kg/m3] under the largest contact pressure [Pa]: 0.519 + 0.0023 p, at most ice.

    Eq 31, in Mg/m3 and kPa.
    """
    return 1e3 * min(0.519 + 0.0023 * pressure / 1e3, DENSEST)


def nrmm_sinkage(depth: float, density: float, pressure: float) -> float:
    """z = h (1 - rho0/rho_f) [m]. depth [m], density [kg/m3], pressure [Pa]"""
    return depth * (1 - density / nrmm_final_density(pressure))


def nrmm_resistance(density: float, width: float, radius: float, sinkage: float) -> float:
    """Motion resistance [N] of one wheel: 13.6041 (rho0 w a)^1.26, the arc a = r acos((r - z)/r).

    density [kg/m3], width, radius, sinkage [m]. Deep snow denser than 150 kg/m3: x 1.5 beyond
    z = 2r/3, x 2.5 beyond z = r.
    """
    arc = radius * np.arccos(max((radius - sinkage) / radius, -1.0))
    resistance = 13.6041 * (density * width * arc) ** 1.26
    if density > 150:
        resistance *= 2.5 if sinkage > radius else 1.5 if sinkage > 2 * radius / 3 else 1.0
    return float(resistance)


def nrmm(
    load: float,
    radius: float,
    width: float,
    depth: float,
    density: float,
    pressure: float,
    sinkage: float | None = None,
    extrapolate: bool = False,
) -> Prediction:
    """Sinkage (unless a measured one is given) and resistance of a wheel in shallow snow.

    load [N], radius, width, depth, sinkage [m], density [kg/m3], pressure [Pa] the largest contact
    pressure. @raises OutOfRange
    """
    sizes = {"load": load, "radius": radius, "width": width, "depth": depth}
    _require_positive("NRMM", **sizes, density=density, pressure=pressure)
    if sinkage is not None and not 0.0 <= sinkage < depth:
        raise ResultsError(
            f"NRMM: a sinkage of {sinkage:g} m in snow {depth:g} m deep; allowed: from 0 to below "
            "the depth"
        )
    z = nrmm_sinkage(depth, density, pressure) if sinkage is None else sinkage
    final = nrmm_final_density(pressure)
    why = f"within 10 % of the wheel of {NRMM_TESTS}"
    outside = _outside(
        "NRMM",
        [
            Limit("density", density, *NRMM_DENSITY, "kg/m3", NRMM_TESTS),
            Limit("depth", depth, *NRMM_DEPTH, "m", NRMM_TESTS),
            Limit("wheel radius", radius, *NRMM_RADIUS, "m", why),
            Limit("sinkage", z, -math.inf, depth, "m", "the snow is not deeper"),
            Limit(
                "final over initial density",
                final / density,
                1.0,
                math.inf,
                "",
                "snow does not swell",
            ),
        ],
        extrapolate,
    )
    return Prediction(
        "NRMM",
        NRMM_SOURCE,
        z,
        nrmm_resistance(density, width, radius, z),
        load,
        NRMM_SINKAGE_RMS,
        NRMM_COEFFICIENT_RMS,
        outside,
        (Result("final density", final, "kg/m3"),),
    )


# --- sand -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class TerrainValues:
    """One row of terrains.csv, whose head says what the columns are; NaN: not in the source."""

    name: str
    kind: str
    pressure: str  # whose pressure-sinkage law: "bekker" or "reece"
    k_1: float
    k_2: float
    n: float
    c: float  # cohesion [Pa]
    phi: float  # friction angle [degrees]
    K: float  # shear displacement [m]
    c1: float
    c2: float

    def modulus(self, width: float) -> float:
        """k of p = k z^n [Pa/m^n] under a contact of this width [m]."""
        if self.pressure == "bekker":
            return self.k_1 / width + self.k_2
        return float((self.k_1 + self.k_2 * width) / width**self.n)

    def plate_pressure(self, sinkage: Floats, width: float) -> Floats:
        """Mean pressure [Pa] under a plate at this sinkage [m]."""
        pressure: Floats = self.modulus(width) * np.asarray(sinkage) ** self.n
        return pressure


def terrains() -> dict[str, TerrainValues]:
    """Name -> values, from terrains.csv."""
    numeric = ("k_1", "k_2", "n", "c", "phi", "K", "c1", "c2")
    return {
        row["name"]: TerrainValues(
            row["name"],
            row["kind"],
            row["pressure"],
            *(float(row[key]) if row[key] else math.nan for key in numeric),
        )
        for row in read_rows(Path(__file__).with_name("terrains.csv"))
    }


def terrain(name: str) -> TerrainValues:
    """@raises ResultsError for an unknown name"""
    known = terrains()
    if name not in known:
        raise ResultsError(f"there is no terrain '{name}'; there are: {', '.join(known)}")
    return known[name]


BEKKER_SOURCE = (
    "M. G. Bekker (1956, 1969); J. Y. Wong, Theory of Ground Vehicles (2008), eq 2.42-2.46"
)


def bekker(
    load: float, diameter: float, width: float, ground: TerrainValues, extrapolate: bool = False
) -> Prediction:
    """Sinkage and compaction resistance of a towed rigid wheel.

    z = (3 W/((3 - n) b k sqrt(D)))^(2/(2n+1)), R = b k z^(n+1)/(n+1). load [N], diameter and width
    [m]. @raises OutOfRange
    """
    _require_positive("Bekker's wheel", load=load, diameter=diameter, width=width)
    k, n = ground.modulus(width), ground.n
    z = (3 * load / ((3 - n) * width * k * np.sqrt(diameter))) ** (2 / (2 * n + 1))
    series = "Wong: for n up to 1.3, the series of the load integral is cut after two terms"
    outside = _outside(
        "Bekker's wheel",
        [
            Limit("diameter", diameter, 0.5, math.inf, "m", "Wong: poor for wheels below 50 cm"),
            Limit("n", n, 0.0, 1.3, "", series),
            Limit(
                "sinkage over diameter", z / diameter, 0.0, 1 / 6, "", "Wong: for moderate sinkage"
            ),
        ],
        extrapolate,
    )
    resistance = width * k * z ** (n + 1) / (n + 1)
    return Prediction("Bekker", BEKKER_SOURCE, float(z), float(resistance), load, outside=outside)


WONG_REECE_SOURCE = "J.-Y. Wong and A. R. Reece, J. Terramechanics 4(1), 81-98 (1967), Part I"
GAUSS = np.polynomial.legendre.leggauss(96)  # type: ignore[no-untyped-call]


def _wong_reece_sums(
    theta_1: float, slip: float, radius: float, width: float, ground: TerrainValues
) -> Floats:
    """(3) Vertical force, drawbar pull [N], torque [N m] at an entry angle [rad]; exit angle 0."""
    k, n = ground.modulus(width) * radius**ground.n, ground.n
    theta_m = (ground.c1 + ground.c2 * slip) * theta_1
    if not 0 < theta_m < theta_1:
        raise ResultsError(
            f"Wong-Reece: the largest stress would lie at {np.degrees(theta_m):.1f} of "
            f"{np.degrees(theta_1):.1f} degrees"
        )
    x, w = GAUSS
    totals = np.zeros(3)
    for low, high in ((0.0, theta_m), (theta_m, theta_1)):
        theta = 0.5 * (high - low) * x + 0.5 * (high + low)
        weight = 0.5 * (high - low) * w
        mirrored = theta if low > 0 else theta_1 - theta / theta_m * (theta_1 - theta_m)
        sigma = k * np.maximum(np.cos(mirrored) - np.cos(theta_1), 0.0) ** n
        j = radius * (theta_1 - theta - (1 - slip) * (np.sin(theta_1) - np.sin(theta)))
        tau = (ground.c + sigma * np.tan(np.radians(ground.phi))) * (1 - np.exp(-j / ground.K))
        totals += [
            np.sum(weight * (sigma * np.cos(theta) + tau * np.sin(theta))),
            np.sum(weight * (tau * np.cos(theta) - sigma * np.sin(theta))),
            radius * np.sum(weight * tau),
        ]
    sums: Floats = totals * radius * width
    return sums


def wong_reece(
    load: float,
    diameter: float,
    width: float,
    slip: float,
    ground: TerrainValues,
    extrapolate: bool = False,
) -> Prediction:
    """Driven rigid wheel: sinkage, external drawbar pull and torque at a slip 1 - v/(r omega).

    load [N], diameter and width [m], slip from 0 (the towed wheel of Part II has other stresses and
    is not here). The resistance is minus the drawbar pull. @raises OutOfRange; ResultsError where
    terrains.csv has no K, c1 or c2 for this ground
    """
    _require_positive("Wong-Reece", load=load, diameter=diameter, width=width)
    lacking = [name for name in ("K", "c1", "c2") if not np.isfinite(getattr(ground, name))]
    if lacking:
        complete = [t.name for t in terrains().values() if np.isfinite([t.K, t.c1, t.c2]).all()]
        raise ResultsError(
            f"Wong-Reece: {', '.join(lacking)} of '{ground.name}' are not known; a terrain that "
            f"has them: {', '.join(complete)}"
        )
    radius = 0.5 * diameter
    if not 0 <= slip < 1:
        raise OutOfRange(
            f"Wong-Reece is for driven wheels, slip from 0 to 1, not {slip:g}; no extrapolation "
            "changes that"
        )
    low, high = np.radians(0.5), np.radians(89.0)
    if _wong_reece_sums(high, slip, radius, width, ground)[0] < load:
        raise ResultsError(
            f"Wong-Reece: '{ground.name}' does not carry {load:g} N: the wheel would sink to its "
            "axle"
        )
    for _ in range(60):
        middle = 0.5 * (low + high)
        carried = _wong_reece_sums(middle, slip, radius, width, ground)[0]
        low, high = (middle, high) if carried < load else (low, middle)
    entry = 0.5 * (low + high)
    _, pull, torque = (float(s) for s in _wong_reece_sums(entry, slip, radius, width, ground))
    z = float(radius * (1 - np.cos(entry)))
    outside = _outside(
        "Wong-Reece",
        [
            Limit("slip", slip, 0.0, 0.8, "", "the wheels of the paper"),
            Limit(
                "diameter",
                diameter,
                0.5,
                math.inf,
                "m",
                "the paper's wheel of 1.25 m; below 0.5 m not shown",
            ),
            Limit("sinkage over diameter", z / diameter, 0.0, 0.26, "", "the paper's loose sand"),
        ],
        extrapolate,
    )
    extra = (
        Result("torque", torque, "N m"),
        Result("drawbar pull", pull, "N"),
        Result("entry angle", float(np.degrees(entry)), "deg"),
        Result("slip", slip, ""),
    )
    return Prediction("Wong-Reece", WONG_REECE_SOURCE, z, -pull, load, outside=outside, extra=extra)
