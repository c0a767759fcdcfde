# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms: confined compression, with Prandtl's footing for shear ([Shoop2001] eq 19, 20), and NRMM."""

import math

import numpy as np

from furrow_post.laws import empirical
from furrow_post.laws.compressed_snow import CompressedSnow

LOAD, RADIUS, WIDTH, PRESSURE = 636 * 9.80665, 0.37, 0.272, 179e3  # [N], [m], [Pa]
# [Shoop2001] Table 3 as fresh_snow_shoop.yaml has it, beta 22.53 degrees: p_b [Pa] at eps
STRENGTH, STRAIN = (113.76, 5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 2.8e6), (0.0, 0.6419, 0.7178, 0.8544, 0.9933, 1.1314, 1.3481, 1.5041)
TAN_BETA = math.tan(math.radians(22.53))
PHI = math.asin(TAN_BETA / math.sqrt(3))
NC = (math.exp(math.pi * math.tan(PHI)) * math.tan(math.pi / 4 + PHI / 2) ** 2 - 1) / math.tan(PHI)


def closed_form(d: float) -> dict[str, object]:
    """Axial stress at the corner of shear line and cap (R near 0). d: [Pa]"""
    snow = CompressedSnow(RADIUS, WIDTH, 0.20, lambda eps: (p := np.interp(eps, STRAIN, STRENGTH)) + 2 / 3 * (d + p * TAN_BETA))
    return {"d": d, "load": LOAD, "snow": snow, "footing": NC * d / (math.sqrt(3) * math.cos(PHI))}


def nrmm(depth: float, density: float) -> tuple[float, float, float]:
    """Sinkage [m] and resistance coefficients, whose factors of deep snow go by the sinkage, then by the depth."""
    z = empirical.nrmm_sinkage(depth, density, PRESSURE)
    by_sinkage, by_depth = (empirical.nrmm_resistance(density, WIDTH, RADIUS, z, deep) / LOAD for deep in (None, depth))
    return z, by_sinkage, by_depth
