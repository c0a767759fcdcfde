# SPDX-License-Identifier: GPL-2.0-or-later
"""Training data of a surrogate: the points of one or several sweeps, from their sweep.csv."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd

from ..arrays import Floats
from ..csv_table import read_comments, read_rows
from ..errors import ResultsError
from ..sweep.sweep_files import TABLE
from ..sweep.table import SET

PULL, TORQUE, HUB_DROP = "net_traction_coefficient", "torque_coefficient", "hub_drop"
MOTION_RESISTANCE = "motion_resistance_coefficient"  # T/(W r) - P/W
QUANTITIES = {PULL: "", TORQUE: "", HUB_DROP: "m", MOTION_RESISTANCE: ""}  # name -> unit
RADIUS = "wheel_radius"  # of slip and torque_coefficient [m]
SLIP_RADIUS = "slip_radius"  # column of a sweep; without it slip is by the radius of the torque coefficient
FORCES = ("force_z", "drive_torque")
CONDITIONS = ("load", "pressure", "depth", "speed", "slip_angle", "camber", "slope")
MOST_DIFFERENCE = 0.02  # relative, of conditions that two tables share
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
    tables, units = [], dict[str, str]()
    for source in sources:
        table = source / TABLE if source.is_dir() else source
        if not table.is_file():
            raise ResultsError(f"{source}: has no {TABLE}; {REMEDY}")
        tables.append(pd.DataFrame(read_rows(table)))
        units.update(re.findall(r"^# (\w+) \[(.+)\]$", "\n".join(read_comments(table)), re.M))
    texts = pd.concat(tables, ignore_index=True)
    runs = texts.applymap(_number).reindex(columns=dict.fromkeys([*texts.columns, *QUANTITIES, *CONDITIONS, *FORCES, SLIP_RADIUS]))
    names = _inputs(texts, runs, sources[0])
    lever = runs[TORQUE] * runs[FORCES[0]]
    of_torque = runs[FORCES[1]] / lever.where(lever != 0)
    runs[RADIUS] = runs[SLIP_RADIUS].fillna(of_torque)
    runs[TORQUE] *= of_torque / runs[RADIUS]
    runs[MOTION_RESISTANCE] = runs[TORQUE] - runs[PULL]
    inputs = [SET + name for name in names]
    whole = runs[np.isfinite(runs[[*inputs, *QUANTITIES, RADIUS]]).all(axis="columns")]
    if whole.empty:
        raise ResultsError(f"{sources[0]}: no run has slip, load, pull and torque; {REMEDY}")
    shared = {name: whole[name].iloc[0] for name in CONDITIONS if name not in names and whole[name].nunique(dropna=False) == 1}
    return Training(
        names,
        tuple(units.get(name, "") for name in names),
        whole[inputs].to_numpy(),
        {name: whole[name].to_numpy() for name in QUANTITIES},
        {RADIUS: float(whole[RADIUS].median()), **{name: float(value) for name, value in shared.items() if math.isfinite(value)}},
        len(runs) - len(whole),
    )


def require_alike(fast: Training, better: Training) -> Training:
    """The better runs with inputs in the order of the fast ones. @raises ResultsError where both do not fit"""
    if set(fast.names) != set(better.names):
        raise ResultsError(f"the runs vary {', '.join(fast.names)}, the better runs {', '.join(better.names)}; vary the same variables")
    for name in fast.constants.keys() & better.constants.keys():
        ours, theirs = fast.constants[name], better.constants[name]
        if not math.isclose(ours, theirs, rel_tol=MOST_DIFFERENCE, abs_tol=1e-9):
            raise ResultsError(f"{name} is {ours:g} in the runs and {theirs:g} in the better runs; give both the same")
    inputs = better.inputs[:, [better.names.index(name) for name in fast.names]]
    for name, values, known in zip(fast.names, inputs.T, fast.inputs.T):
        if values.min() < known.min() or values.max() > known.max():
            raise ResultsError(
                f"{name}: the better runs reach from {values.min():g} to {values.max():g}, the runs from {known.min():g} to "
                f"{known.max():g}; add runs to the sweep, or leave out better ones"
            )
    return replace(better, names=fast.names, units=fast.units, inputs=inputs)


def _inputs(texts: pd.DataFrame, runs: pd.DataFrame, source: Path) -> tuple[str, ...]:
    """Names of the swept numbers. @raises ResultsError"""
    swept = [column for column in texts if column.startswith(SET)]
    for column in swept:
        name = column.removeprefix(SET)
        if (texts[column].fillna("") == "").any():
            raise ResultsError(f"{source}: not every run sets '{name}'; give sweeps over the same variables")
        if texts[column].nunique() > 1 and not np.isfinite(runs[column]).all():
            raise ResultsError(f"{source}: '{name}' has values that are no numbers; make a surrogate for each of them")
    names = tuple(column.removeprefix(SET) for column in swept if texts[column].nunique() > 1)
    if not names:
        raise ResultsError(f"{source}: no variable of a sweep changes between its runs; {REMEDY}")
    return names


def _number(text: object) -> float:
    try:
        return float(str(text))
    except ValueError:
        return math.nan
