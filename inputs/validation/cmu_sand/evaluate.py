# SPDX-License-Identifier: GPL-2.0-or-later
"""The measured point next to a run, and forces along the heading of the wheel."""

import math
from pathlib import Path
from typing import Any

from furrow_post.tables.frames import read_frame

MEASURED: list[dict[str, Any]] = read_frame(Path(__file__).with_name("reference.csv")).to_dict("records")


def nearest(kind: str, slip: float) -> dict[str, Any]:
    """Nearest of the points that are computed."""
    return min((p for p in MEASURED if p["kind"] == kind and -0.75 < p["slip"] < 0.8), key=lambda p: float(abs(p["slip"] - slip)))


def along_heading(along_travel: float, lateral: float, slip_angle: float) -> float:
    """F_T from F_x and F_S, by equation 3 of src/theory/symbols.md; the angle in degrees."""
    angle = math.radians(slip_angle)
    return (along_travel + lateral * math.sin(angle)) / math.cos(angle)


def error_along_heading(along_travel: float, lateral: float, slip_angle: float) -> float:
    """Standard error of F_T from those of F_x and F_S, taken as independent."""
    angle = math.radians(slip_angle)
    return math.hypot(along_travel, lateral * math.sin(angle)) / math.cos(angle)
