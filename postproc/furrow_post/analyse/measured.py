# SPDX-License-Identifier: GPL-2.0-or-later
"""Measurements near a run's conditions, from a reference.csv."""

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..csv_table import read_numbers
from ..errors import ResultsError
from ..read.wheel_run import WheelRun
from ..uncertainty.budget import Budget
from ..uncertainty.verdict import MEASURED, QUANTITIES, Entry

ROUNDING = 1e-9  # of a ratio of two decimal numbers


class Measured(NamedTuple):
    """Mean and scatter of measurements near a run's conditions."""

    sinkage: float  # [m]
    sinkage_scatter: float  # standard deviation [m]
    coefficient: float
    coefficient_scatter: float
    tests: int


def read_measured(
    path: Path,
    depth: float,
    density: float | None = None,
    depth_range: tuple[float, float] = (0.9, 1.1),
    density_range: tuple[float, float] = (0.85, 1.15),
) -> Measured:
    """Measurements of the rows of a reference.csv near this depth [m] and density [kg/m3].

    Columns depth_m, sinkage_m, resistance, density_kgm3; ranges are relative. @raises ResultsError
    where a column is missing or fewer than three rows are near
    """
    try:
        near = [
            row
            for row in read_numbers(path)
            if _within(row["depth_m"] / depth, depth_range)
            and (density is None or _within(row["density_kgm3"] / density, density_range))
        ]
        sinkage = np.array([row["sinkage_m"] for row in near])
        coefficient = np.array([row["resistance"] for row in near])
    except KeyError as error:
        raise ResultsError(
            f"{path}: has no column {error}; needed are depth_m, sinkage_m, resistance, "
            "density_kgm3"
        ) from error
    if len(near) < 3:
        and_density = f" and near {density:.0f} kg/m3" if density else ""
        raise ResultsError(
            f"{path}: has {len(near)} rows within {100 * (depth_range[1] - 1):.0f} % of a depth of "
            f"{depth:.3g} m{and_density}; a scatter needs three"
        )
    return Measured(
        float(sinkage.mean()),
        float(sinkage.std(ddof=1)),
        float(coefficient.mean()),
        float(coefficient.std(ddof=1)),
        len(near),
    )


def _within(ratio: float, limits: tuple[float, float]) -> bool:
    """Limits included: 0.18/0.2 is 0.9, whatever its last binary digit."""
    return limits[0] - ROUNDING <= ratio <= limits[1] + ROUNDING


def measured_entries(path: Path, run: WheelRun) -> list[Entry]:
    density = run.number("density") if "density" in run.conditions else None
    if not math.isfinite(run.number("depth")):
        raise ResultsError(f"{run.label}: has no terrain; --measured needs its depth")
    measured = read_measured(path, run.number("depth"), density)
    note = f"mean and scatter of {measured.tests} tests"
    values = (
        (measured.sinkage, measured.sinkage_scatter),
        (measured.coefficient, measured.coefficient_scatter),
    )
    return [
        Entry(quantity, MEASURED, value, Budget(time=scatter), MEASURED, note)
        for quantity, (value, scatter) in zip(QUANTITIES, values)
    ]
