# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the lists of runs, and the measurements that they are for."""

import math
from dataclasses import dataclass
from pathlib import Path

from furrow_post.csv_table import read_rows
from furrow_post.study.case import Case, Value
from furrow_post.study.furrow_cases import script_case

HERE = Path(__file__).resolve().parent

# Numerical choices; checked in the stage 'checks'.
BASE: dict[str, Value] = {"diameter": 0.010, "young": 1e7, "seed": 86028121}
PLATE_BED: dict[str, Value] = {"length": 0.26, "depth": 0.10}
WHEEL_BED: dict[str, Value] = {"length": 0.46, "width": 0.16, "depth": 0.07}
PLATE_SPEED = 0.05  # [m/s]
PLATE_FRICTION = 0.4
# Not measured. The authors' model takes the sand's full friction at the rim of both wheels (their
# force data need it: see README.md); so the wheel is rough here, and the sand, not the rim, decides
# how much shear is carried.
WHEEL_FRICTION = 0.7
FASTEST = 0.2  # [m/s] the larger of travel and rim speed
TRAVEL = 0.24  # [m]
WINDOW = (0.14, 0.239)  # [m] of travel, for the steady values
# Assumed; the authors' code gives the share of the tread that the tips cover, 0.1: 24 x 1.65 mm on
# 2 pi 63 mm
GROUSERS = 24
GROUSER_THICKNESS = 0.00165  # [m]
GROUSER_HEIGHT = 0.005  # [m]
BED_KEYS = tuple(  # variables that make a bed what it is
    "length width depth diameter density young friction rolling pour_friction seed".split()
)
ORDER = [-0.0, -0.5, 0.5, 0.2, -0.2, 0.8]  # of the slips: breadth first


@dataclass(frozen=True)
class Grains:
    """A candidate of the explicit search on the plates."""

    friction: float
    rolling: float  # rolling friction
    pour_friction: float  # while the bed is made
    density: int  # of a grain, which gives 1330 kg/m3 in bulk [kg/m3]


CANDIDATES = {
    "A": Grains(0.5, 0.2, 0.5, 2440),
    "B": Grains(0.5, 0.1, 0.5, 2380),
    "C": Grains(0.3, 0.2, 0.3, 2340),
    "E": Grains(0.8, 0.2, 0.8, 2470),
}
CHOSEN = "A"
PLATES = (60, 80, 100)  # [mm]
WHEELS = ("smooth", "grouser")

FINER = "smooth wheel, 5 slips with grains of 8 mm"
GOALS = {
    f"{what}: rms of {quantity}": 0.10
    for what in ("smooth wheel", "grouser wheel", FINER)
    for quantity in ("Fx/Fz", "sinkage/r")
}
# What was reached, plus the scatter from one pour to the next (0.04 for the plates, 0.02 to 0.03
# for a wheel's rms, README.md): the limits of the test. The goals stand beside them and are not all
# reached.
REACHED = {
    "plates: rms of ln(force)": 0.32,
    "smooth wheel: rms of Fx/Fz": 0.11,
    "smooth wheel: rms of sinkage/r": 0.07,
    "grouser wheel: rms of Fx/Fz": 0.14,
    "grouser wheel: rms of sinkage/r": 0.12,
    f"{FINER}: rms of Fx/Fz": 0.18,
    f"{FINER}: rms of sinkage/r": 0.10,
}


@dataclass(frozen=True)
class Point:
    """A row of reference.csv; NaN where it has nothing."""

    kind: str  # plate, smooth or grouser
    values: dict[str, float]

    def __getitem__(self, key: str) -> float:
        return self.values[key]


def reference() -> list[Point]:
    return [
        Point(row["kind"], {k: float(v) if v else math.nan for k, v in row.items() if k != "kind"})
        for row in read_rows(HERE / "reference.csv")
    ]


def plate_points(size: int) -> list[Point]:
    """Measured on the plate of this size [mm]."""
    return [p for p in reference() if p.kind == "plate" and p["size_mm"] == size]


def wheel_points(kind: str) -> list[Point]:
    """Measured points that are computed."""
    return [p for p in reference() if p.kind == kind and -0.55 < p["slip"] < 0.8]


def nearest_point(kind: str, slip: float) -> Point:
    return min(wheel_points(kind), key=lambda p: abs(p["slip"] - slip))


def grains(candidate: str, changes: dict[str, Value]) -> dict[str, Value]:
    """Variables of the scripts; the step is 0.22 of the Rayleigh time of the smallest grain."""
    values: dict[str, Value] = {**BASE, **vars(CANDIDATES[candidate]), **changes}
    diameter, young = (float(str(values[key])) for key in ("diameter", "young"))
    return {**values, "step": f"{8e-5 * diameter / 0.010 * math.sqrt(1e7 / young):.3g}"}


def bed_key(script: str, variables: dict[str, Value]) -> tuple[Value | None, ...]:
    """Runs of equal keys use the same bed."""
    return (script, *(variables.get(key) for key in BED_KEYS))


def case(name: str, stage: str, script: str, variables: dict[str, Value], what: str = "") -> Case:
    return script_case(
        name,
        HERE / f"{script}.lig",
        variables,
        log=True,
        stage=stage,
        what=what,
        shares=bed_key(script, variables),
    )


def plate_case(
    name: str, stage: str, size: int, candidate: str, speed: float = PLATE_SPEED, **changes: Value
) -> Case:
    """size [mm], speed [m/s]; changes: of the grains' variables."""
    changes = {**PLATE_BED, "wall_friction": PLATE_FRICTION, **changes}
    test: dict[str, Value] = {"size": size / 1000, "speed": speed, "travel": 0.024}
    return case(name, stage, "plate", {**grains(candidate, changes), **test})


