# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of a sweep: sweep.csv and sweep.h5, with units."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..uncertainty.budget import Budget
from ..csv_table import column_names, in_cells, number_or_text, write_rows
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


def _cells(series: Series, point: SweepPoint) -> dict[str, tuple[Cell, str]]:
    """Column -> text or SI number, NaN where it is not known, and its unit."""
    first, quantities = point.runs[0], point.quantities
    cells: dict[str, tuple[Cell, str]] = {"label": (series.label, ""), "folder": (point.name, "")}
    cells |= {SET + name: (number_or_text(value), "") for name, value in point.values.items()}
    cells["ground"] = first.ground, ""
    for name in CONDITIONS:
        if math.isfinite(point.number(name)) and name not in quantities:
            cells[name] = point.number(name), first.conditions[name].unit
    for name, value in quantities.items():
        cells |= {name: (value.mean, value.unit), f"{name}_error": (value.uncertainty, value.unit)}
        cells |= {f"{name}_error_{part}": (value.parts.part(part), value.unit) for part in Budget.NAMES}
    cells["slip_radius"] = first.slip_radius, "m"
    if parts := point.parts:
        forces = {"whole": parts.whole, **parts.forces, "not accounted for": parts.unexplained}
        cells |= {PART + name.replace(",", "").replace(" ", "_"): (force, "N") for name, force in forces.items()}
    cells["packings"] = float(len(point.runs)), ""
    cells["steady"] = "yes" if point.steady else "no", ""
    cells["unknown"] = " ".join(quantities["net_traction_coefficient"].parts.unknown), ""
    cells["imposed"] = " ".join(name for name, value in quantities.items() if value.imposed), ""
    cells["cpu_time"] = point.cpu_time, "s"
    return cells


def write_table(series: Sequence[Series], csv: Path, hdf5: Path) -> None:
    """A row for each point."""
    cells = [_cells(one, point) for one in series for point in one.points]
    unit = {name: unit for row in cells for name, (_, unit) in row.items() if unit}
    rows = [{name: value for name, (value, _) in row.items()} for row in cells]
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
    """Head and rows of the printed table, with the values of the figure."""
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
