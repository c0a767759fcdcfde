# SPDX-License-Identifier: GPL-2.0-or-later
"""Histories of wheel runs, aligned so that they can be laid over each other."""

import enum
from typing import NamedTuple

import numpy as np

from ..arrays import Floats
from ..read.wheel_run import WheelRun
from ..uncertainty.statistics import moving_mean


class Stage(enum.IntEnum):
    """Stages of the rig: values of the channel stage."""

    SETTLE = 0
    ACCELERATE = 1
    CRUISE = 2
    BACK = 3


class CruiseHistory(NamedTuple):
    """Histories over the travel since the start of the cruise."""

    distance: Floats  # [m], negative while it accelerates
    hub_drop: Floats  # [m]
    coefficient: Floats  # resistance coefficient, NaN while the ground does not carry the wheel yet


class SettlingCurve(NamedTuple):
    """Curve of load over sinkage while the wheel is lowered onto the ground."""

    hub_drop: Floats  # [m]
    pressure: Floats  # mean over the projected contact [Pa]


def _rows_of_first_pass(stage: Floats) -> int:
    """Rows of the first pass; all rows of a run with one pass."""
    back = np.flatnonzero(stage == Stage.BACK)
    return int(back[0]) if len(back) else len(stage)


def cruise_history(run: WheelRun) -> CruiseHistory:
    """Hub drop and resistance coefficient over travel, the latter smoothed over 0.1 radius.

    Only the first of several passes counts.
    """
    columns = run.results.columns
    stage, x = columns["stage"], columns["x"]
    stage = stage[: _rows_of_first_pass(stage)]
    cruise, moving = np.flatnonzero(stage == Stage.CRUISE), np.flatnonzero(stage >= Stage.ACCELERATE)
    distance = x[moving] - (x[cruise[0]] if len(cruise) else x[-1])
    step = max(np.median(np.diff(distance[-max(len(cruise), 2) :])), 1e-9)
    window = max(int(0.1 * run.radius / step), 1)
    force_x, force_z = (moving_mean(columns[name][moving], window) for name in ("force_x", "force_z"))
    with np.errstate(invalid="ignore", divide="ignore"):
        coefficient = np.where(force_z > 0.2 * run.number("load"), -force_x / force_z, np.nan)
    shift = run.number("datum_shift") if "datum_shift" in run.conditions else 0.0
    return CruiseHistory(distance, columns["hub_drop"][moving] + shift, coefficient)


def settling_curve(run: WheelRun) -> SettlingCurve:
    """Force over the projected contact of a rigid cylinder, 2 b sqrt(2 r z - z^2), against z."""
    columns = run.results.columns
    rows = _rows_of_first_pass(columns["stage"])
    settling, deep_enough = columns["stage"] == Stage.SETTLE, columns["hub_drop"] > 0.02 * run.radius
    chosen = np.flatnonzero((settling & deep_enough)[:rows])
    z, force = columns["hub_drop"][chosen], columns["force_z"][chosen]
    area = 2 * run.number("wheel_width") * np.sqrt(np.maximum(2 * run.radius * z - z * z, 1e-12))
    window = max(len(z) // 60, 1)
    if len(z):
        force = np.convolve(force, np.ones(window) / window, "same")
    return SettlingCurve(z, force / area)
