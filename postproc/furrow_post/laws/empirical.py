# SPDX-License-Identifier: GPL-2.0-or-later
"""Empirical formulas of mobility, with source and range of validity: a wheel in shallow snow (NRMM),
gross traction on snow and ice, a rigid wheel on sand towed (Bekker) or driven (Wong and Reece); and their
predictions for the conditions of a run.

SI units; angles in degrees in the interface. Nothing is extrapolated unless asked: outside of its
range a formula raises OutOfRange, which names every value that is outside.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ..arrays import Floats
from ..errors import ResultsError
from ..read.soil_card import mobilised_share
from ..read.wheel_run import WheelRun
from .prediction import Limit, OutOfRange, PredictedValue, Prediction
from .prediction import report_of, require_positive, require_range, require_wheel
from .terrain_values import TerrainValues, terrain, terrains

# ---- snow

NRMM_SOURCE = "NRMM shallow snow, P. W. Richmond et al.; S. A. Shoop, ERDC/CRREL TR-01-16 (2001), eq 29-33"
# The tests that [Shoop2001] holds against the formula (Table 11), which gives no other range.
# Radius: 10 % to both sides of its only wheel.
NRMM_TESTS = "tests of Shoop (2001), Table 11"
NRMM_DENSITY = (105.0, 225.0)  # [kg/m3] rows of 110 to 220, which are rounded to 10
NRMM_DEPTH = (0.13, 0.38)  # [m]
NRMM_RADIUS = (0.342, 0.418)  # [m]
NRMM_PRESSURE = (5e3, 2e6)  # [Pa] of wheels on the ground
DENSEST = 0.917  # ice: largest final density [Mg/m3]
# rms of the formula against the rows of Table 11 in inputs/validation/snow_wheel/reference.csv:
# coefficient from the measured sinkage, sinkage [m] at 179 kPa; empirical_test.py holds it
NRMM_COEFFICIENT_RMS, NRMM_SINKAGE_RMS = 0.031, 0.0126


def nrmm_final_density(pressure: float) -> float:
    """Density [kg/m3] under the largest contact pressure [Pa]: 0.519 + 0.0023 p, at most ice.

    Eq 31, in Mg/m3 and kPa.
    """
    return 1e3 * min(0.519 + 0.0023 * pressure / 1e3, DENSEST)


def nrmm_sinkage(depth: float, density: float, pressure: float) -> float:
    """z = h (1 - rho0/rho_f) [m]. depth [m], density [kg/m3], pressure [Pa]"""
    return depth * (1 - density / nrmm_final_density(pressure))


def nrmm_resistance(density: float, width: float, radius: float, sinkage: float, depth: float | None = None) -> float:
    """Motion resistance [N] of one wheel: 13.6041 (rho0 w a)^1.26, the arc a = r acos((r - z)/r).

    density [kg/m3], width, radius, sinkage [m]. Deep snow denser than 150 kg/m3: x 1.5 beyond
    z = 2r/3, x 2.5 beyond z = r, as in eq 32 and 33. With the depth of the snow [m] these limits hold
    for the depth, as on pages 46 to 48 of the same report.
    """
    arc = radius * np.arccos(max((radius - sinkage) / radius, -1.0))
    resistance = 13.6041 * (density * width * arc) ** 1.26
    if density > 150:
        deep = sinkage if depth is None else depth
        resistance *= 2.5 if deep > radius else 1.5 if deep > 2 * radius / 3 else 1.0
    return float(resistance)


def require_pressure(pressure: float, method: str = "NRMM", remedy: str = "Give it in Pa, e.g. 179e3") -> None:
    """@raises ResultsError for a contact pressure that no wheel has, such as one in kPa"""
    low, high = NRMM_PRESSURE
    if not low <= pressure <= high:
        raise ResultsError(
            f"{method}: a contact pressure of {pressure:g} Pa; allowed: {low:g} to {high:g} Pa. {remedy}"
        )


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
    require_positive("NRMM", load=load, radius=radius, width=width, depth=depth, density=density, pressure=pressure)
    require_wheel("NRMM", load, 2 * radius, width)
    require_pressure(pressure)
    if sinkage is not None and not 0.0 <= sinkage < depth:
        fault = f"a sinkage of {sinkage:g} m in snow {depth:g} m deep"
        raise ResultsError(f"NRMM: {fault}; allowed: from 0 to below the depth")
    z = nrmm_sinkage(depth, density, pressure) if sinkage is None else sinkage
    final = nrmm_final_density(pressure)
    limits = [
        Limit("density", density, *NRMM_DENSITY, "kg/m3", NRMM_TESTS),
        Limit("depth", depth, *NRMM_DEPTH, "m", NRMM_TESTS),
        Limit("wheel radius", radius, *NRMM_RADIUS, "m", f"within 10 % of the wheel of {NRMM_TESTS}"),
        Limit("sinkage", z, -math.inf, depth, "m", "the snow is not deeper"),
        Limit("final over initial density", final / density, 1, math.inf, "", "snow does not swell"),
    ]
    outside = require_range("NRMM", limits, extrapolate)
    resistance, extra = nrmm_resistance(density, width, radius, z), (PredictedValue("final density", final, "kg/m3"),)
    return Prediction("NRMM", NRMM_SOURCE, z, resistance, load, NRMM_SINKAGE_RMS, NRMM_COEFFICIENT_RMS, outside, extra)


# T = a N^b: gross traction over contact area, of the mean contact pressure N, both in kPa. Table A5 of
# the report prints gross tractions, and empirical_test.py holds them: two on undisturbed snow, which
# fix a and b, and one each on packed snow and ice.
TRACTION_SOURCE = "P. W. Richmond, S. A. Shoop, G. L. Blaisdell, CRREL Report 95-1 (1995)"
TRACTION = {"undisturbed": (0.851, 0.823), "packed": (0.321, 0.97), "ice": (0.127, 1.06)}


@dataclass(frozen=True)
class SnowTraction:
    """Gross traction of a wheel or track at the slip where it is largest."""

    surface: str
    load: float  # [N]
    pressure: float  # load over contact area on hard ground [Pa]

    @property
    def coefficient(self) -> float:
        """Gross traction over load."""
        a, b = TRACTION[self.surface]
        return float(a * (self.pressure / 1e3) ** (b - 1))

    @property
    def gross(self) -> float:
        return self.coefficient * self.load

    def report(self) -> str:
        """Lines of the printed report."""
        rows = [
            ("contact pressure", f"{self.pressure / 1e3:.4g} kPa"),
            ("gross traction", f"{self.gross:.4g} N"),
            ("gross traction coefficient", f"{self.coefficient:.4f}"),
        ]
        note = "Subtract the motion resistance, for example of nrmm, for the net traction."
        return report_of(f"snow_traction, {self.surface}", TRACTION_SOURCE, rows, 26, [note])


def snow_traction(surface: str, load: float, contact_area: float) -> SnowTraction:
    """load [N], contact_area [m2] on hard ground. @raises ResultsError"""
    if surface not in TRACTION:
        raise ResultsError(f"there is no surface '{surface}'; there are {', '.join(TRACTION)}")
    require_positive("snow_traction", load=load, contact_area=contact_area)
    pressure = load / contact_area
    require_pressure(pressure, "snow_traction", "Give the load in N and the contact area in m2")
    return SnowTraction(surface, load, pressure)


# ---- sand and soil

BEKKER_SOURCE = "M. G. Bekker (1956, 1969); J. Y. Wong, Theory of Ground Vehicles (2008), eq 2.42-2.46"


def bekker(load: float, diameter: float, width: float, ground: TerrainValues, extrapolate: bool = False) -> Prediction:
    """Sinkage and compaction resistance of a towed rigid wheel.

    z = (3 W/((3 - n) b k sqrt(D)))^(2/(2n+1)), R = b k z^(n+1)/(n+1). load [N], diameter and width
    [m]. @raises OutOfRange
    """
    require_wheel("Bekker's wheel", load, diameter, width)
    k, n = ground.modulus(width), ground.n
    z = (3 * load / ((3 - n) * width * k * np.sqrt(diameter))) ** (2 / (2 * n + 1))
    series = "Wong: for n up to 1.3, the series of the load integral is cut after two terms"
    limits = [
        Limit("diameter", diameter, 0.5, math.inf, "m", "Wong: poor for wheels below 50 cm"),
        Limit("n", n, 0.0, 1.3, "", series),
        Limit("sinkage over diameter", z / diameter, 0, 1 / 6, "", "Wong: for moderate sinkage"),
        Limit("sinkage", z, 0, ground.deepest, "m", "the plates of the card"),
    ]
    outside = require_range("Bekker's wheel", limits, extrapolate)
    resistance = width * k * z ** (n + 1) / (n + 1)
    return Prediction("Bekker", BEKKER_SOURCE, float(z), float(resistance), load, outside=outside)


WONG_REECE_SOURCE = "J.-Y. Wong and A. R. Reece, J. Terramechanics 4(1), 81-98 (1967), Part I"
GAUSS = np.polynomial.legendre.leggauss(96)  # type: ignore[no-untyped-call]


def _wong_reece_sums(theta_1: float, slip: float, radius: float, width: float, ground: TerrainValues) -> Floats:
    """(3) Vertical force, drawbar pull [N], torque [N m] at an entry angle [rad]; exit angle 0."""
    k, n = ground.modulus(width) * radius**ground.n, ground.n
    theta_m = (ground.c1 + ground.c2 * slip) * theta_1
    if not 0 < theta_m < theta_1:
        angles = f"{np.degrees(theta_m):.1f} of {np.degrees(theta_1):.1f}"
        raise ResultsError(f"Wong-Reece: the largest stress would lie at {angles} degrees")
    x, w = GAUSS
    totals = np.zeros(3)
    for low, high in ((0.0, theta_m), (theta_m, theta_1)):
        theta = 0.5 * (high - low) * x + 0.5 * (high + low)
        weight = 0.5 * (high - low) * w
        mirrored = theta if low > 0 else theta_1 - theta / theta_m * (theta_1 - theta_m)
        sigma = k * np.maximum(np.cos(mirrored) - np.cos(theta_1), 0.0) ** n
        j = radius * (theta_1 - theta - (1 - slip) * (np.sin(theta_1) - np.sin(theta)))
        tau = (ground.c + sigma * np.tan(np.radians(ground.phi))) * mobilised_share(j, ground.K)
        totals += [
            np.sum(weight * (sigma * np.cos(theta) + tau * np.sin(theta))),
            np.sum(weight * (tau * np.cos(theta) - sigma * np.sin(theta))),
            radius * np.sum(weight * tau),
        ]
    sums: Floats = totals * radius * width
    return sums


def wong_reece(
    load: float, diameter: float, width: float, slip: float, ground: TerrainValues, extrapolate: bool = False
) -> Prediction:
    """Driven rigid wheel: sinkage, external drawbar pull and torque at a slip 1 - v/(r omega).

    load [N], diameter and width [m], slip from 0 (the towed wheel of Part II has other stresses and
    is not here). The resistance is minus the drawbar pull. @raises OutOfRange; ResultsError where
    terrains.csv has no K, c1 or c2 for this ground
    """
    require_wheel("Wong-Reece", load, diameter, width)
    lacking = [name for name in ("K", "c1", "c2") if not np.isfinite(getattr(ground, name))]
    if lacking:
        complete = [t.name for t in terrains().values() if np.isfinite([t.K, t.c1, t.c2]).all()]
        raise ResultsError(
            f"Wong-Reece: {', '.join(lacking)} of '{ground.name}' are not known; a terrain that "
            f"has them: {', '.join(complete)}"
        )
    radius = 0.5 * diameter
    if not 0 <= slip < 1:
        allowed = "driven wheels, slip from 0 to 1"
        raise OutOfRange(f"Wong-Reece is for {allowed}, not {slip:g}; no extrapolation changes that")

    def sums(entry: float) -> Floats:
        return _wong_reece_sums(entry, slip, radius, width, ground)

    deepest = math.radians(89.0)
    if sums(deepest)[0] < load:
        raise ResultsError(f"Wong-Reece: '{ground.name}' does not carry {load:g} N: the wheel would sink to its axle")
    entry = brentq(lambda angle: float(sums(angle)[0]) - load, 1e-6, deepest, xtol=1e-14)
    _, pull, torque = map(float, sums(entry))
    z = float(radius * (1 - np.cos(entry)))
    limits = [
        Limit("slip", slip, 0.0, 0.8, "", "the wheels of the paper"),
        Limit("diameter", diameter, 0.5, math.inf, "m", "the paper's wheel of 1.25 m; below 0.5 m not shown"),
        Limit("sinkage over diameter", z / diameter, 0.0, 0.26, "", "the paper's loose sand"),
        Limit("sinkage", z, 0.0, ground.deepest, "m", "the plates of the card"),
    ]
    outside = require_range("Wong-Reece", limits, extrapolate)
    extra = (
        PredictedValue("torque", torque, "N m"),
        PredictedValue("drawbar pull", pull, "N"),
        PredictedValue("entry angle", float(np.degrees(entry)), "deg"),
        PredictedValue("slip", slip, ""),
    )
    return Prediction("Wong-Reece", WONG_REECE_SOURCE, z, -pull, load, outside=outside, extra=extra)


# ---- formulas by name: "nrmm:PRESSURE" [Pa], "bekker:TERRAIN", "wong_reece:TERRAIN"


def predictions_for(run: WheelRun, names: Iterable[str], extrapolate: bool) -> list[Prediction]:
    """One per name. @raises ResultsError for what is no formula, or outside of the range of one"""
    return [_prediction(run, name, extrapolate) for name in names]


def require_formulas(names: Iterable[str]) -> None:
    """@raises ResultsError for a name that is none, for any run"""
    for name in names:
        _ground_of(name)


def _ground_of(name: str) -> float | TerrainValues:
    """Contact pressure [Pa] of nrmm, terrain of the others. @raises ResultsError for a name that is none"""
    method, _, what = name.partition(":")
    if method in ("bekker", "wong_reece"):
        return terrain(what)
    if method != "nrmm":
        known = "nrmm:PRESSURE, bekker:TERRAIN, wong_reece:TERRAIN"
        raise ResultsError(f"there is no formula '{method}'; there are {known}")
    try:
        pressure = float(what)
    except ValueError:
        raise ResultsError(
            f"formula '{name}': write nrmm:PRESSURE with the largest contact pressure in Pa, e.g. nrmm:179e3"
        ) from None
    require_pressure(pressure)
    return pressure


def _prediction(run: WheelRun, name: str, extrapolate: bool) -> Prediction:
    ground, load, width = _ground_of(name), run.number("load"), run.number("wheel_width")
    if isinstance(ground, TerrainValues):
        wheel = (load, 2 * run.radius, width)
        if name.startswith("bekker:"):
            return bekker(*wheel, ground, extrapolate)
        return wong_reece(*wheel, run.number("slip"), ground, extrapolate)
    if "density" not in run.conditions:
        raise ResultsError(f"{run.label}: the density of its ground is not known; NRMM needs it")
    snow = (run.number("depth"), run.number("density"), ground)
    return nrmm(load, run.radius, width, *snow, extrapolate=extrapolate)
