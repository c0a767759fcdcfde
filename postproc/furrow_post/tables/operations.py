# SPDX-License-Identifier: GPL-2.0-or-later
"""Operations on tables that a study.yaml names: groups, packings, size series, comparisons.

Each takes a frame and its arguments, and gives another frame. Expressions see the columns by name.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import combinations
from typing import Any

import numpy as np
import pandas

from ..analyse import evaluations
from ..uncertainty.grid_convergence import grid_convergence
from ..uncertainty.statistics import rms
from ..errors import ResultsError
from .expressions import value_of
from .frames import Row

Columns = Mapping[str, Any]  # name of a new column -> expression, None: the column of that name
Tables = Mapping[str, pandas.DataFrame]
Operation = Callable[..., pandas.DataFrame]


def _listed(names: str | Sequence[str]) -> list[str]:
    return [names] if isinstance(names, str) else list(names)


def _names(row: Mapping[str, Any], constants: Mapping[str, Any]) -> dict[str, Any]:
    return {**constants, **{str(name): value for name, value in row.items()}}


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


def where(frame: pandas.DataFrame, tables: Tables, constants: Row, condition: str) -> pandas.DataFrame:
    """Rows that meet a condition."""
    kept = [bool(value_of(condition, _names(row, constants), "where")) for row in frame.to_dict("records")]
    return frame[kept]


def derive(frame: pandas.DataFrame, tables: Tables, constants: Row, **columns: Any) -> pandas.DataFrame:
    """Further columns, row by row."""
    made = [cells(_names(row, constants), columns, "derive") for row in frame.to_dict("records")]
    new = pandas.DataFrame(made, index=frame.index, columns=list(columns))
    return pandas.concat([frame.drop(columns=[c for c in columns if c in frame]), new], axis=1)


def select(frame: pandas.DataFrame, tables: Tables, constants: Row, **columns: Any) -> pandas.DataFrame:
    """These columns alone, row by row."""
    made = [cells(_names(row, constants), columns, "columns") for row in frame.to_dict("records")]
    return pandas.DataFrame(made, columns=list(columns), dtype=object)


def groups(frame: pandas.DataFrame, by: str | Sequence[str]) -> list[tuple[Row, pandas.DataFrame]]:
    """Groups in the order in which the rows bring them: their common cells, and their rows."""
    names = _listed(by)
    if not names:
        return [({}, frame)] if len(frame) else []
    found = frame.groupby(names if len(names) > 1 else names[0], sort=False, dropna=False)
    return [(dict(zip(names, key if isinstance(key, tuple) else (key,))), rows) for key, rows in found]


def summary(
    frame: pandas.DataFrame, tables: Tables, constants: Row, columns: Columns, by: str | Sequence[str] = ()
) -> pandas.DataFrame:
    """A row for each group. In expressions a column is an array; count is the number of rows."""
    made = []
    for key, rows in groups(frame, by):
        arrays = {str(name): rows[name].to_numpy() for name in rows}
        names = {**constants, **arrays, **key, "count": len(rows)}
        made.append({**key, **cells(names, columns, "summary")})
    return pandas.DataFrame(made)


def transform(
    frame: pandas.DataFrame, tables: Tables, constants: Row, columns: Columns, by: str | Sequence[str] = ()
) -> pandas.DataFrame:
    """Further columns, the same in all rows of a group; expressions as in summary."""
    parts = []
    for key, rows in groups(frame, by):
        names = {**constants, **{str(name): rows[name].to_numpy() for name in rows}, **key, "count": len(rows)}
        parts.append(rows.assign(**cells(names, columns, "transform")))
    return pandas.concat(parts).sort_index() if parts else frame


def pair_scatter(
    frame: pandas.DataFrame, tables: Tables, constants: Row, by: str | Sequence[str], values: Columns
) -> pandas.DataFrame:
    """Further columns, values: NAME -> column: the standard deviation of one run, pooled over all pairs of runs of one
    group. NaN where no group has two."""
    for name, column in values.items():
        pairs = [one - other for _, rows in groups(frame, by) for one, other in combinations(rows[column], 2)]
        frame = frame.assign(**{name: rms(pairs) / math.sqrt(2.0) if pairs else np.nan})
    return frame


def packings(
    frame: pandas.DataFrame, tables: Tables, constants: Row, by: str | Sequence[str], value: str = "value"
) -> pandas.DataFrame:
    """Mean and scatter of one packing (standard deviation) of each group; packings: their number."""
    made = []
    for key, rows in groups(frame, by):
        numbers = rows[value].to_numpy(float)
        scatter = float(numbers.std(ddof=1)) if len(numbers) > 1 else np.nan
        made.append({**key, "packings": len(numbers), "mean": float(numbers.mean()), "scatter": scatter})
    return pandas.DataFrame(made)


def finest(
    frame: pandas.DataFrame, tables: Tables, constants: Row, by: str | Sequence[str], size: str, value: str = "value"
) -> pandas.DataFrame:
    """Mean of the packings of the finest grains of each group. Its error has their scatter and the step from the next
    coarser grains."""
    made = []
    for key, rows in groups(frame, by):
        sizes: dict[str, list[float]] = {}
        for one, number in zip(rows[size], rows[value]):
            sizes.setdefault(str(one), []).append(float(number))
        mean, error = evaluations.fine_grains(sizes)
        made.append({**key, "mean": mean, "error": error})
    return pandas.DataFrame(made)


def against(
    frame: pandas.DataFrame, tables: Tables, constants: Row, base: str, by: str | Sequence[str] = ()
) -> pandas.DataFrame:
    """Columns base_NAME with the row of the same group that meets the condition `base`. Groups without one are left
    out."""
    found = []
    for _, rows in groups(frame, by):
        first = where(rows, tables, constants, base)
        if len(first):
            row = first.iloc[0]
            found.append(rows.assign(**{f"base_{name}": [row[name]] * len(rows) for name in rows}))
    return pandas.concat(found).sort_index() if found else frame.iloc[:0]


def size_series(
    frame: pandas.DataFrame,
    tables: Tables,
    constants: Row,
    size: str,
    values: str | Mapping[str, str | None],
    by: str | Sequence[str] = (),
    least: int = 3,
) -> pandas.DataFrame:
    """Each quantity of each group extrapolated to zero size of cells or grains, a row for each.

    values: names of the quantities, or name -> column of its standard errors. Groups of fewer sizes than least are left
    out. Columns: quantity, value, error, order, used_order, extrapolated, reason, runs, finest.
    """
    quantities = values if isinstance(values, Mapping) else dict.fromkeys(_listed(values))
    made = []
    for key, rows in groups(frame, by):
        for quantity, error in quantities.items():
            known = rows[pandas.notna(rows[quantity])]
            if known[size].nunique() < least:
                continue
            errors = [float(one) for one in known[error]] if error else None
            series = grid_convergence(list(map(float, known[size])), list(map(float, known[quantity])), errors)
            made.append(
                {
                    **key,
                    "quantity": quantity,
                    "value": series.value,
                    "error": series.error,
                    "order": series.order,
                    "used_order": series.used_order,
                    "extrapolated": series.extrapolated,
                    "reason": series.reason,
                    "runs": len(known),
                    "finest": series.sizes[0],
                    "at": series,
                }
            )
    return pandas.DataFrame(made)


def off_curve(
    frame: pandas.DataFrame,
    tables: Tables,
    constants: Row,
    x: str,
    by: str,
    base: str,
    values: Sequence[str],
) -> pandas.DataFrame:
    """How far points of other groups are from a chain of straight lines, the rows that meet the condition `base`. A
    column NAME has its standard error in NAME_error. Columns: by, quantity, difference, difference_error; points beyond
    the ends of the chain are left out."""
    chain = where(frame, tables, constants, base).sort_values(x, kind="stable")
    others = frame.drop(chain.index)
    knots = chain.to_dict("records")
    made = []
    for key, rows in groups(others, by):
        for quantity in values:
            for point in rows.to_dict("records"):
                pairs = [(a, b) for a, b in zip(knots, knots[1:]) if a[x] <= point[x] <= b[x]]
                if not pairs:
                    continue
                first, second = pairs[0]
                share = (point[x] - first[x]) / (second[x] - first[x])
                slope = (second[quantity] - first[quantity]) / (second[x] - first[x])
                expected = (1.0 - share) * first[quantity] + share * second[quantity]
                error = math.hypot(
                    (1.0 - share) * first[f"{quantity}_error"],
                    share * second[f"{quantity}_error"],
                    slope * point[f"{x}_error"],
                    point[f"{quantity}_error"],
                )
                made.append({**key, "quantity": quantity, "difference": point[quantity] - expected, "difference_error": error})
    return pandas.DataFrame(made)


def cost_ratio(
    frame: pandas.DataFrame, tables: Tables, constants: Row, name: str, pairs: Sequence[tuple[str, str]]
) -> pandas.DataFrame:
    """Core seconds of the first run of each pair over those of the second, mean and standard error in one row."""
    return pandas.DataFrame(evaluations.cost_ratio(name, dict(zip(frame["run"], frame["user_s"])), pairs))


def join(
    frame: pandas.DataFrame,
    tables: Tables,
    constants: Row,
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
    other = tables[table].assign(**{name: np.nan for name in expect if name not in tables[table]})
    if not len(other):
        return frame.iloc[:0] if how == "inner" else frame.assign(**{f"{prefix}{name}": np.nan for name in expect})
    if prefix:
        kept = {own for own, their in pairs.items() if own == their}
        other = other.rename(columns={name: f"{prefix}{name}" for name in other if name not in kept})
    right = [their if own == their or not prefix else f"{prefix}{their}" for own, their in pairs.items()]
    rows = frame.assign(row_of_frame=range(len(frame)))
    found = rows.merge(other, how=how, left_on=list(pairs), right_on=right, suffixes=("", "_other"))
    return found.sort_values("row_of_frame", kind="stable").drop(columns="row_of_frame")


def stack(
    frame: pandas.DataFrame, tables: Tables, constants: Row, keep: str | Sequence[str], **columns: Sequence[str]
) -> pandas.DataFrame:
    """Columns below each other, row by row: for k = 1, 2, ... a row with the cells of keep and of the k-th column of
    each list. A text that is the name of no column stands for itself."""
    count = len(next(iter(columns.values())))
    made = [
        {**{name: row[name] for name in _listed(keep)}, **{new: row.get(old[k], old[k]) for new, old in columns.items()}}
        for row in frame.to_dict("records")
        for k in range(count)
    ]
    return pandas.DataFrame(made)


def pivot(
    frame: pandas.DataFrame,
    tables: Tables,
    constants: Row,
    keep: str | Sequence[str],
    columns: str,
    value: Any = "value",
    expect: Sequence[str] = (),
) -> pandas.DataFrame:
    """A row for each combination of the cells of keep, with a column for each cell of columns. Several values have
    columns CELL_VALUE; of one the column is CELL. expect: columns that are there in any case."""
    made = []
    for key, rows in groups(frame, keep):
        row = dict(key)
        for one in rows.to_dict("records"):
            for name in _listed(value):
                row[str(one[columns]) + ("" if isinstance(value, str) else f"_{name}")] = one[name]
        made.append({**row, **{name: np.nan for name in expect if name not in row}})
    return pandas.DataFrame(made)


def sort(frame: pandas.DataFrame, tables: Tables, constants: Row, by: str | Sequence[str], falling: bool = False) -> pandas.DataFrame:
    return frame.sort_values(_listed(by), ascending=not falling, kind="stable")


def append(frame: pandas.DataFrame, tables: Tables, constants: Row, table: str) -> pandas.DataFrame:
    """Rows of another table below."""
    return pandas.concat([frame, tables[table]], ignore_index=True)


def transpose(frame: pandas.DataFrame, tables: Tables, constants: Row, key: str) -> pandas.DataFrame:
    """A row per column and a column per row, which its cell of key names."""
    quantities = [name for name in frame if name != key]
    columns = {str(row[key]): [row[name] for name in quantities] for row in frame.to_dict("records")}
    return pandas.DataFrame({"quantity": quantities, **columns}, dtype=object)


_ALL: Sequence[Operation] = (
    where, derive, select, summary, transform, packings, pair_scatter, finest, against, size_series, off_curve, cost_ratio, join, stack, pivot, sort,
    append, transpose,
)  # fmt: skip
OPERATIONS: Mapping[str, Operation] = {str(getattr(one, "__name__")): one for one in _ALL}
