# SPDX-License-Identifier: GPL-2.0-or-later
"""Operations on tables that a study.yaml names: groups, packings, size series, comparisons.

Each takes a frame, what its expressions know, and its arguments, and gives another frame. Expressions see the columns
by name.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
import pandas

from ..analyse import evaluations
from ..uncertainty.grid_convergence import grid_convergence
from ..laws.response import Response
from ..uncertainty.statistics import rms
from ..errors import ResultsError
from .frames import Row, value_of

Columns = Mapping[str, Any]  # name of a new column -> expression, None: the column of that name
Names = str | Sequence[str]  # of one column or several
Operation = Callable[..., pandas.DataFrame]


@dataclass(frozen=True)
class Known:
    """Data next to the frame of an operation. tables: others by file name; constants: names in expressions."""

    tables: Mapping[str, pandas.DataFrame]
    constants: Row


def _listed(names: Names) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def cells(names: Mapping[str, Any], columns: Columns, where: str) -> Row:
    """One row of new columns. @raises ResultsError for a name that is not known"""
    row: Row = {}
    for column, text in columns.items():
        if not isinstance(column, str):
            raise ResultsError(f"{where}: {column} is no name; put it in quotes")
        try:
            row[column] = value_of(column if text is None else text, {**row, **names}, f"{where}, column {column}")
        except NameError as error:
            known = ", ".join(sorted(map(str, names)))
            raise ResultsError(f"{where}, column {column}: {error}; known names are {known}") from error
    return row


def of_rows(frame: pandas.DataFrame, known: Known, columns: Columns, what: str) -> list[Row]:
    """Cells of new columns, row by row."""
    rows = ({str(name): value for name, value in row.items()} for row in frame.to_dict("records"))
    return [cells({**known.constants, **row}, columns, what) for row in rows]


def where(frame: pandas.DataFrame, known: Known, condition: str) -> pandas.DataFrame:
    """Rows that meet a condition."""
    return frame[[bool(row["kept"]) for row in of_rows(frame, known, {"kept": condition}, "where")]]


def derive(frame: pandas.DataFrame, known: Known, /, **columns: Any) -> pandas.DataFrame:
    """Table with further columns, computed row by row."""
    new = pandas.DataFrame(of_rows(frame, known, columns, "derive"), index=frame.index, columns=list(columns))
    return pandas.concat([frame.drop(columns=[c for c in columns if c in frame]), new], axis=1)


def select(frame: pandas.DataFrame, known: Known, /, **columns: Any) -> pandas.DataFrame:
    """Rows with the chosen columns."""
    return pandas.DataFrame(of_rows(frame, known, columns, "columns"), columns=list(columns), dtype=object)


def groups(frame: pandas.DataFrame, by: Names) -> list[tuple[Row, pandas.DataFrame]]:
    """Groups in the order in which the rows bring them: their common cells, and their rows."""
    names = _listed(by)
    if not names:
        return [({}, frame)] if len(frame) else []
    found = frame.groupby(names if len(names) > 1 else names[0], sort=False, dropna=False)
    return [(dict(zip(names, key if isinstance(key, tuple) else (key,))), rows) for key, rows in found]


def of_groups(
    frame: pandas.DataFrame, known: Known, columns: Columns, by: Names, what: str
) -> Iterator[tuple[Row, pandas.DataFrame, Row]]:
    """Groups with their new cells. In expressions a column is an array; count is the number of rows."""
    for key, rows in groups(frame, by):
        yield key, rows, cells({**known.constants, **arrays(rows), **key, "count": len(rows)}, columns, what)


def arrays(frame: pandas.DataFrame) -> Row:
    """Column -> its cells as an array."""
    return {str(name): frame[name].to_numpy() for name in frame}


def summary(frame: pandas.DataFrame, known: Known, columns: Columns, by: Names = ()) -> pandas.DataFrame:
    """A row for each group; expressions as in of_groups."""
    return pandas.DataFrame([{**key, **row} for key, _, row in of_groups(frame, known, columns, by, "summary")])


def transform(frame: pandas.DataFrame, known: Known, columns: Columns, by: Names = ()) -> pandas.DataFrame:
    """Further columns, the same in all rows of a group; expressions as in of_groups."""
    parts = [rows.assign(**row) for _, rows, row in of_groups(frame, known, columns, by, "transform")]
    return pandas.concat(parts).sort_index() if parts else frame


def pair_scatter(frame: pandas.DataFrame, known: Known, by: Names, values: Columns) -> pandas.DataFrame:
    """Further columns, values: NAME -> column: the standard deviation of one run, pooled over all pairs of runs of one
    group. NaN where no group has two."""
    for name, column in values.items():
        pairs = [one - other for _, rows in groups(frame, by) for one, other in combinations(rows[column], 2)]
        frame = frame.assign(**{name: rms(pairs) / math.sqrt(2.0) if pairs else np.nan})
    return frame


def packings(frame: pandas.DataFrame, known: Known, by: Names, value: str = "value") -> pandas.DataFrame:
    """Mean and scatter of one packing (standard deviation) of each group; packings: their number."""
    made = []
    for key, rows in groups(frame, by):
        numbers = rows[value].to_numpy(float)
        scatter = numbers.std(ddof=1) if len(numbers) > 1 else np.nan
        made.append({**key, "packings": len(numbers), "mean": numbers.mean(), "scatter": scatter})
    return pandas.DataFrame(made)


def finest(frame: pandas.DataFrame, known: Known, by: Names, size: str, value: str = "value") -> pandas.DataFrame:
    """Mean of the packings of the finest grains of each group. Its error has their scatter and the step from the next
    coarser grains."""
    made = []
    for key, rows in groups(frame, by):
        sizes = {str(one): list(map(float, numbers)) for one, numbers in rows.groupby(size, sort=False)[value]}
        mean, error = evaluations.fine_grains(sizes)
        made.append({**key, "mean": mean, "error": error})
    return pandas.DataFrame(made)


def against(frame: pandas.DataFrame, known: Known, base: str, by: Names = ()) -> pandas.DataFrame:
    """Columns base_NAME with the row of the same group that meets the condition `base`. Groups without one are left
    out."""
    found = []
    for _, rows in groups(frame, by):
        first = where(rows, known, base).head(1)
        if len(first):
            found.append(rows.assign(**{f"base_{name}": [*first[name]] * len(rows) for name in rows}))
    return pandas.concat(found).sort_index() if found else frame.iloc[:0]


def size_series(
    frame: pandas.DataFrame, known: Known, size: str, values: Names | Columns, by: Names = (), least: int = 3
) -> pandas.DataFrame:
    """Each quantity of each group extrapolated to zero size of cells or grains, a row for each.

    values: names of the quantities, or name -> column of its standard errors. Groups of fewer sizes than least are left
    out. Columns: quantity, value, error, order, used_order, extrapolated, reason, runs, finest, and at, the series.
    """
    quantities = values if isinstance(values, Mapping) else dict.fromkeys(_listed(values))
    copied = ("value", "error", "order", "used_order", "extrapolated", "reason")
    made = []
    for key, rows in groups(frame, by):
        for quantity, error in quantities.items():
            there = rows[pandas.notna(rows[quantity])]
            if there[size].nunique() >= least:
                columns = [list(map(float, there[name])) for name in (size, quantity, *([error] if error else []))]
                series = grid_convergence(*columns)
                found = {name: getattr(series, name) for name in copied}
                found |= {"runs": len(there), "finest": series.sizes[0], "at": series}
                made.append({**key, "quantity": quantity, **found})
    return pandas.DataFrame(made)


def off_curve(
    frame: pandas.DataFrame, known: Known, x: str, by: str, base: str, values: Sequence[str]
) -> pandas.DataFrame:
    """How far points of other groups are from a chain of straight lines, the rows that meet the condition `base`. A
    column NAME has its standard error in NAME_error. Columns: by, quantity, difference, difference_error; points beyond
    the ends of the chain are left out."""
    chain = where(frame, known, base).sort_values(x, kind="stable")
    if len(chain) < 2:
        return pandas.DataFrame([])
    points = frame.drop(chain.index)
    points = points[points[x].between(chain[x].min(), chain[x].max())]
    made = []
    for key, rows in groups(points, by):
        piece = np.clip(np.searchsorted(chain[x], rows[x]) - 1, 0, len(chain) - 2)  # its line begins there
        first, second = (chain.iloc[place].set_index(rows.index) for place in (piece, piece + 1))
        share = (rows[x] - first[x]) / (second[x] - first[x])
        for quantity in values:
            error = f"{quantity}_error"
            slope = (second[quantity] - first[quantity]) / (second[x] - first[x])
            expected = (1.0 - share) * first[quantity] + share * second[quantity]
            parts = ((1.0 - share) * first[error], share * second[error], slope * rows[f"{x}_error"], rows[error])
            errors = [math.hypot(*of_point) for of_point in zip(*parts)]
            for difference, one in zip(rows[quantity] - expected, errors):
                made.append({**key, "quantity": quantity, "difference": difference, "difference_error": one})
    return pandas.DataFrame(made)


def cost_ratio(
    frame: pandas.DataFrame, known: Known, name: str, pairs: Sequence[tuple[str, str]]
) -> pandas.DataFrame:
    """Core seconds of the first run of each pair over those of the second, mean and standard error in one row."""
    return pandas.DataFrame(evaluations.cost_ratio(name, dict(zip(frame["run"], frame["user_s"])), pairs))


def join(
    frame: pandas.DataFrame,
    known: Known,
    table: str,
    keys: Any,
    how: str = "inner",
    prefix: str = "",
    expect: Sequence[str] = (),
) -> pandas.DataFrame:
    """Columns of another table in rows with the same cells of keys: columns, or own column -> that of the other table;
    prefix: of the other table's columns, except keys of one name. how: inner or left (all rows); expect: columns that
    the other table may lack."""
    pairs = dict(keys) if isinstance(keys, Mapping) else {name: name for name in _listed(keys)}
    other = known.tables[table]
    other = other.assign(**{name: np.nan for name in expect if name not in other})
    if not len(other):
        return frame.iloc[:0] if how == "inner" else frame.assign(**{f"{prefix}{name}": np.nan for name in expect})
    if prefix:
        kept = {own for own, their in pairs.items() if own == their}
        other = other.rename(columns={name: f"{prefix}{name}" for name in other if name not in kept})
    right = [their if own == their or not prefix else f"{prefix}{their}" for own, their in pairs.items()]
    rows = frame.assign(row_of_frame=range(len(frame)))
    found = rows.merge(other, how=how, left_on=list(pairs), right_on=right, suffixes=("", "_other"))
    return found.sort_values("row_of_frame", kind="stable").drop(columns="row_of_frame")


def stack(frame: pandas.DataFrame, known: Known, /, keep: Names, **columns: Sequence[str]) -> pandas.DataFrame:
    """Columns below each other, row by row: for k = 1, 2, ... a row with the cells of keep and of the k-th column of
    each list. A text that is the name of no column stands for itself."""
    made = [
        {**{name: row[name] for name in _listed(keep)}, **{new: row.get(one, one) for new, one in zip(columns, kth)}}
        for row in frame.to_dict("records")
        for kth in zip(*columns.values(), strict=True)
    ]
    return pandas.DataFrame(made)


def pivot(
    frame: pandas.DataFrame, known: Known, keep: Names, columns: str, value: Any = "value", expect: Sequence[str] = ()
) -> pandas.DataFrame:
    """A row for each combination of the cells of keep, with a column for each cell of columns. Several values have
    columns CELL_VALUE; of one the column is CELL. expect: columns that are there in any case."""
    made = []
    for row, rows in groups(frame, keep):
        for one in rows.to_dict("records"):
            for name in _listed(value):
                row[str(one[columns]) + ("" if isinstance(value, str) else f"_{name}")] = one[name]
        made.append({**row, **{name: np.nan for name in expect if name not in row}})
    return pandas.DataFrame(made)


def sort(frame: pandas.DataFrame, known: Known, by: Names, falling: bool = False) -> pandas.DataFrame:
    return frame.sort_values(_listed(by), ascending=not falling, kind="stable")


def append(frame: pandas.DataFrame, known: Known, table: str) -> pandas.DataFrame:
    """Table with the rows of another table below."""
    return pandas.concat([frame, known.tables[table]], ignore_index=True)


def transpose(frame: pandas.DataFrame, known: Known, key: str) -> pandas.DataFrame:
    """A row per column and a column per row, which its cell of key names."""
    quantities = [name for name in frame if name != key]
    columns = {str(row[key]): [row[name] for name in quantities] for row in frame.to_dict("records")}
    return pandas.DataFrame({"quantity": quantities, **columns}, dtype=object)


def identify(
    frame: pandas.DataFrame,
    known: Known,
    runs: Sequence[str],
    readings: Mapping[str, Any],
    choices: Mapping[str, str],
    goals: Mapping[str, float],
    place: str,
) -> pandas.DataFrame:
    """The parameter of a material that measured rows ask for, and what it predicts of the other rows.

    A row for each reading and each choice of measured rows whose places its runs reach (laws/response.py).

    runs: tables with a row for each run; readings: name -> values (of the parameter), places, runs (names by value and
    place), columns (quantity -> column of a run that is read as such), models (value -> model of the frame's columns
    MODEL_COLUMN that was run with it); choices: words -> condition of the rows that are seen; goals: quantity -> goal of
    its rms; place: column of the places. A quantity that the frame has no column of is a constant. Columns: choice,
    reading, count, value, low, high, used (value of the nearest model), QUANTITY_rms and others_QUANTITY_rms.
    """
    made_runs = pandas.concat([known.tables[name] for name in runs])
    if not len(made_runs):
        return frame.iloc[:0]
    made_runs = made_runs.drop_duplicates("run").set_index("run")
    made: list[Row] = []
    for reading, one in readings.items():
        columns = {**{what: what for what in goals}, **one.get("columns", {})}
        if not all(run in made_runs.index and not made_runs.failure.get(run) for line in one["runs"] for run in line):
            continue
        numbers = {
            what: np.array([[made_runs[column][run] for run in line] for line in one["runs"]])
            for what, column in columns.items()
        }
        response = Response(one["values"], one["places"], numbers)
        for words, condition in choices.items():
            mine = where(frame, known, condition)
            places = list(mine[place])
            if not len(mine) or not response.reaches(places):
                continue
            wanted = {what: list(mine[what]) if what in mine else known.constants[what] for what in goals}
            best = response.identify(places, wanted, goals)
            others, models = frame.drop(mine.index), one["models"]
            used = float(np.clip(best.value, min(models), max(models)))
            row: Row = {"choice": words, "reading": reading, "count": len(mine), "value": best.value, "low": best.low, "high": best.high, "used": used}
            for what in (what for what in goals if what in frame):
                predicted = [np.interp(used, list(models), [r[f"{m}_{columns[what]}"] for m in models.values()]) for r in others.to_dict("records")]
                row |= {f"{what}_rms": best.left[what], f"others_{what}_rms": rms(np.array(predicted) - others[what])}
            made.append(row)
    return pandas.DataFrame(made)


_ALL: Sequence[Operation] = (
    where, derive, select, summary, transform, packings, pair_scatter, finest, against, size_series, off_curve, cost_ratio, join, stack, pivot, sort,
    append, transpose, identify,
)  # fmt: skip
OPERATIONS: Mapping[str, Operation] = {str(getattr(one, "__name__")): one for one in _ALL}
