# SPDX-License-Identifier: GPL-2.0-or-later
"""Measured points for the figure of a sweep: a CSV file with columns of known names.

A column is named as in sweep.csv, in SI units, or with its unit behind: hub_drop, hub_drop_mm, slip,
load_kN, net_traction_coefficient. The unit may be in brackets: "hub_drop [mm]", "slip (%)". <name>_error is its standard deviation in the same unit; label tells
several tests in one file apart. A table of another sweep can be read too.
"""

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..csv_table import read_rows
from ..errors import ResultsError
from .sweep_curves import EFFICIENCY, HUB_DROP, PULL, RESISTANCE, SIDEWAYS, TORQUE, Axis, Figure

UNITS = {
    "": 1.0,
    "_m": 1.0,
    "_cm": 1e-2,
    "_mm": 1e-3,
    "_N": 1.0,
    "_kN": 1e3,
    "_Nm": 1.0,
    "_Pa": 1.0,
    "_kPa": 1e3,
    "_ms": 1.0,
    "_kgm3": 1.0,
    "_deg": 1.0,
    "_percent": 1e-2,
}
IN_BRACKETS = re.compile(r"(.+?)[\s_]*[\[(](.+)[\])]")
ALSO_CALLED = {  # in inputs/validation/*/reference.csv, and by earlier versions
    "resistance_coefficient": ("resistance",),
    "hub_drop": ("sinkage",),
    "net_traction_coefficient": ("drawbar_coefficient",),
}
ERROR = "_error"


@dataclass(frozen=True)
class MeasuredPoints:
    """Points of one test, SI."""

    label: str
    x: tuple[float, ...]
    columns: Mapping[str, tuple[tuple[float, float], ...]]  # quantity -> value, error at each x

    def values(self, y: Axis) -> list[tuple[float, float, float]]:
        """x, value and standard deviation (NaN: not known)."""
        pairs = self.columns.get(y.key, ())
        return [(x, *pair) for x, pair in zip(self.x, pairs) if math.isfinite(pair[0])]


def require_measured(path: Path) -> None:
    """@raises ResultsError where a file is no table with a column of a quantity that curves show"""
    rows = _rows(path)
    names = [axis.key for axis in (HUB_DROP, RESISTANCE, PULL, TORQUE, EFFICIENCY, *SIDEWAYS)]
    if not rows or not any(_column(rows[0], name) for name in names):
        raise ResultsError(
            f"{path}: is no table of measured points; it needs rows, and a column of {', '.join(names)}; "
            f"a unit may stand behind the name, e.g. hub_drop_mm"
        )


def read_measured_points(path: Path, label: str | None, figure: Figure) -> list[MeasuredPoints]:
    """@raises ResultsError where a column of the axes is missing or is no number; OSError"""
    rows = _rows(path)
    if not rows:
        raise ResultsError(f"{path}: has no rows")
    x = _column(rows[0], figure.x.key)
    wanted = {curve.y.key: _column(rows[0], curve.y.key) for curve in figure.curves}
    found = {key: column for key, column in wanted.items() if column}
    if x is None or not found:
        raise ResultsError(
            f"{path}: needs a column {figure.x.key} and one of {', '.join(wanted)}; a unit may "
            f"stand behind the name, e.g. hub_drop_mm: {', '.join(filter(None, UNITS))}"
        )
    groups: dict[str, list[dict[str, str]]] = {}
    for row in rows:
        groups.setdefault(row.get("label", "") or label or path.stem, []).append(row)
    try:
        return [
            MeasuredPoints(
                name,
                tuple(_number(row, *x) for row in group),
                {key: tuple(_pair(row, *column) for row in group) for key, column in found.items()},
            )
            for name, group in groups.items()
        ]
    except ValueError as error:
        raise ResultsError(f"{path}: {error}; write a number, or leave the cell empty") from error


def _rows(path: Path) -> list[dict[str, str]]:
    """Rows with names as UNITS has them: "slip (%)" is slip_percent."""
    return [{_plain(name): text for name, text in row.items()} for row in read_rows(path)]


def _plain(name: str) -> str:
    found = IN_BRACKETS.fullmatch(name.strip())
    if not found:
        return name.strip()
    unit = found[2].strip().replace("%", "percent").replace(" ", "")
    return f"{found[1]}_{unit}" if f"_{unit}" in UNITS else name.strip()


def _column(row: Mapping[str, str], key: str) -> tuple[str, float] | None:
    """Name of the column of a quantity, and its unit in SI."""
    for name in (key, *ALSO_CALLED.get(key, ())):
        for ending, unit in UNITS.items():
            if name + ending in row:
                return name + ending, unit
    return None


def _number(row: Mapping[str, str], name: str, unit: float) -> float:
    """NaN for an empty cell. @raises ValueError"""
    return unit * float(row[name]) if row.get(name) else math.nan


def _pair(row: Mapping[str, str], name: str, unit: float) -> tuple[float, float]:
    return _number(row, name, unit), _number(row, name + ERROR, unit)
