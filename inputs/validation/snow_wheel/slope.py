# SPDX-License-Identifier: GPL-2.0-or-later
"""The slope M of Cam clay, and so K0, that the measured rows ask for, all else the same.

Sinkage and resistance of the runs with the three slopes of cases.SLOPES are interpolated, over the
slope by a parabola in 1/M^2, of which they are nearly straight lines, and over the depth by
straight lines; the slope is the one of the least sum of
squares over the goals. Its range: where that sum exceeds the least one by no more than the share
1/(N - 1) of it, N the number of its terms; one standard error where the tests' scatter is all that
is left. It is sought between the laboratory's K0 and one that is far too large; a slope at an end
is a bound.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

import cases

from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats

Row = dict[str, Any]
TRIED = np.linspace(min(cases.SLOPES), max(cases.SLOPES), 1901)


class Computed(NamedTuple):
    """Of the runs: quantity of cases.GOAL -> values (slope of cases.SLOPES, depth)."""

    depths: Sequence[float]  # [m], increasing
    values: Mapping[str, Floats]

    def at(self, what: str, depths: Sequence[float]) -> Floats:
        """(slope of TRIED, depth of a row)"""
        rows = np.array([np.interp(depths, self.depths, line) for line in self.values[what]])
        fits = np.polyfit(np.array(cases.SLOPES) ** -2, rows, 2)
        return np.array([np.polyval(fit, TRIED**-2) for fit in fits.T]).T


class Found(NamedTuple):
    """The slope, its range, and what is left of each quantity, rms."""

    slope: float
    low: float
    high: float
    left: dict[str, float]


def identify(rows: Sequence[Mapping[str, float]], computed: Computed) -> Found:
    """From measured rows."""
    depths = [row["depth_m"] for row in rows]
    wrong = {
        what: computed.at(what, depths) - np.array([row[what] for row in rows])
        for what in cases.GOAL
    }
    total = sum(np.mean((wrong[what] / goal) ** 2, axis=1) for what, goal in cases.GOAL.items())
    best = int(np.argmin(total))
    terms = len(cases.GOAL) * len(rows)
    inside = TRIED[total <= total[best] * (1 + 1 / (terms - 1))]
    left = {what: rms(errors[best]) for what, errors in wrong.items()}
    return Found(float(TRIED[best]), float(inside[0]), float(inside[-1]), left)


def between(low: float, high: float, slope: float) -> float:
    """Value at a slope, straight between those with cases.FLOWING and cases.CRUSHED."""
    share = (slope - cases.FLOWING) / (cases.CRUSHED - cases.FLOWING)
    return low + share * (high - low)


def table(measured: Sequence[Row], computed: Computed) -> list[Row]:
    """For both choices of rows. measured: rows of rows.csv; the others are predicted with the slope
    that is found, but not below cases.FLOWING, beyond which they have no run."""
    found = []
    for name, chosen in cases.SLOPE_ROWS.items():
        one = identify([row for row in measured if chosen(row)], computed)
        row: Row = {"rows": name}
        for place, slope in (("", one.slope), ("_low", one.low), ("_high", one.high)):
            row[f"slope{place}"] = round(slope, 2)
            row[f"k0{place}"] = round(cases.confined(slope)[0], 2)
        others = [other for other in measured if not chosen(other)]
        used = max(one.slope, cases.FLOWING)
        row["others_slope"] = round(used, 2)
        for what, left in one.left.items():
            row[f"{what}_rms"] = round(left, 4)
            wrong = [
                between(other[f"flowing_{what}"], other[f"tyre_{what}"], used) - other[what]
                for other in others
            ]
            row[f"others_{what}_rms"] = round(rms(wrong), 4)
        found.append(row)
    return found
