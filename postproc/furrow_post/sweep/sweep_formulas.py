# SPDX-License-Identifier: GPL-2.0-or-later
"""Empirical formulas beside the curves, for the conditions of each point within their ranges."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..laws.prediction import Prediction
from ..laws.empirical import predictions_for
from ..errors import ResultsError
from .sweep_curves import EFFICIENCY, HUB_DROP, PULL, RESISTANCE, TORQUE, Axis, Line
from .series import speed_over_rim


@dataclass(frozen=True)
class FormulaLine:
    """Values of a formula along a line, where it is valid."""

    formula: str
    line: str  # label of the line with these conditions; empty for all lines
    x: tuple[float, ...]  # SI
    predictions: tuple[Prediction, ...]
    radii: tuple[float, ...]  # of the wheels [m]
    note: str  # of points without an answer; empty: none

    @property
    def label(self) -> str:
        return f"{self.formula} ({self.line})" if self.line else self.formula

    def equals(self, other: "FormulaLine") -> bool:
        """True where the other line has the same values within a percent."""

        def numbers(one: FormulaLine) -> list[float]:
            return [n for x, p in zip(one.x, one.predictions) for n in (x, p.sinkage, p.resistance)]

        mine, theirs = numbers(self), numbers(other)
        return len(mine) == len(theirs) and bool(np.allclose(mine, theirs, rtol=0.01))

    def values(self, y: Axis) -> list[tuple[float, float]]:
        """x and value; empty where the formula does not speak of y."""
        found = []
        for x, prediction, radius in zip(self.x, self.predictions, self.radii):
            value = _value(prediction, y, radius)
            if math.isfinite(value):
                found.append((x, value))
        return found


def _value(prediction: Prediction, y: Axis, radius: float) -> float:
    """Value of a formula; NaN outside its range. Bekker and NRMM cover towed wheels alone."""
    extra = {result.name: result.value for result in prediction.extra}
    pull, torque = extra.get("drawbar pull", math.nan), extra.get("torque", math.nan)
    if y == EFFICIENCY and pull > 0 and torque > 0:
        return pull * radius / torque * speed_over_rim(extra["slip"])
    known = {HUB_DROP: prediction.sinkage, RESISTANCE: prediction.coefficient}
    known |= {PULL: pull / prediction.load, TORQUE: torque / (prediction.load * radius)}
    return known.get(y, math.nan)


def formula_lines(
    lines: Sequence[Line], names: Sequence[str], extrapolate: bool
) -> list[FormulaLine]:
    """Lines of each formula along each line, but once where lines have the same conditions."""
    found: list[FormulaLine] = []
    for name in names:
        own = [_line(line, name, extrapolate) for line in lines]
        different = [one for k, one in enumerate(own) if not any(map(one.equals, own[:k]))]
        found += different if len(different) > 1 else [replace(different[0], line="")]
    return found


def _line(line: Line, name: str, extrapolate: bool) -> FormulaLine:
    found: list[tuple[float, Prediction, float]] = []
    reasons: list[str] = []
    for x, point in zip(line.x, line.points):
        run = point.runs[0]
        try:
            found.append((x, predictions_for(run, [name], extrapolate)[0], run.radius))
        except ResultsError as error:
            reasons.append(str(error).removesuffix(HINT))
    note = ""
    if reasons:
        missing = f"{len(reasons)} of {len(line.points)} points"
        note = f"{name}, {line.label}: no answer at {missing}: {reasons[0]}"
    places, predictions, radii = zip(*found) if found else ((), (), ())
    return FormulaLine(_title(name), line.label, places, predictions, radii, note)


def _title(name: str) -> str:
    """ "Bekker, LETE sand" of "bekker:LETE sand"."""
    method, _, what = name.partition(":")
    return METHODS[method] + (f", {what}" if method != "nrmm" else "")


METHODS = {"nrmm": "NRMM", "bekker": "Bekker", "wong_reece": "Wong–Reece"}
HINT = "; --extrapolate uses it all the same, and says so"
