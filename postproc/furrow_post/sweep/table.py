# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of a sweep: sweep.csv and sweep.h5, with units."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..uncertainty.budget import Budget
from ..csv_table import column_names, in_cells, write_rows
from ..formatting import duration, value_text
from .sweep_curves import CONDITIONS, Figure
from .series import Series, SweepPoint

PART = "part_"  # before the name of a part of the resistance
SET = "set_"  # before the name of a variable that was swept: what the script was given
CSV_HEAD = (
    "# A row per point, packings averaged. SI units; <quantity>_error is one standard error, made of the",
    f"# parts that are known: _error_{', _error_'.join(Budget.NAMES[:5])},",
    f"# _error_{', _error_'.join(Budget.NAMES[5:])}. An empty cell is unknown; a part without a",
    "# column is unknown or zero. unknown: parts of the error of the net traction that are. imposed: quantities that the script sets, which have no error.",
)

Cell = str | float


def table_rows(series: Sequence[Series]) -> list[dict[str, Cell]]:
    """A row for each point; texts and SI numbers, NaN: not known."""
    return [_row(one, point) for one in series for point in one.points]


def _row(series: Series, point: SweepPoint) -> dict[str, Cell]:
    row: dict[str, Cell] = {"label": series.label, "folder": point.name}
    row.update({SET + name: _as_number(value) for name, value in point.values.items()})
    first = point.runs[0]
    row["ground"] = first.ground
    for name in CONDITIONS:
        if math.isfinite(point.number(name)) and name not in point.quantities:
            row[name] = point.number(name)
    for name, value in point.quantities.items():
        row[name], row[f"{name}_error"] = value.mean, value.uncertainty
        row.update({f"{name}_error_{part}": value.parts.part(part) for part in Budget.NAMES})
    row.update(_parts(point))
    row["packings"] = float(len(point.runs))
    row["steady"] = "yes" if point.steady else "no"
    row["unknown"] = " ".join(point.quantities["net_traction_coefficient"].parts.unknown)
    row["imposed"] = " ".join(name for name, value in point.quantities.items() if value.imposed)
    row["cpu_time"] = point.cpu_time
    return row


def _parts(point: SweepPoint) -> dict[str, float]:
    """Parts of the resistance [N], by column."""
    parts = point.parts
    if parts is None:
        return {}
    forces = {"whole": parts.whole, **parts.forces, "not accounted for": parts.unexplained}
    return {PART + name.replace(",", "").replace(" ", "_"): force for name, force in forces.items()}


def _as_number(text: str) -> Cell:
    try:
        return float(text)
    except ValueError:
        return text


def units(series: Sequence[Series]) -> dict[str, str]:
    """Column -> SI unit, of those that have one."""
    found = {"cpu_time": "s"}
    for one in series:
        for point in one.points:
            for name, condition in point.runs[0].conditions.items():
                found.setdefault(name, condition.unit)
            for name, value in point.quantities.items():
                parts = ("", "_error", *(f"_error_{part}" for part in Budget.NAMES))
                found.update({name + part: value.unit for part in parts})
            found.update(dict.fromkeys(_parts(point), "N"))
    return {name: unit for name, unit in found.items() if unit}


def write_table(series: Sequence[Series], csv: Path, hdf5: Path) -> None:
    rows, unit = table_rows(series), units(series)
    names = [name for name in column_names(rows) if not _is_unknown_part(name, rows)]
    rows = [{name: row[name] for name in names if name in row} for row in rows]
    listed = [name for name in names if name in unit and "_error" not in name]
    comments = [*CSV_HEAD, *(f"# {name} [{unit[name]}]" for name in listed)]
    write_rows(csv, [in_cells(row, 8) for row in rows], comments)
    with h5py.File(hdf5, "w") as content:
        content.attrs["unit"] = "SI; errors are one standard error, NaN: not known"
        for name in names:
            _write_column(content, name, [row.get(name, math.nan) for row in rows])
            content[name].attrs["unit"] = unit.get(name, "")


def _is_unknown_part(name: str, rows: Sequence[dict[str, Cell]]) -> bool:
    """True where a column is a part of an error that is unknown or zero at every point."""
    cells = [row.get(name, math.nan) for row in rows]
    return "_error_" in name and all(isinstance(cell, float) and not cell > 0 for cell in cells)


def _write_column(content: Any, name: str, values: Sequence[Cell]) -> None:
    if any(isinstance(value, str) for value in values):
        texts = ["" if isinstance(v, float) and math.isnan(v) else str(v) for v in values]
        content[name] = np.array(texts, dtype=h5py.string_dtype())
    else:
        content[name] = np.array(values, dtype=np.float64)


def shown_rows(figure: Figure) -> tuple[list[str], list[list[str]]]:
    """Head and rows of the table for people: what the figure shows."""
    head = ["", figure.x.label, *(curve.y.label for curve in figure.curves), "steady", "CPU time"]
    rows = []
    for line in figure.lines:
        for x, point in zip(line.x, line.points):
            place = figure.categories[int(x)] if figure.categories else f"{figure.x.scale * x:.4g}"
            cells = [line.label, place]
            for curve in figure.curves:
                value = point.quantities.get(curve.y.key)
                scale = curve.y.scale
                text = value_text(scale * value.mean, scale * value.uncertainty) if value else ""
                cells.append(text if value and math.isfinite(value.mean) else "")
            rows.append([*cells, "yes" if point.steady else "no", duration(point.cpu_time)])
    return head, rows
