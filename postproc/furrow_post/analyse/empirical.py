# SPDX-License-Identifier: GPL-2.0-or-later
"""Empirical formulas of mobility to lay beside computed runs, each with its source and range of validity.

Nothing is extrapolated unless asked: outside of the range a formula raises OutOfRange, which names every value that is outside.
SI units; angles in degrees in the interface.
"""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .results import ResultsError

GRAVITY = 9.80665


class OutOfRange(ResultsError):
    """A formula was asked for something its tests do not cover."""


@dataclass
class Limit:
    """A quantity that must lie in [low, high], and who says so."""

    name: str
    value: float
    low: float
    high: float
    unit: str
    why: str

    @property
    def met(self):
        slack = 1e-9 * max(abs(self.low), abs(self.high) if np.isfinite(self.high) else 0.0)
        return self.low - slack <= self.value <= self.high + slack

    def text(self):
        allowed = f"at least {self.low:g}" if not np.isfinite(self.high) else \
            f"at most {self.high:g}" if not np.isfinite(self.low) else f"{self.low:g} to {self.high:g}"
        return f"{self.name} {self.value:.4g}{' ' + self.unit if self.unit else ''}, allowed {allowed} ({self.why})"


@dataclass
class Prediction:
    """What a formula says. scatter: standard deviation of measurements about it, NaN where none is known."""

    method: str
    source: str
    sinkage: float                       # m
    resistance: float                    # N, motion resistance
    load: float                          # N
    sinkage_scatter: float = float("nan")
    coefficient_scatter: float = float("nan")
    outside: tuple = ()                  # texts of the limits that are not met
    extra: tuple = ()                    # (name, value, unit) of further results

    @property
    def coefficient(self):
        return self.resistance / self.load


def _check(method, limits, extrapolate):
    outside = tuple(limit.text() for limit in limits if not limit.met)
    if outside and not extrapolate:
        raise OutOfRange(f"{method} is not valid here: " + "; ".join(outside) + "; --extrapolate uses it all the same, and says so")
    return outside


# --- snow ---------------------------------------------------------------------------------------------------------------------------

NRMM_SOURCE = "NRMM shallow snow, P. W. Richmond et al.; S. A. Shoop, ERDC/CRREL TR-01-16 (2001), eq 29-33"
# The tests that TR holds against the formula (Table 11); TR gives no other range. Radius: 10 % to both sides of its only wheel.
NRMM_TESTS = "tests of TR Table 11"
NRMM_DENSITY, NRMM_DEPTH, NRMM_RADIUS = (110.0, 220.0), (0.13, 0.38), (0.342, 0.418)
DENSEST = 0.917        # Mg/m3, ice: cap of the final density
# rms of the formula against the rows of Table 11 in inputs/validation/snow_wheel/reference.csv: coefficient from measured sinkage,
# sinkage [m] at 179 kPa; held by tests/unit/postproc/empirical_test.py
NRMM_COEFFICIENT_RMS, NRMM_SINKAGE_RMS = 0.031, 0.0126


def nrmm_final_density(pressure):
    """Density [kg/m3] under the largest contact pressure [Pa]: 0.519 + 0.0023 p (Mg/m3, kPa), at most ice (eq 33)."""
    return 1e3 * min(0.519 + 0.0023 * pressure / 1e3, DENSEST)


def nrmm_sinkage(depth, density, pressure):
    """z = h (1 - rho0/rho_f) [m]."""
    return depth * (1 - density / nrmm_final_density(pressure))


def nrmm_resistance(density, width, radius, sinkage):
    """Motion resistance [N] of one wheel: 13.6041 (rho0 w a)^1.26 with the arc a = r acos((r - z)/r) [kg/m3, m];
    deep snow denser than 150 kg/m3: x 1.5 beyond z = 2r/3, x 2.5 beyond z = r."""
    arc = radius * np.arccos(max((radius - sinkage) / radius, -1.0))
    resistance = 13.6041 * (density * width * arc) ** 1.26
    if density > 150:
        resistance *= 2.5 if sinkage > radius else 1.5 if sinkage > 2 * radius / 3 else 1.0
    return resistance


