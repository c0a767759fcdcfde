# SPDX-License-Identifier: GPL-2.0-or-later
"""Training data of a surrogate: the points of one or several sweeps, from their sweep.csv."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..csv_table import read_comments, read_rows
from ..errors import ResultsError
from ..sweep.sweep_files import TABLE
from ..sweep.table import SET

PULL, TORQUE, HUB_DROP = "net_traction_coefficient", "torque_coefficient", "hub_drop"
MOTION_RESISTANCE = "motion_resistance_coefficient"  # T/(W r) - P/W
QUANTITIES = {PULL: "", TORQUE: "", HUB_DROP: "m", MOTION_RESISTANCE: ""}  # name -> unit
RADIUS = "wheel_radius"
CONDITIONS = ("load", "pressure", "depth", "speed", "slip_angle", "camber", "slope")
REMEDY = "make it with 'inputs/run SCENE --sweep NAME=FIRST:LAST ... --samples N'"


@dataclass(frozen=True)
class Training:
    """SI units, degrees; row k of inputs and of each quantity belong to one run."""

    names: tuple[str, ...]  # of the inputs
    units: tuple[str, ...]
    inputs: Floats  # (runs, inputs)
    quantities: dict[str, Floats]
    constants: dict[str, float]  # conditions that no sweep changed, and the radius of the wheel
    left_out: int = 0  # runs without all values


def read_training(sources: Sequence[Path]) -> Training:
    """sources: folders of sweeps, or their tables. @raises ResultsError, OSError"""
    rows: list[dict[str, str]] = []
    units: dict[str, str] = {}
    for source in sources:
        table = source / TABLE if source.is_dir() else source
        if not table.is_file():
            raise ResultsError(f"{source}: has no {TABLE}; {REMEDY}")
        rows += read_rows(table)
        units.update(re.findall(r"^# (\w+) \[(.+)\]$", "\n".join(read_comments(table)), re.M))
    names = _inputs(rows, sources[0])
    found = [[*(_number(row, SET + name) for name in names), *_answers(row)] for row in rows]
    whole = [k for k, values in enumerate(found) if all(map(math.isfinite, values))]
    values = np.array([found[k] for k in whole]).reshape(len(whole), -1)
    if not whole:
        raise ResultsError(f"{sources[0]}: no run has slip, load, pull and torque; {REMEDY}")
    answers = values[:, len(names) :].T
    quantities = dict(zip((PULL, TORQUE, HUB_DROP, RADIUS), answers))
    quantities[MOTION_RESISTANCE] = quantities[TORQUE] - quantities[PULL]
    constants = {RADIUS: float(np.median(quantities.pop(RADIUS)))}
    for name in CONDITIONS:
        of_runs = {_number(rows[k], name) for k in whole}
        if name not in names and len(of_runs) == 1 and math.isfinite(value := of_runs.pop()):
            constants[name] = value
    return Training(
        names,
        tuple(units.get(name, "") for name in names),
        values[:, : len(names)],
        quantities,
        constants,
        len(rows) - len(whole),
    )


def _inputs(rows: Sequence[dict[str, str]], source: Path) -> tuple[str, ...]:
    """Names of the swept numbers. @raises ResultsError"""
    columns = dict.fromkeys(name for row in rows for name in row if name.startswith(SET))
    names = []
    for column in columns:
        texts = {row.get(column, "") for row in rows}
        name = column.removeprefix(SET)
        if "" in texts:
            raise ResultsError(
                f"{source}: not every run sets '{name}'; give sweeps over the same variables"
            )
        if len(texts) == 1:
            continue
        if not all(math.isfinite(_number(row, column)) for row in rows):
            raise ResultsError(
                f"{source}: '{name}' has values that are no numbers; make a surrogate for each of them"
            )
        names.append(name)
    if not names:
        raise ResultsError(f"{source}: no variable of a sweep changes between its runs; {REMEDY}")
    return tuple(names)


def _number(row: dict[str, str], name: str) -> float:
    try:
        return float(row.get(name, ""))
    except ValueError:
        return math.nan


def _answers(row: dict[str, str]) -> list[float]:
    """Pull and torque coefficient, hub drop, radius of the wheel."""
    pull, torque, drop = (_number(row, name) for name in (PULL, TORQUE, HUB_DROP))
    lever = torque * _number(row, "force_z")
    return [pull, torque, drop, _number(row, "drive_torque") / lever if lever else math.nan]
