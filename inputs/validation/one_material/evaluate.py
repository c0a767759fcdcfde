# SPDX-License-Identifier: GPL-2.0-or-later
"""Distance of a law from grains or measurement, and the formula for the traction of vehicles."""

import math

from furrow_post.laws.empirical import snow_traction

LOAD, RADIUS, WIDTH = 6237.0, 0.37, 0.272  # [N], [m] of the wheel
TYRE_AREA = 0.03645  # [m2] on a hard surface at 179 kPa [Shoop2001] Table 6


def distance(value: float, grains: str, measured: str, measured_to: str, kind: str) -> float:
    """From the grains, else from the measurement or its range, in the measure of the goal; NaN where there is none."""
    low, high = (grains, grains) if grains else (measured, measured_to or measured)
    if not low or math.isnan(value):
        return math.nan
    off = value - min(max(value, float(low)), float(high))
    return off / float(low) if kind == "relative" else off / (LOAD * RADIUS) if kind == "load" else off


def verdict(off: float, goal: str) -> str:
    return "" if math.isnan(off) else "met" if abs(off) <= float(goal) else "missed"


def formula(test: str, load: float, depth: float) -> float:
    """Contact pressure: load over the arc of the wheel in the snow, or over the area of the tyre on a hard surface."""
    area = TYRE_AREA if test == "tyre" else WIDTH * RADIUS * math.acos(1 - depth / RADIUS)
    return snow_traction("undisturbed", load, area).coefficient