def nrmm(load, radius, width, depth, density, pressure, sinkage=None, extrapolate=False):
    """Sinkage (unless a measured one is given) and resistance of a wheel in shallow snow.

    load [N], radius, width, depth, sinkage [m], density [kg/m3], pressure [Pa] the largest contact pressure. @raises OutOfRange
    """
    z = nrmm_sinkage(depth, density, pressure) if sinkage is None else sinkage
    outside = _check("NRMM", [
        Limit("density", density, *NRMM_DENSITY, "kg/m3", NRMM_TESTS), Limit("depth", depth, *NRMM_DEPTH, "m", NRMM_TESTS),
        Limit("wheel radius", radius, *NRMM_RADIUS, "m", "within 10 % of the wheel of " + NRMM_TESTS),
        Limit("final over initial density", nrmm_final_density(pressure) / density, 1.0, float("inf"), "", "snow does not swell"),
    ], extrapolate)
    return Prediction("NRMM", NRMM_SOURCE, z, nrmm_resistance(density, width, radius, z), load, NRMM_SINKAGE_RMS,
                      NRMM_COEFFICIENT_RMS, outside, (("final density", nrmm_final_density(pressure), "kg/m3"),))


# --- sand ---------------------------------------------------------------------------------------------------------------------------

@dataclass
class Terrain:
    """One row of terrains.csv; NaN where the source gives nothing."""

    name: str
    kind: str
    pressure: str
    k_1: float
    k_2: float
    n: float
    c: float
    phi: float
    K: float
    c1: float
    c2: float

    def modulus(self, width):
        """k of p = k z^n [Pa/m^n] under a contact of this width [m]."""
        if self.pressure == "bekker":
            return self.k_1 / width + self.k_2
        return (self.k_1 + self.k_2 * width) / width**self.n

    def plate_pressure(self, sinkage, width):
        """Mean pressure [Pa] under a plate at this sinkage [m]."""
        return self.modulus(width) * np.asarray(sinkage) ** self.n


