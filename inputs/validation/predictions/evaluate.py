# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions of conditions.csv as keys of runs: tyres, slips and cells; forces in the frame of the wheel."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np

from furrow_post.csv_table import read_rows
from furrow_post.read.results import Results
from furrow_post.study.runs import Run

HERE = Path(__file__).resolve().parent
WHEEL = 0.38  # [m] radius of the wheel in the tests that the tyre file describes
ANGLES, SLIPS = (15, 30, 45), (-0.5, 0.0, 0.23, 0.5)  # of the CMU tests that are predicted
SEEDS = (86028121, 67867967)  # two pours
# Conditions of the group CMU in further.csv, by wheel and slip angle: every slip and every angle occurs. The
# number is that of conditions.csv: ten times the rim speed over the travel speed.
FURTHER: dict[str, dict[int, tuple[int, ...]]] = {
    "smooth": {15: (3, 40), 30: (8, 100), 45: (0, 40), 60: (5, 12), 75: (10, 20), 90: (3, 10)},
    "grouser": {15: (0, 3, 8, 40), 30: (0, 8, 40, 100), 45: (0, 3, 8, 40), 60: (0, 5, 10, 20), 75: (3, 8, 12, 40), 90: (0, 5, 12, 20)},
}
FASTEST = 0.4  # [m/s] the larger of travel and rim speed in the runs on grains
POWERS = {"bead_radius": 1, "bead_spacing": 1, "radius": 1, "half_width": 1, "length": 1, "curvature": -1}


def conditions(group: str) -> list[dict[str, Any]]:
    return [row for row in read_rows(HERE / "conditions.csv") if row["id"].startswith(group)]


def order(name: str) -> int:
    return [row["id"] for row in conditions("")].index(name)


def scaled_tyre(radius: float) -> str:
    """The tyre file with all lengths scaled to a wheel of another radius [m]. Curvatures scale inversely. Stiffnesses,
    mass per area and pressure stay those of the same plies."""

    def scaled(match: "re.Match[str]") -> str:
        scale = (radius / WHEEL) ** POWERS[match[2]]
        values = re.sub(r"\d+\.?\d*(e-?\d+)?", lambda n: f"{float(n[0]) * scale:.6g}", match[3])
        return f"{match[1]}{match[2]}:{values}"

    text = (HERE.parents[1] / "tyres" / "p235_75r15.yaml").read_text()
    return re.sub(rf"(?m)^(  )({'|'.join(POWERS)}):([^#\n]*)", scaled, text)


def snow(fine: bool) -> list[dict[str, Any]]:
    """The towed tyre in cells of a fifth and a quarter of 0.20 m; fine: in cells of 2.5 to 3 cm."""
    runs = []
    for row in conditions("T11"):
        depth, radius = float(row["snow_depth_m"]), float(row["wheel_radius_m"])
        deep = depth > 0.3
        place: dict[str, Any] = {"distance": 2 if deep else 1.2, "width": "1.0" if deep else "0.8", "above": 0.6 if deep else 0.4}
        place |= {**row, "depth": f"{depth:g}", "radius": radius, "tyre_radius": f"{0.3483 * radius / WHEEL:.5g}"}
        for size in (0.03 if deep else 0.026,) if fine else (0.04, 0.05):
            runs.append({**place, "size": f"{size:g}", "cell": f"{depth / max(3, round(depth / size)):.6g}"})
    return runs


def in_wheel_frame(slip: float, angle: float) -> tuple[float, float]:
    """Rim and travel speed over the larger of them, from the slip by total travel speed; and the slip that the rig
    takes, by the speed in the wheel plane."""
    rim, travel = (1.0, 1 - slip) if slip >= 0 else (1 + slip, 1.0)
    forward = travel * math.cos(math.radians(angle))
    return travel, (rim - forward) / max(rim, forward)


def is_predicted(row: dict[str, str]) -> bool:
    near = not row["id"].startswith("CMU") or any(abs(float(row["slip"]) - slip) < 0.01 for slip in SLIPS)
    return near and (not row["id"].startswith("CMU") or float(row["slip_angle_deg"]) in ANGLES)


def wheel_keys(row: dict[str, Any], angle: float) -> dict[str, Any]:
    """Keys of a run on grains; angle: of slip, as the rig takes it [degrees]."""
    travel, slip = in_wheel_frame(float(row["slip"]), angle)
    grousers = "grouser" in row["id"]
    return {
        **row, "rig_slip": f"{slip:.6g}", "speed": f"{FASTEST * travel:.5g}", "angle": f"{angle:g}", "height": "0.005" if grousers else "0",
        "bars": "grousers 24 grouser_height 0.005 grouser_thickness 0.00165" if grousers else "grousers 0",
    }  # fmt: skip


def sand() -> list[dict[str, Any]]:
    """The wheel at a slip angle on grains that were calibrated on plates alone; two pours."""
    rows = filter(is_predicted, conditions("CMU"))
    keys = [wheel_keys(row, float(row["slip_angle_deg"])) for row in rows]
    return [{**one, "pour": k + 1, "seed": seed} for one in keys for k, seed in enumerate(SEEDS)]


def further_sand() -> list[dict[str, Any]]:
    """Further tests of the wheel at a slip angle, on one packing of finer grains. A wheel that travels across its plane
    needs a wider bed; the rig takes angles below 90 degrees."""
    rows = {row["id"]: row for row in conditions("CMU")}
    return [
        {**wheel_keys(rows[f"CMU-{wheel}-{angle}-{number}"], min(float(angle), 89.9)), "width": "0.3" if angle > 45 else "0.22"}
        for wheel, angles in FURTHER.items()
        for angle, numbers in angles.items()
        for number in numbers
    ]


def is_braked(name: str) -> bool:
    """True for a run whose wheel turns slower than it travels."""
    return int(name.partition("/")[0].split("-")[3]) < 10


def in_wheel_axes(pull: float, side: float, load: float, angle: float) -> tuple[float, float]:
    """Forces along the heading and along the axle over F_z (src/theory/symbols.md). The drawbar pull is the force along
    the travel, F_x = F_T cos(angle) - F_S sin(angle); the lateral force is F_S."""
    return (pull + side * math.sin(math.radians(angle))) / math.cos(math.radians(angle)) / load, side / load


def slip_at_the_end(run: Run, seconds: float, rim_speed: float) -> dict[str, float]:
    """Slip over the last part of a run [s], also of a wheel that digs in; error: half the change between its halves."""
    history = Results(run.folder).columns
    time, x = history["time"], history["x"]
    marks = np.interp(time[-1] - seconds * np.array([1.0, 0.5, 0.0]), time, x)
    first, second = 1.0 - np.diff(marks) / (0.5 * seconds * rim_speed)
    return {"slip": 0.5 * (first + second), "slip_error": 0.5 * abs(second - first)}
