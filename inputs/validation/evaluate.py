# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of the model by regime, and its calibration, from the comparisons of measured.csv."""

from typing import Any

import pandas

from furrow_post.analyse import model_error
from furrow_post.analyse.model_error import Test
from furrow_post.tables.frames import rows_of


def _tests(frame: pandas.DataFrame) -> list[Test]:
    return [model_error.test_of({name: str(cell) for name, cell in row.items()}) for row in rows_of(frame)]


def scored(frame: pandas.DataFrame, tables: Any, constants: Any) -> pandas.DataFrame:
    """Adds the whole error of predictions by the studies before them; empty where no test is near."""
    others = model_error.regimes_of(test for test in _tests(tables["measured.csv"]) if test.study != "predictions")
    return frame.assign(scored_error=[model_error.scored_error(others, row) for row in rows_of(frame)])


def regimes(frame: pandas.DataFrame, tables: Any, constants: Any) -> pandas.DataFrame:
    return pandas.DataFrame(model_error.regime_rows(_tests(frame)), dtype=object)


def calibration(frame: pandas.DataFrame, tables: Any, constants: Any) -> pandas.DataFrame:
    return pandas.DataFrame(model_error.calibration_rows(_tests(frame)), dtype=object)
