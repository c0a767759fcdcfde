# SPDX-License-Identifier: GPL-2.0-or-later
"""What confined compression alone carries under the rigid wheel of [Shoop2001], in closed form.

A column of snow of height h0 below a cylinder of radius r that has sunk by z is compressed by
  w(x) = z - (r - sqrt(r^2 - x^2)),  eps = -ln(1 - w/h0),
and presses back with the oedometer's sigma1(eps). The wheel carries b times the integral of sigma1
over its contact: a rolling one over the front half, since the snow stays compressed behind it, a
standing one over both. Energy per metre is b times the integral of sigma1 dw from 0 to z.

What the snow bears by shear at the wheel's sides is not in it; at most it is that of a strip
footing on ground of cohesion c and friction angle phi that cannot be compressed (Prandtl), Nc c
over the contact's area, with tan(beta) = sqrt(3) sin(phi) and d = sqrt(3) c cos(phi) ([Shoop2001]
eq 19, 20). Snow that flows aside carries less than confined compression: both together bound the sinkage from
below.
"""

import math

import numpy as np

from furrow_post.arrays import Floats

LOAD = 636 * 9.80665  # [N]
RADIUS, WIDTH, DEPTH = 0.37, 0.272, 0.20  # [m]
# [Shoop2001] Table 3 as fresh_snow_shoop.yaml has it, beta 22.53 degrees: p_b [Pa] at eps
STRENGTH = (113.76, 5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 2.8e6)
STRAIN = (0.0, 0.6419, 0.7178, 0.8544, 0.9933, 1.1314, 1.3481, 1.5041)
TAN_BETA = math.tan(math.radians(22.53))
PHI = math.asin(TAN_BETA / math.sqrt(3))
NC = (math.exp(math.pi * math.tan(PHI)) * math.tan(math.pi / 4 + PHI / 2) ** 2 - 1) / math.tan(PHI)
POINTS = 2001
STRENGTHS = (5e3, 10e3, 20e3, 30e3, 72e3)  # d [Pa]


def axial_stress(strain: Floats, d: float) -> Floats:
    """sigma1 [Pa] in confined compression, at the corner of shear line and cap (R near 0)."""
    strength: Floats = np.interp(strain, STRAIN, STRENGTH)
    stress: Floats = strength + 2 / 3 * (d + strength * TAN_BETA)
    return stress


def carried(sinkage: float, d: float, sides: int) -> float:
    """[N] by confined compression, over one (rolling) or both (standing) sides of the axle."""
    half_length = math.sqrt(2 * RADIUS * sinkage - sinkage**2)
    x = np.linspace(0, half_length, POINTS)
    compression = sinkage - (RADIUS - np.sqrt(RADIUS**2 - x**2))
    stress = axial_stress(-np.log1p(-np.maximum(compression, 0.0) / DEPTH), d)
    return float(sides * WIDTH * np.trapz(stress, x))


def sunk(d: float, sides: int, footing: bool) -> float:
    """Sinkage [m] that carries the load; footing: with the bearing capacity of the cohesion."""
    low, high = 1e-4, 0.78 * DEPTH
    for _ in range(50):
        z = 0.5 * (low + high)
        area = sides * WIDTH * math.sqrt(2 * RADIUS * z - z**2)
        shear = NC * d / (math.sqrt(3) * math.cos(PHI)) * area if footing else 0.0
        low, high = (z, high) if carried(z, d, sides) + shear < LOAD else (low, z)
    return 0.5 * (low + high)


def resistance(sinkage: float, d: float) -> float:
    """Work of confined compression per metre over the load."""
    w = np.linspace(0, sinkage, POINTS)
    return float(WIDTH * np.trapz(axial_stress(-np.log1p(-w / DEPTH), d), w)) / LOAD


def table() -> list[dict[str, float]]:
    """For each d: share of the load that confined compression carries at 8 cm, the sinkage of the
    rolling and of the standing wheel by it alone, with the footing, and the resistance."""
    found = []
    for d in STRENGTHS:
        alone = sunk(d, 1, False)
        found.append(
            {
                "d_kPa": 1e-3 * d,
                "carried_at_8cm": round(carried(0.08, d, 1) / LOAD, 3),
                "rolling_m": round(alone, 4),
                "resistance": round(resistance(alone, d), 4),
                "rolling_with_footing_m": round(sunk(d, 1, True), 4),
                "standing_m": round(sunk(d, 2, False), 4),
                "standing_with_footing_m": round(sunk(d, 2, True), 4),
            }
        )
    return found
