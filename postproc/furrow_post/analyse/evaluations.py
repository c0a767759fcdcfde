# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that studies take from the folder of one run: ends of paths, tyre states, curves, steady means."""

import csv
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from statistics import mean, stdev

import numpy as np

from ..arrays import Floats
from ..csv_table import read_columns, read_matrix, read_numbers
from ..errors import ResultsError, content_of
from ..run.process import SCREEN

AGAIN = "make the run again: remove its folder"


def path_states(folder: Path, steps: int, count: int = 1) -> list[dict[str, float]]:
    """States of a path of furrow-point at the ends of its parts, of so many steps each.

    @raises ResultsError where it did not come to its end
    """
    file = folder / "point.csv"
    points = read_numbers(file)
    if len(points) <= steps * count:
        raise ResultsError(f"{file}: has {len(points)} rows, not all steps; repeat the run")
    return [points[steps * part] for part in range(1, count + 1)]


def last_piece(columns: Mapping[str, Floats]) -> dict[str, Floats]:
    """Last piece of the columns of a path of furrow-point, with the state in which it begins."""
    segment = columns["segment"]
    begins = max(int(np.searchsorted(segment, segment[-1])) - 1, 0)
    return {name: column[begins:] for name, column in columns.items()}


def last_piece_of(folder: Path) -> dict[str, Floats]:
    """Last piece of the path in a folder. @raises ResultsError where there is no path"""
    file = folder / "point.csv"
    columns = read_columns(file)
    if "segment" not in columns:
        raise ResultsError(f"{file}: has no rows with a column 'segment'; {AGAIN}")
    return last_piece(columns)


def pressure_near(curve: Floats, sinkage: float, near: float) -> float:
    """Mean pressure [Pa] of a plate_curve around a sinkage [m]."""
    return float(curve[abs(curve[:, 1] - sinkage) < near, 3].mean())


def tyre_states(folder: Path, least: int = 0) -> list[dict[str, float]]:
    """Lines that furrow-tyre printed, also before it refused a state; the first has no load.

    @raises ResultsError where there are fewer than least
    """
    path = folder / SCREEN
    with content_of(path, AGAIN), open(path, encoding="utf-8") as file:
        found = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    if len(found) < least:
        raise ResultsError(f"{path}: has {len(found)} states of the tyre, not {least}; {AGAIN}")
    return found


def plate_curve(folder: Path) -> Floats:
    """(n, 4) step, sinkage [m], load [N], pressure [Pa]; no rows where there is none."""
    file = folder / "curve.txt"
    with content_of(file, AGAIN):
        curve: Floats = np.loadtxt(file, ndmin=2) if file.exists() else np.empty((0, 4))
    return curve if curve.size else np.empty((0, 4))


def whole_plate_curve(folder: Path) -> Floats:
    """Curve of plate_curve(). @raises ResultsError for an empty one"""
    curve = plate_curve(folder)
    if not curve.size:
        raise ResultsError(f"{folder}/curve.txt: has no rows; {AGAIN}")
    return curve


def wheel_means(wheel: Mapping[str, Floats], low: float, high: float) -> Floats:
    """(3) Hub drop [m], resistance coefficient, slip over a part of the travel, x [m] from its start."""
    x = wheel["x"] - wheel["x"][0]
    part = (x >= low) & (x <= high)
    resistance = -wheel["force_x"][part].sum() / wheel["force_z"][part].sum()
    return np.array([wheel["hub_drop"][part].mean(), resistance, wheel["slip"][part].mean()])


def steady_columns(wheel: Mapping[str, Floats], window: float) -> dict[str, float]:
    """Means over the last part of the travel [m], with half the difference between its halves."""
    end = float(wheel["x"][-1] - wheel["x"][0])
    sinkage, resistance, slip = wheel_means(wheel, end - window, end)
    middle = end - window / 2
    changes = 0.5 * np.abs(wheel_means(wheel, middle, end) - wheel_means(wheel, end - window, middle))
    names = ("sinkage_m", "sinkage_change_m", "resistance", "resistance_change")
    row = dict(zip(names, (sinkage, changes[0], resistance, changes[1])))
    return {name: round(float(value), 4) for name, value in row.items()} | {"slip": round(float(slip), 3)}


def watched_mean(folder: Path, column: int, columns: int, since: float, step: float) -> float:
    """Mean of a column of watch.txt from a time [s] on; step: of the run [s]."""
    watch = read_matrix(folder / "watch.txt", columns)
    return float(watch[watch[:, 0] * step > since, column].mean())


def cost_ratio(name: str, seconds: Mapping[str, float], pairs: Sequence[tuple[str, str]]) -> list[dict[str, object]]:
    """Core seconds of the first run of each pair over those of the second: mean and standard error
    over the pairs, in one row; no row where fewer than two pairs were run.

    seconds: by name of the run
    """
    ratios = [seconds[dear] / seconds[cheap] for dear, cheap in pairs if {dear, cheap} <= seconds.keys()]
    if len(ratios) < 2:
        return []
    ratio, error = mean_of_packings(ratios)
    return [{"run": name, "pairs": len(ratios), "ratio": round(ratio, 3), "ratio_error": round(error, 3)}]


def mean_of_packings(values: Sequence[float]) -> tuple[float, float]:
    """Mean and its standard error; NaN of one packing alone."""
    return mean(values), stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def fine_grains(sizes: Mapping[str, Sequence[float]]) -> tuple[float, float]:
    """Mean of the packings of the finest grains, by diameter. Its error has their scatter, and the step from the next
    coarser grains where there are any."""
    finest, *coarser = sorted(sizes, key=float)
    fine, scatter = mean_of_packings(sizes[finest])
    return fine, math.hypot(scatter, fine - mean(sizes[coarser[0]])) if coarser else scatter
