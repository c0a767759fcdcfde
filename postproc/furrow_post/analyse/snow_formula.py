# SPDX-License-Identifier: GPL-2.0-or-later
"""NRMM: a wheel in shallow snow; gross traction on snow and ice. SI units."""

import math
from dataclasses import dataclass

import numpy as np

from ..errors import ResultsError
from .prediction import Limit, Prediction, Result, require_positive, require_range

NRMM_SOURCE = (
    "NRMM shallow snow, P. W. Richmond et al.; S. A. Shoop, ERDC/CRREL TR-01-16 (2001), eq 29-33"
)
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


def require_pressure(pressure: float) -> None:
    """@raises ResultsError for a contact pressure that no wheel has, such as one in kPa"""
    low, high = NRMM_PRESSURE
    if not low <= pressure <= high:
        raise ResultsError(
            f"NRMM: a contact pressure of {pressure:g} Pa; allowed: {low:g} to {high:g} Pa. Give it in "
            "Pa, e.g. 179e3"
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
    sizes = {"load": load, "radius": radius, "width": width, "depth": depth}
    require_positive("NRMM", **sizes, density=density, pressure=pressure)
    require_pressure(pressure)
    if sinkage is not None and not 0.0 <= sinkage < depth:
        raise ResultsError(
            f"NRMM: a sinkage of {sinkage:g} m in snow {depth:g} m deep; allowed: from 0 to below "
            "the depth"
        )
    z = nrmm_sinkage(depth, density, pressure) if sinkage is None else sinkage
    final = nrmm_final_density(pressure)
    why = f"within 10 % of the wheel of {NRMM_TESTS}"
    outside = require_range(
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
        """Lines for a person."""
        return "\n".join(
            [
                f"snow_traction, {self.surface}  ({TRACTION_SOURCE})",
                f"  contact pressure           {self.pressure / 1e3:.4g} kPa",
                f"  gross traction             {self.gross:.4g} N",
                f"  gross traction coefficient {self.coefficient:.4f}",
                "  Subtract the motion resistance, for example of nrmm, for the net traction.",
            ]
        )


def snow_traction(surface: str, load: float, contact_area: float) -> SnowTraction:
    """load [N], contact_area [m2] on hard ground. @raises ResultsError"""
    if surface not in TRACTION:
        raise ResultsError(f"there is no surface '{surface}'; there are {', '.join(TRACTION)}")
    require_positive("snow_traction", load=load, contact_area=contact_area)
    pressure = load / contact_area
    low, high = NRMM_PRESSURE
    if not low <= pressure <= high:
        raise ResultsError(
            f"snow_traction: a contact pressure of {pressure:g} Pa; allowed: {low:g} to {high:g} Pa. "
            "Give the load in N and the contact area in m2"
        )
    return SnowTraction(surface, load, pressure)
