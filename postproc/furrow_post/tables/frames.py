# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables as pandas data frames. Cells are numbers and text as the CSV file has them."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas

from ..csv_table import read_rows

Row = dict[str, Any]


def cell(text: str) -> Any:
    """Number or text of one cell; an empty cell is NaN."""
    if text == "":
        return np.nan
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def frame_of(rows: Sequence[Mapping[str, Any]], texts: Sequence[str] = ()) -> pandas.DataFrame:
    """Rows as a CSV file would hold them. Columns of numbers have a numeric type, except texts."""
    written = [{name: "" if value is None else str(value) for name, value in row.items()} for row in rows]
    frame = pandas.DataFrame(written, dtype=object)
    for name in frame.columns:
        column = [cell("" if text != text else text) for text in frame[name]]
        numeric = all(not isinstance(one, str) for one in column) and any(one == one for one in column) and name not in texts
        if not numeric:  # a column of text keeps its texts, such as "10"; so does an empty one
            column = ["" if text != text else text for text in frame[name]]
        frame[name] = pandas.Series(column, index=frame.index, dtype=None if numeric else object)
    return frame


def read_frame(path: Path, texts: Sequence[str] = ()) -> pandas.DataFrame:
    """A table of a study; texts: columns that stay text. @raises OSError, ResultsError"""
    return frame_of(read_rows(path), texts)


def is_missing(value: Any) -> bool:
    """None or NaN."""
    return value is None or (isinstance(value, float) and value != value)


def plain(value: Any) -> Any:
    """A Python number of a numpy scalar; missing values are empty text."""
    value = value.item() if isinstance(value, np.generic) else value
    return "" if is_missing(value) else value


def rows_of(frame: pandas.DataFrame) -> list[Row]:
    """Rows for a CSV file."""
    return [{name: plain(value) for name, value in row.items()} for row in frame.to_dict("records")]