def terrains():
    """name -> Terrain, from terrains.csv."""
    with open(Path(__file__).with_name("terrains.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    number = lambda text: float(text) if text else float("nan")
    return {row["name"]: Terrain(row["name"], row["kind"], row["pressure"],
                                 *(number(row[key]) for key in ("k_1", "k_2", "n", "c", "phi", "K", "c1", "c2"))) for row in rows}


def terrain(name):
    known = terrains()
    if name not in known:
        raise ResultsError(f"there is no terrain '{name}'; there are: {', '.join(known)}")
    return known[name]


BEKKER_SOURCE = "M. G. Bekker (1956, 1969); J. Y. Wong, Theory of Ground Vehicles (2008), eq 2.42-2.46"


def bekker(load, diameter, width, ground, extrapolate=False):
    """Sinkage z = (3 W/((3 - n) b k sqrt(D)))^(2/(2n+1)) and compaction resistance b k z^(n+1)/(n+1) of a towed rigid wheel.

    load [N], diameter and width [m], ground a Terrain. @raises OutOfRange
    """
    k, n = ground.modulus(width), ground.n
    z = (3 * load / ((3 - n) * width * k * np.sqrt(diameter))) ** (2 / (2 * n + 1))
    outside = _check("Bekker's wheel", [
        Limit("diameter", diameter, 0.5, float("inf"), "m", "Wong: poor for wheels below 50 cm"),
        Limit("n", n, 0.0, 1.3, "", "Wong: for n up to 1.3, the series of the load integral is cut after two terms"),
        Limit("sinkage over diameter", z / diameter, 0.0, 1 / 6, "", "Wong: for moderate sinkage"),
    ], extrapolate)
    return Prediction("Bekker", BEKKER_SOURCE, z, width * k * z ** (n + 1) / (n + 1), load, outside=outside)


WONG_REECE_SOURCE = "J.-Y. Wong and A. R. Reece, J. Terramechanics 4(1), 81-98 (1967), Part I"


GAUSS = np.polynomial.legendre.leggauss(96)


def _wong_reece_sums(theta_1, slip, radius, width, ground):
    """Vertical force, drawbar pull [N] and torque [N m] at an entry angle [rad]; exit angle 0."""
    k, n = ground.modulus(width) * radius**ground.n, ground.n
    theta_m = (ground.c1 + ground.c2 * slip) * theta_1
    if not 0 < theta_m < theta_1:
        raise ResultsError(f"Wong-Reece: the largest stress would lie at {np.degrees(theta_m):.1f} of {np.degrees(theta_1):.1f} degrees")
    x, w = GAUSS
    totals = np.zeros(3)
    for low, high in ((0.0, theta_m), (theta_m, theta_1)):
        theta = 0.5 * (high - low) * x + 0.5 * (high + low)
        weight = 0.5 * (high - low) * w
        mirrored = theta if low > 0 else theta_1 - theta / theta_m * (theta_1 - theta_m)
        sigma = k * np.maximum(np.cos(mirrored) - np.cos(theta_1), 0.0) ** n
        j = radius * (theta_1 - theta - (1 - slip) * (np.sin(theta_1) - np.sin(theta)))
        tau = (ground.c + sigma * np.tan(np.radians(ground.phi))) * (1 - np.exp(-j / ground.K))
        totals += [np.sum(weight * (sigma * np.cos(theta) + tau * np.sin(theta))),
                   np.sum(weight * (tau * np.cos(theta) - sigma * np.sin(theta))), radius * np.sum(weight * tau)]
    return totals * radius * width


def wong_reece(load, diameter, width, slip, ground, extrapolate=False):
    """Driven rigid wheel: sinkage, external drawbar pull and torque at a slip 1 - v/(r omega).

    load [N], diameter and width [m], slip from 0 (the towed wheel of Part II has other stresses and is not here). The resistance is
    minus the drawbar pull. @raises OutOfRange; ResultsError where terrains.csv has no K, c1 or c2 for this ground
    """
    lacking = [name for name in ("K", "c1", "c2") if not np.isfinite(getattr(ground, name))]
    if lacking:
        raise ResultsError(f"Wong-Reece: {', '.join(lacking)} of '{ground.name}' are not known; a terrain that has them: " +
                           ", ".join(t.name for t in terrains().values() if np.isfinite([t.K, t.c1, t.c2]).all()))
    radius = 0.5 * diameter
    if not 0 <= slip < 1:
        raise OutOfRange(f"Wong-Reece is for driven wheels, slip from 0 to 1, not {slip:g}; no extrapolation changes that")
    low, high = np.radians(0.5), np.radians(89.0)
    if _wong_reece_sums(high, slip, radius, width, ground)[0] < load:
        raise ResultsError(f"Wong-Reece: '{ground.name}' does not carry {load:g} N: the wheel would sink to its axle")
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _wong_reece_sums(middle, slip, radius, width, ground)[0] < load else (low, middle)
    entry = 0.5 * (low + high)
    _, pull, torque = _wong_reece_sums(entry, slip, radius, width, ground)
    z = radius * (1 - np.cos(entry))
    outside = _check("Wong-Reece", [
        Limit("slip", slip, 0.0, 0.8, "", "the wheels of the paper"),
        Limit("diameter", diameter, 0.5, float("inf"), "m", "the paper's wheel of 1.25 m; below 0.5 m not shown"),
        Limit("sinkage over diameter", z / diameter, 0.0, 0.26, "", "the paper's loose sand"),
    ], extrapolate)
    return Prediction("Wong-Reece", WONG_REECE_SOURCE, z, -pull, load, outside=outside,
                      extra=(("torque", torque, "N m"), ("drawbar pull", pull, "N"), ("entry angle", float(np.degrees(entry)), "deg"),
                             ("slip", slip, "")))


def text(prediction):
    """Lines for a person."""
    from .summary import with_error

    p = prediction
    deep = f"  (scatter of tests {1e3 * p.sinkage_scatter:.0f} mm)" if p.sinkage_scatter > 0 else ""
    known = p.coefficient_scatter > 0
    coefficient = with_error(p.coefficient, p.coefficient_scatter) + "  (scatter of tests)" if known else f"{p.coefficient:.4f}"
    lines = [f"{p.method}  ({p.source})",
             f"  sinkage                {1e3 * p.sinkage:.1f} mm{deep}",
             f"  motion resistance      {p.resistance:.4g} N",
             f"  resistance coefficient {coefficient}"]
    lines += [f"  {name:22} {value:.4g} {unit}" for name, value, unit in p.extra]
    lines += [f"  EXTRAPOLATED: {o}" for o in p.outside]
    return "\n".join(lines)
