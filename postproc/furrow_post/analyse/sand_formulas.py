# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid wheel on sand or soil: towed by Bekker, driven by Wong and Reece.

SI units; angles in degrees in the interface.
"""

import math

import numpy as np

from ..arrays import Floats
from ..errors import ResultsError
from .prediction import (
    Limit,
    OutOfRange,
    Prediction,
    Result,
    require_positive,
    require_range,
)
from .terrain_values import TerrainValues, terrains

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
    require_positive("Bekker's wheel", load=load, diameter=diameter, width=width)
    k, n = ground.modulus(width), ground.n
    z = (3 * load / ((3 - n) * width * k * np.sqrt(diameter))) ** (2 / (2 * n + 1))
    series = "Wong: for n up to 1.3, the series of the load integral is cut after two terms"
    outside = require_range(
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
    require_positive("Wong-Reece", load=load, diameter=diameter, width=width)
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
    outside = require_range(
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
