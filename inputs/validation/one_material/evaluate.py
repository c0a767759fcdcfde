# SPDX-License-Identifier: GPL-2.0-or-later
"""Distance of a law from grains or measurement, and the formula for the traction of vehicles."""

import math

from furrow_post.laws.empirical import snow_traction

LOAD, RADIUS, WIDTH = 6237.0, 0.37, 0.272  # [N], [m] of the wheel
TYRE_AREA = 0.03645  # [m2] on a hard surface at 179 kPa [Shoop2001] Table 6


def distance(value: float, grains: str, measured: str, measured_to: str, kind: str) -> float:
    """Distance of a law from the grains, else from the measurement, in the measure of the goal; NaN without both."""
    low, high = (grains, grains) if grains else (measured, measured_to or measured)
    if not low or math.isnan(value):
        return math.nan
    off = value - min(max(value, float(low)), float(high))
    return off / float(low) if kind == "relative" else off / (LOAD * RADIUS) if kind == "load" else off


def verdict(off: float, goal: str) -> str:
    return "" if math.isnan(off) else "met" if abs(off) <= float(goal) else "missed"


def formula(test: str, load: float, depth: float) -> float:
    """Coefficient of snow_traction() with the area of the wheel's arc in the snow, or of the tyre on a hard surface."""
    area = TYRE_AREA if test == "tyre" else WIDTH * RADIUS * math.acos(1 - depth / RADIUS)
    return snow_traction("undisturbed", load, area).coefficient
