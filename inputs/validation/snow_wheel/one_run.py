# SPDX-License-Identifier: GPL-2.0-or-later
"""What is made of one run: a row of numbers."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

import cases

from furrow_post.analyse.rut import bow_wave, rut_densities, rut_depth, share_left
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix
from furrow_post.read.results import Results
from furrow_post.read.terrain import Outline, Terrain, read_terrain_history
from furrow_post.study.case import Case
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner

LOAD = cases.LOAD_MASS * 9.80665  # [N]
TIME_STEP = 2e-4  # [s] of wheel.lig

Row = dict[str, Any]  # of a table


def row_of(case: Case, folder: Path, record: Record) -> Row:
    """Means over the last WINDOW of travel with their changes between its halves; densities.

    Energies are those of both halves of the model per metre, over the load. A failed run has its
    error alone.
    """
    row: Row = {
        "run": case.name.rpartition("/")[2],
        "user_s": round(record.cpu_time, 1),
        "error": record.error,
        "remap_interval": int(record.variable("remap_interval")),
    }
    if record.error:
        return row
    wheel, terrain = Results(folder).columns, read_terrain_history(folder)
    contact = read_matrix(folder / "contact.txt", 3)
    x = wheel["x"] - wheel["x"][0]
    end = float(x[-1])
    start, middle = end - cases.WINDOW, end - cases.WINDOW / 2
    value = means(wheel, x, start, end)
    change = 0.5 * np.abs(means(wheel, x, middle, end) - means(wheel, x, start, middle))
    row["sinkage_m"], row["sinkage_change_m"] = round(value[0], 4), round(change[0], 4)
    row["resistance"], row["resistance_change"] = round(value[1], 4), round(change[1], 4)
    row["slip"] = round(value[2], 3)

    def per_metre(time: Floats, energy: Floats) -> float:
        """Of the window, over the load."""
        ends = np.interp(np.interp([start, end], x, wheel["time"]), time, energy)
        return round(float((ends[1] - ends[0]) / cases.WINDOW / LOAD), 4)

    taken = terrain["stored_energy"] + terrain["dissipated_energy"]
    row["snow"] = per_metre(terrain["time"], 2 * taken)
    row["numerical"] = per_metre(terrain["time"], 2 * terrain["numerical_loss"])
    row["friction"] = per_metre(contact[:, 0] * TIME_STEP, contact[:, 1])
    snow = Terrain.read(folder)
    body = Outline(folder, snow)
    densities = rut_densities(snow, body)
    row["density_under"] = round(densities.under)
    row["density_shoulder"] = round(densities.shoulder)
    row["density_behind"] = round(densities.in_rut)
    row["rut_depth_m"] = round(rut_depth(snow, body), 3)
    row["mass_left"] = round(share_left(snow, body), 3)
    row["bow_wave_m"] = round(bow_wave(snow, body), 3)
    row["particles"] = int(record.facts["particles"])
    row["penetration_mm"] = round(1000 * record.facts["deepest_penetration"], 1)
    return row


def means(wheel: Mapping[str, Floats], x: Floats, low: float, high: float) -> Floats:
    """(3) Sinkage [m], resistance coefficient, slip over a part of the travel [m]."""
    part = (x >= low) & (x <= high)
    resistance = -wheel["force_x"][part].sum() / wheel["force_z"][part].sum()
    return np.array([wheel["hub_drop"][part].mean(), resistance, wheel["slip"][part].mean()])


class Found:
    """Rows of the runs that are there, evaluated once."""

    def __init__(self, runner: Runner) -> None:
        self.runner, self.cases = runner, cases.all_cases()
        self.rows: dict[str, Row] = {}

    def __call__(self, name: str) -> Row:
        """Empty where the run is not there."""
        case = self.cases[name]
        if name not in self.rows:
            record = self.runner.ended(case)
            self.rows[name] = row_of(case, self.runner.folder(case), record) if record else {}
        return self.rows[name]
