# SPDX-License-Identifier: GPL-2.0-or-later
"""CSV files with a head of comment lines ("# ..."), as all tables of the project have; LIGGGHTS's tables of numbers;
tables for people: aligned text, and Markdown."""

import csv
import io
import math
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from .arrays import Floats
from .errors import ResultsError, content_of

import numpy as np

ENCODING = "utf-8-sig"  # spreadsheets mark UTF-8 by a first character
DECIMAL_COMMA = re.compile(r"^([-+]?\d*),(\d+(?:[eE][-+]?\d+)?)$")
TABLE = "a table is CSV: a head with the names of its columns, then rows of as many cells"


def read_rows(path: Path) -> list[dict[str, str]]:
    """Rows of a table, name of the column -> text; comments are left out. Cells are separated by commas, or by
    semicolons or tabulators with a decimal point or comma.

    @raises OSError; ResultsError where a row has other cells than the head
    """
    with content_of(path, TABLE), open(path, encoding=ENCODING) as file:
        try:
            lines = [line for line in file if line.strip() and not line.startswith("#")]
            separator = next((mark for mark in ";\t" if lines and mark in lines[0]), ",")
            reader = csv.DictReader(lines, delimiter=separator)
            rows = list(reader)
        except csv.Error as error:
            raise ResultsError(f"{path}: {error}; {TABLE}") from error
    for name in rows[0] if rows else ():
        if reader.fieldnames and list(reader.fieldnames).count(name) > 1:
            raise ResultsError(f"{path}: has two columns '{name}'; {TABLE}")
    for number, row in enumerate(rows, 1):
        if None in row or None in row.values():
            raise ResultsError(
                f"{path}: row {number} has {'more' if None in row else 'fewer'} cells than the "
                f"head; {TABLE}"
            )
    if separator != ",":
        rows = [{name: DECIMAL_COMMA.sub(r"\1.\2", text) for name, text in row.items()} for row in rows]
    return rows


def read_comments(path: Path) -> list[str]:
    """The comment lines of a table, with their "#". @raises OSError, ResultsError"""
    with content_of(path, TABLE), open(path, encoding=ENCODING) as file:
        return [line.rstrip("\n") for line in file if line.startswith("#")]


def read_numbers(path: Path) -> list[dict[str, float]]:
    """Rows of a table of numbers; an empty cell is NaN. @raises ResultsError for any other text"""
    try:
        return [
            {name: float(text) if text else math.nan for name, text in row.items()}
            for row in read_rows(path)
        ]
    except ValueError as error:
        raise ResultsError(f"{path}: {error}; {TABLE}") from error


def number_or_text(text: str) -> float | str:
    """A cell that may be either."""
    try:
        return float(text)
    except ValueError:
        return text


def read_columns(path: Path) -> dict[str, Floats]:
    """Columns of a table of numbers. @raises ResultsError"""
    rows = read_numbers(path)
    return {name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else ())}


def read_matrix(path: Path, columns: int, head: int = 0) -> Floats:
    """(rows, columns or more) of a file of numbers and blanks below so many lines.

    It is what LIGGGHTS writes (fix ave/time, dumps). @raises ResultsError
    """
    remedy = "repeat the run"
    if not path.is_file():
        raise ResultsError(f"{path}: no such file; {remedy}")
    with content_of(path, remedy), warnings.catch_warnings(action="ignore"):
        rows: Floats = np.loadtxt(path, skiprows=head, ndmin=2, encoding="utf-8")
    if len(rows) == 0 or rows.shape[1] < columns:
        raise ResultsError(f"{path}: has no rows of {columns} numbers; {remedy}")
    return rows


def column_names(rows: Iterable[Mapping[str, Any]]) -> list[str]:
    """Names of all columns in the order in which the rows bring them."""
    return list(dict.fromkeys(name for row in rows for name in row))


def in_cells(row: Mapping[str, Any], digits: int) -> dict[str, Any]:
    """Row with floats rounded to a number of digits; NaN becomes an empty cell."""
    return {
        name: ("" if math.isnan(value) else f"{value:.{digits}g}") if isinstance(value, float) else value
        for name, value in row.items()
    }


def write_rows(path: Path, rows: Sequence[Mapping[str, Any]], comments: Sequence[str] = ()) -> None:
    """Writes the text of rows_text()."""
    path.write_text(rows_text(rows, comments), encoding="utf-8", newline="")


def rows_text(rows: Sequence[Mapping[str, Any]], comments: Sequence[str] = ()) -> str:
    """Text of rows that may lack columns of others; comments go above, each with its "#"."""
    file = io.StringIO()
    file.writelines(line.rstrip() + "\n" for line in comments)
    writer = csv.DictWriter(file, column_names(rows), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return file.getvalue()


def aligned(rows: Sequence[Mapping[str, Any]]) -> str:
    """Rows under the names of their columns, numbers with six digits; empty where one is not."""

    def text(value: Any) -> str:
        return f"{value:.6g}" if isinstance(value, float) else str(value)

    names = column_names(rows)
    cells = [[text(row.get(name, "")) for name in names] for row in rows]
    return "\n".join(in_columns([names, *cells]))


def in_columns(rows: Sequence[Sequence[str]]) -> list[str]:
    """Lines of cells, each column as wide as its widest cell."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows]


def markdown(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """Lines of a table."""

    def line(cells: Sequence[str]) -> str:
        return "| " + " | ".join(cells) + " |"

    return [line(head), "|---" * len(head) + "|", *(line(row) for row in rows)]
