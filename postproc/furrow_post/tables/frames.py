# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables as pandas data frames, whose cells are numbers and text as the CSV file has them; Python expressions in a
study.yaml, such as "round(1e3 * sinkage_m, 1)"."""

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas

from ..uncertainty.statistics import block_mean, drift, rms
from ..csv_table import read_rows
from ..errors import ResultsError
from ..study.values import NOT_ESTIMATED

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


def plain(value: Any) -> Any:
    """A Python number of a numpy scalar; missing values are empty text."""
    value = value.item() if isinstance(value, np.generic) else value
    return "" if value is None or isinstance(value, float) and value != value else value


def rows_of(frame: pandas.DataFrame) -> list[Row]:
    """Rows of a frame for a CSV file."""
    return [{name: plain(value) for name, value in row.items()} for row in frame.to_dict("records")]


def rounded(value: Any, digits: int | None = None) -> Any:
    """The decimal number nearest to a value; NaN stays NaN."""
    number = float(value)
    return number if math.isnan(number) else round(number, digits)


def number(cell: Any) -> float:
    """A cell of a column that may be empty or not estimated; NaN of such a cell."""
    return math.nan if cell in ("", NOT_ESTIMATED) else float(cell)


def whole(cell: Any) -> Any:
    """A cell of a column of whole numbers that may be empty."""
    return "" if math.isnan(number(cell)) else int(number(cell))


FUNCTIONS: Mapping[str, Any] = {
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "hypot", "sin", "cos", "tan", "radians", "degrees", "pi", "nan", "isnan")},
    "round": rounded, "number": number, "whole": whole, "mean": np.mean, "rms": rms, "block_mean": block_mean, "drift": drift, "np": np, "re": re,
}  # fmt: skip  # next to Python's own


def value_of(text: Any, names: Mapping[str, Any], where: str) -> Any:
    """The value of an expression; what is no text is a value already.

    @raises NameError for a name that is not known, ResultsError for any other fault
    """
    if not isinstance(text, str):
        return text
    try:
        return eval(text, {**FUNCTIONS, **names})  # a study can contain programs, too
    except NameError:
        raise
    except Exception as error:
        known = ", ".join(sorted(map(str, names)))
        raise ResultsError(f"{where}: '{text}' fails ({error}); known names are {known}") from error


def filled(arguments: Any, names: Mapping[str, Any], where: str) -> Any:
    """Arguments of a measure, in which a text that begins with "=" is an expression."""
    if isinstance(arguments, Mapping):
        return {key: filled(value, names, where) for key, value in arguments.items()}
    if isinstance(arguments, list):
        return [filled(value, names, where) for value in arguments]
    if isinstance(arguments, str) and arguments.startswith("="):
        return value_of(arguments[1:].strip(), names, where)
    return arguments
