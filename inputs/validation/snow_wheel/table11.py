# SPDX-License-Identifier: GPL-2.0-or-later
"""The measured rows, and which of them an identification may see."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from furrow_post.csv_table import read_numbers

HERE = Path(__file__).resolve().parent

# The rows of reference.csv that the identification may see: density [kg/m3], depths [m]
CALIBRATION_DENSITY = 220.0
CALIBRATION_DEPTHS = (0.18, 0.22)
GOAL = {"sinkage_m": 0.012, "resistance": 0.031}  # rms over rows
DENSITY_UNDER, WITHIN = 510.0, 0.05  # under the wheel [kg/m3] [Shoop2001], and its goal


def reference() -> list[dict[str, float]]:
    """Rows of reference.csv."""
    return read_numbers(HERE / "reference.csv")


def is_calibration(row: Mapping[str, Any]) -> bool:
    low, high = CALIBRATION_DEPTHS
    return has_calibration_density(row) and bool(low <= row["depth_m"] <= high)


def has_calibration_density(row: Mapping[str, Any]) -> bool:
    """In snow of any depth."""
    return bool(row["density_kgm3"] == CALIBRATION_DENSITY)


# Choices of rows that the slope is identified on; all others are predicted
SLOPE_ROWS: dict[str, Callable[[Mapping[str, Any]], bool]] = {
    "220 kg/m3, 0.20 m: 3": lambda row: has_calibration_density(row) and row["depth_m"] == 0.20,
    "220 kg/m3, 0.18 to 0.22 m: 12": is_calibration,
    "220 kg/m3, with 0.38 m: 13": has_calibration_density,
}
