# SPDX-License-Identifier: GPL-2.0-or-later
"""A parameter of a material that measured rows ask for, and what it predicts of the other rows."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas

from ..laws.response import Response
from ..uncertainty.statistics import rms
from .frames import Row
from .operations import Tables, where


def identify(
    frame: pandas.DataFrame,
    tables: Tables,
    constants: Row,
    runs: Sequence[str],
    readings: Mapping[str, Any],
    choices: Mapping[str, str],
    goals: Mapping[str, float],
    place: str,
) -> pandas.DataFrame:
    """A row for each reading and each choice of measured rows whose places its runs reach (laws/response.py).

    runs: tables with a row for each run; readings: name -> values (of the parameter), places, runs (names by value and
    place), columns (quantity -> column of a run that is read as such), models (value -> model of the frame's columns
    MODEL_COLUMN that was run with it); choices: words -> condition of the rows that are seen; goals: quantity -> goal of
    its rms; place: column of the places. A quantity that the frame has no column of is a constant. Columns: choice,
    reading, count, value, low, high, used (value of the nearest model), QUANTITY_rms and others_QUANTITY_rms.
    """
    known = pandas.concat([tables[name] for name in runs])
    if not len(known):
        return frame.iloc[:0]
    known = known.drop_duplicates("run").set_index("run")
    made: list[Row] = []
    for reading, one in readings.items():
        columns = {**{what: what for what in goals}, **one.get("columns", {})}
        if not all(run in known.index and not known.failure.get(run) for line in one["runs"] for run in line):
            continue
        found = {what: np.array([[known[own][run] for run in line] for line in one["runs"]]) for what, own in columns.items()}
        response = Response(one["values"], one["places"], found)
        for words, condition in choices.items():
            mine = where(frame, tables, constants, condition)
            places = list(mine[place])
            if not len(mine) or not response.reaches(places):
                continue
            best = response.identify(places, {what: list(mine[what]) if what in mine else constants[what] for what in goals}, goals)
            others, models = frame.drop(mine.index), one["models"]
            used = float(np.clip(best.value, min(models), max(models)))
            row: Row = {"choice": words, "reading": reading, "count": len(mine), "value": best.value, "low": best.low, "high": best.high, "used": used}
            for what in (what for what in goals if what in frame):
                predicted = [np.interp(used, list(models), [r[f"{m}_{columns[what]}"] for m in models.values()]) for r in others.to_dict("records")]
                row |= {f"{what}_rms": best.left[what], f"others_{what}_rms": rms(np.array(predicted) - others[what])}
            made.append(row)
    return pandas.DataFrame(made)
