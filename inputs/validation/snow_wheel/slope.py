# SPDX-License-Identifier: GPL-2.0-or-later
"""The slope M of Cam clay, and so K0, that the measured rows ask for, all else the same.

A measured sinkage is read as the hub's, or as the depth of the rut that is left. Sinkage,
resistance and density under the wheel of runs with three slopes are interpolated, over the slope by
a parabola in 1/M^2, of which they are nearly straight lines, and over the depth by straight lines;
the slope is the one of the least sum of squares over the goals. Its range: where that sum exceeds
the least one by no more than the share 1/(N - 1) of it, N the number of its terms; one standard
error where the tests' scatter is all that is left. A slope at an end of those that were run is a
bound.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import snow
import table11

from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats

Row = dict[str, Any]
TRIED = 1901  # slopes between the ends
GOAL = {**table11.GOAL, "density_under": table11.WITHIN * table11.DENSITY_UNDER}


class Computed(NamedTuple):
    """Of the runs: quantity of GOAL -> values (slope, depth)."""

    slopes: Sequence[float]  # three
    depths: Sequence[float]  # [m], increasing
    values: Mapping[str, Floats]

    def tried(self) -> Floats:
        return np.linspace(min(self.slopes), max(self.slopes), TRIED)

    def reaches(self, depths: Sequence[float]) -> bool:
        """Whether all of them lie between those that were run."""
        return bool(self.depths[0] <= min(depths) and max(depths) <= self.depths[-1])

    def at(self, what: str, depths: Sequence[float]) -> Floats:
        """(slope of tried(), depth of a row)"""
        rows = np.array([np.interp(depths, self.depths, line) for line in self.values[what]])
        fits = np.polyfit(np.array(self.slopes) ** -2, rows, 2)
        return np.array([np.polyval(fit, self.tried() ** -2) for fit in fits.T]).T


class Found(NamedTuple):
    """The slope, its range, and what is left of each quantity, rms."""

    slope: float
    low: float
    high: float
    left: dict[str, float]


class Reading(NamedTuple):
    """Of the measured sinkages."""

    name: str
    computed: Computed
    models: Mapping[float, str]  # slope -> the model of the rows that was run with it, increasing
    column: str  # that a model's sinkage has there

    def predicted(self, row: Row, what: str, slope: float) -> float:
        """Of a row, straight between its models."""
        column = self.column if what == "sinkage_m" else what
        values = [row[f"{model}_{column}"] for model in self.models.values()]
        return float(np.interp(slope, list(self.models), values))


def identify(rows: Sequence[Mapping[str, float]], computed: Computed) -> Found:
    """From measured rows."""
    depths, tried = [row["depth_m"] for row in rows], computed.tried()
    wrong = {
        what: computed.at(what, depths)
        - np.array([row.get(what, table11.DENSITY_UNDER) for row in rows])
        for what in GOAL
    }
    total = sum(np.mean((wrong[what] / goal) ** 2, axis=1) for what, goal in GOAL.items())
    best = int(np.argmin(total))
    terms = len(table11.GOAL) * len(rows) + 1  # one density was measured
    inside = tried[total <= total[best] * (1 + 1 / (terms - 1))]
    left = {what: rms(errors[best]) for what, errors in wrong.items()}
    return Found(float(tried[best]), float(inside[0]), float(inside[-1]), left)


def table(measured: Sequence[Row], readings: Sequence[Reading]) -> list[Row]:
    """For each reading, and each choice of rows whose depths its slopes were run for. measured:
    rows of rows.csv; the others are predicted with the slope that is found, as far as models with
    such slopes were run."""
    found = []
    for reading in readings:
        for name, chosen in table11.SLOPE_ROWS.items():
            mine = [row for row in measured if chosen(row)]
            if mine and reading.computed.reaches([row["depth_m"] for row in mine]):
                others = [row for row in measured if not chosen(row)]
                found.append({"rows": name, **_line(reading, mine, others)})
    return found


def _line(reading: Reading, mine: Sequence[Row], others: Sequence[Row]) -> Row:
    one = identify(mine, reading.computed)
    row: Row = {"reading": reading.name}
    for place, slope in (("", one.slope), ("_low", one.low), ("_high", one.high)):
        row[f"slope{place}"] = round(slope, 2)
        row[f"k0{place}"] = round(snow.confined(slope)[0], 2)
    used = float(np.clip(one.slope, min(reading.models), max(reading.models)))
    row["others_slope"] = round(used, 2)
    for what in table11.GOAL:
        row[f"{what}_rms"] = round(one.left[what], 4)
        wrong = [reading.predicted(other, what, used) - other[what] for other in others]
        row[f"others_{what}_rms"] = round(rms(wrong), 4)
    return row
