# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of the model by regime, and its calibration, from the comparisons of measured.csv."""

import math
from dataclasses import replace
from typing import Any

import pandas

from furrow_post.uncertainty import model_error, whole_error
from furrow_post.uncertainty.model_error import Case, Test
from furrow_post.uncertainty.whole_error import SizeSeries
from furrow_post.tables.frames import rows_of

DIGITS = {"size_mm": 3, "core_minutes": 3, "hub_drop_m": 4, "numerical": 2, "whole": 2}
SAME = 1.05  # errors that differ by less are the same
SAME_WHEEL = "convergence: sand, slip 0"  # series of the wheel of ../costs/models.csv


def _texts(frame: pandas.DataFrame) -> list[dict[str, str]]:
    return [{name: str(cell) for name, cell in row.items()} for row in rows_of(frame)]


def _tests(frame: pandas.DataFrame) -> list[Test]:
    return [model_error.test_of(row) for row in _texts(frame)]


def scored(frame: pandas.DataFrame, known: Any) -> pandas.DataFrame:
    """Adds the whole error of predictions by the studies before them; empty where no test is near."""
    tests = _tests(known.tables["measured.csv"])
    others = model_error.regimes_of(test for test in tests if test.study != "predictions")
    return frame.assign(scored_error=[model_error.scored_error(others, row) for row in rows_of(frame)])


def speed(frame: pandas.DataFrame, known: Any) -> pandas.DataFrame:
    """Errors of the hub drop against cost, as a run of each size has them; the best for each cost, and for the error that is asked."""
    series = whole_error.series_of(_texts(frame))
    scheme = whole_error.scheme_of(_texts(known.tables["scheme.csv"]))
    known_regimes = model_error.regimes_of(_tests(known.tables["measured.csv"]))
    rows: list[dict[str, Any]] = []
    for one in (one for one in series if one.name not in known.constants["not_in_speed"]):
        for base in one.family.bases:
            case = Case(one.words["ground"], one.words["wheel"], one.words["motion"], "no", sinkage=base.sinkage / one.radius, radius=one.radius)
            parts = whole_error.like_wheels(series, scheme, base.ground, base.size / one.width, case, "sinkage")
            parts = replace(parts, time=base.sinkage_error / base.sinkage)
            quantity = "hub drop" if one.words["wheel"] == "tyre" else "depth"
            model = model_error.model_error(known_regimes, quantity, case)
            whole = replace(parts, model=model.value if model else math.nan).total
            rows.append(_point(one, base.ground, 1e3 * base.size, base.cpu_time, base.sinkage, parts.total, whole))
    reference = min((row for row in rows if row["series"] == SAME_WHEEL), key=lambda row: float(row["size_mm"]))
    for other in _texts(known.tables["../costs/models.csv"]):
        one = next(one for one in series if one.name == SAME_WHEEL)
        value = float(other["sinkage"])
        whole = math.hypot(value - reference["hub_drop_m"], reference["whole"] * reference["hub_drop_m"]) / value
        rows.append(_point(one, other["model"], math.nan, float(other["cpu_time"]), value, math.nan, whole))
    for row in rows:
        rivals = [other for other in rows if other["kind"] == row["kind"]]
        cheaper = [other["whole"] for other in rivals if other["core_minutes"] < row["core_minutes"]]
        row["best"] = _yes(SAME * row["whole"] < min(cheaper, default=math.inf))
        good = [other["core_minutes"] for other in rivals if other["whole"] <= known.constants["asked_error"]]
        row["asked"] = _yes(row["core_minutes"] == min(good, default=math.nan))
    return pandas.DataFrame(rows, dtype=object)


def _point(one: SizeSeries, ground: str, size: float, seconds: float, value: float, numerical: float, whole: float) -> dict[str, Any]:
    kind = f"{one.words['wheel']} on {one.words['ground']}"
    numbers = zip(DIGITS.items(), (size, seconds / 60, value, numerical, whole))
    return {"kind": kind, "series": one.name, "ground": ground} | {name: float(f"{x:.{digits}g}") for (name, digits), x in numbers}


def _yes(holds: bool) -> str:
    return "yes" if holds else "no"


def regimes(frame: pandas.DataFrame, known: Any) -> pandas.DataFrame:
    return pandas.DataFrame(model_error.regime_rows(_tests(frame)), dtype=object)


def calibration(frame: pandas.DataFrame, known: Any) -> pandas.DataFrame:
    return pandas.DataFrame(model_error.calibration_rows(_tests(frame)), dtype=object)