def bars_of(number: int) -> str:
    """Words of fix wheel/rigid; the share of the tread is the same for all numbers but 0."""
    if not number:
        return "grousers 0"
    thickness = GROUSER_THICKNESS * GROUSERS / number
    return f"grousers {number} grouser_height {GROUSER_HEIGHT} grouser_thickness {thickness:.5g}"


def wheel_case(
    name: str,
    stage: str,
    point: Point,
    what: str = "",
    candidate: str = CHOSEN,
    fastest: float = FASTEST,
    **changes: Value,
) -> Case:
    """One measured point: its own load and slip.

    The larger of travel and rim speed is the same for all slips: fastest [m/s].
    """
    bars = GROUSERS if point.kind == "grouser" else 0
    changes = {**WHEEL_BED, "wall_friction": WHEEL_FRICTION, **changes}
    test: dict[str, Value] = {
        "grousers": bars_of(bars),
        "grouser_height": GROUSER_HEIGHT if bars else 0.0,
        "slip": point["slip"],
        "load": point["load_N"],
        "speed": round(fastest * min(1.0, 1.0 - point["slip"]), 5),
        "travel": TRAVEL,
    }
    return case(name, stage, "wheel", {**grains(candidate, changes), **test, **changes}, what)


def wheel_name(point: Point) -> str:
    return f"{point.kind}_{point['slip']:+.3f}"


@dataclass(frozen=True)
class Check:
    """One thing changed on a wheel: its slip, what is changed, in words and in variables."""

    slip: float
    what: str
    changes: dict[str, Value]
    candidate: str = CHOSEN
    fastest: float = FASTEST


SEED = 67867967  # of another pour
# Of the smooth wheel. Speed, bed and pour with the cheapest grains.
CHECKS = {
    "grain_8": Check(0.231, "grains of 8 mm", {"diameter": 0.008}),
    "grain_12.5": Check(0.231, "grains of 12.5 mm", {"diameter": 0.0125}),
    "grain_8_slip_0": Check(0.0, "grains of 8 mm", {"diameter": 0.008}),
    "grain_8_slip_-0.2": Check(-0.2, "grains of 8 mm", {"diameter": 0.008}),
    "grain_8_slip_-0.5": Check(-0.5, "grains of 8 mm", {"diameter": 0.008}),
    "grain_8_slip_0.5": Check(0.5, "grains of 8 mm", {"diameter": 0.008}),
    "grain_6_slip_0": Check(0.0, "grains of 6 mm", {"diameter": 0.006}),
    "grain_12.5_slip_0": Check(0.0, "grains of 12.5 mm", {"diameter": 0.0125}),
    "bed_wide": Check(
        0.231,
        "grains of 12.5 mm, bed 0.24 m wide, 0.10 m deep",
        {"diameter": 0.0125, "width": 0.24, "depth": 0.10},
    ),
    "fast": Check(0.231, "grains of 12.5 mm, twice the speed", {"diameter": 0.0125}, fastest=0.4),
    "slow": Check(0.231, "grains of 12.5 mm, half the speed", {"diameter": 0.0125}, fastest=0.1),
    "seed_10": Check(0.231, "grains of 10 mm, another pour", {"seed": SEED}),
    "seed": Check(0.231, "grains of 12.5 mm, another pour", {"diameter": 0.0125, "seed": SEED}),
    "candidate_E": Check(0.231, "candidate E, grains of 10 mm", {}, candidate="E"),
    "candidate_E_slip_0": Check(0.0, "candidate E, grains of 10 mm", {}, candidate="E"),
    "wall_0.4": Check(
        0.0, "grains of 10 mm, friction of wheel and sand 0.4", {"wall_friction": 0.4}
    ),
}
PLATE_CHECKS: dict[str, dict[str, Value]] = {  # of the chosen candidate
    "12.5": {"diameter": 0.0125},
    "8": {"diameter": 0.008},
    "seed": {"seed": SEED},
    "fast": {},
}
PLATE_CHECK_SPEEDS = {"fast": 0.1}  # [m/s]
BASE_OF_CHECKS = (
    "base: grains of 10 mm, bed 0.46 x 0.16 x 0.07 m, 0.2 m/s, friction of wheel and sand 0.7"
)


def calibration_cases() -> list[Case]:
    return [
        plate_case(f"plate_{name}_{size}", "calibrate", size, name)
        for name in CANDIDATES
        for size in PLATES
    ]


def wheel_cases() -> list[Case]:
    """From best to worst."""
    return [
        wheel_case(wheel_name(point), "wheel", point)
        for kind in WHEELS
        for point in sorted(wheel_points(kind), key=lambda p: ORDER.index(round(p["slip"], 1)))
    ]


def check_cases() -> list[Case]:
    wheels = [
        wheel_case(
            f"check_{name}",
            "checks",
            nearest_point("smooth", check.slip),
            check.what,
            check.candidate,
            check.fastest,
            **check.changes,
        )
        for name, check in CHECKS.items()
    ]
    plates = [
        plate_case(
            f"plate_{CHOSEN}{name}_{size}",
            "checks",
            size,
            CHOSEN,
            PLATE_CHECK_SPEEDS.get(name, PLATE_SPEED),
            **changes,
        )
        for name, changes in PLATE_CHECKS.items()
        for size in PLATES
    ]
    return wheels + plates


def all_cases() -> dict[str, Case]:
    """Name -> case, in the order in which they are made."""
    cases = calibration_cases() + wheel_cases() + check_cases()
    return {case.name: case for case in cases}
