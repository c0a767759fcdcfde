# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of runs with a wheel or tyre on a rig: parts of the history, steady means, what a watched column has."""

from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np

from ..analyse.evaluations import steady_columns, watched_mean
from ..arrays import Booleans
from ..csv_table import read_matrix
from ..read.results import Results
from ..run.summary import Summary
from ..read.terrain import read_terrain_history
from ..read.wheel_run import read_wheel_run
from ..run.executor import Run
from ..sweep.series import quantities as quantities_of
from .frames import Row


def last_part(history: dict[str, np.ndarray], metres: float, rest: float = 0.0) -> Booleans:  # type: ignore[type-arg]
    """Rows of the last part of the travel [m]; where the wheel travels less and rest [s] is given, of the last time."""
    x, time = history["x"], history["time"]
    if rest and not x[-1] - x[0] > metres:
        still: Booleans = time > time[-1] - rest
        return still
    last: Booleans = x > x[-1] - metres
    return last


def travel(run: Run, metres: float, rest: float = 0.0) -> Row:
    """h.NAME: rows of a channel over the last part of the travel [m]; whole.NAME: all of its rows."""
    history = Results(run.folder).columns
    last = last_part(history, metres, rest)
    return {
        "h": SimpleNamespace(**{name: values[last] for name, values in history.items()}),
        "whole": SimpleNamespace(**history),
    }


def steady(run: Run, metres: float) -> Row:
    """Sinkage, resistance, slip: means over the last part of the travel [m], and half the change between its halves."""
    return dict(steady_columns(Results(run.folder).columns, metres))


def passes(run: Run, metres: float, count: int) -> list[Row]:
    """Row of each pass in one rut, over the last part of its cruise, with the number of the pass."""
    wheel = Results(run.folder).columns
    found: list[Row] = []
    for number in range(1, count + 1):
        cruise = (wheel["pass"] == number) & (wheel["stage"] == 2)
        mine = {name: wheel[name][cruise] for name in ("x", "hub_drop", "slip", "force_x", "force_z")}
        found.append({"number": number, **steady_columns(mine, metres)})
    return found


def watched(run: Run, metres: float, step: float, column: int = 2, columns: int = 3) -> Row:
    """watched: mean of a column of watch.txt over the last part of the travel [m]; step: of the run [s]."""
    history = Results(run.folder).columns
    since = float(history["time"][last_part(history, metres)][0])
    return {"watched": watched_mean(run.folder, column, columns, since, step)}


def watched_share(run: Run, metres: float) -> Row:
    """watched: mean of the second column of watch.txt over the last part of the travel [m]; first: its first value."""
    time = (history := Results(run.folder).columns)["time"]
    watch = read_matrix(run.folder / "watch.txt", 2)
    since = (watch[:, 0] - watch[0, 0]) / (watch[-1, 0] - watch[0, 0])
    start = (time[last_part(history, metres)][0] - time[0]) / (time[-1] - time[0])
    return {"watched": watch[since > start, 1].mean(), "first": watch[0, 1]}


def energies(run: Run) -> Row:
    """energy.NAME: last value of each energy of the ground [J]."""
    return {"energy": SimpleNamespace(**{k: float(v[-1]) for k, v in read_terrain_history(run.folder).items()})}


def work_per_metre(run: Run, metres: float, load: float, step: float) -> Row:
    """Work that ground, grid and contact take of a half model over the last part of the travel [m], per metre and over
    the load [N]; step: of the run [s]."""
    wheel, ground = Results(run.folder).columns, read_terrain_history(run.folder)
    contact = read_matrix(run.folder / "contact.txt", 3)
    x = wheel["x"] - wheel["x"][0]
    end = float(x[-1])

    def per_metre(time: np.ndarray, energy: np.ndarray) -> float:  # type: ignore[type-arg]
        ends = np.interp(np.interp([end - metres, end], x, wheel["time"]), time, energy)
        return float((ends[1] - ends[0]) / metres / load)

    taken = ground["stored_energy"] + ground["dissipated_energy"]
    return {
        "ground_work": per_metre(ground["time"], 2 * taken),
        "numerical_work": per_metre(ground["time"], 2 * ground["numerical_loss"]),
        "friction_work": per_metre(contact[:, 0] * step, contact[:, 1]),
    }


def summary(run: Run, quantities: Sequence[str]) -> Row:
    """Steady means of summary.json; NaN of what the run did not reach."""
    content = Summary(run.folder)
    steady = {name: content.quantity(name) for name in quantities}
    return {name: value.mean if value else np.nan for name, value in steady.items()}


def sweep_point(run: Run, quantities: Sequence[str]) -> Row:
    """NAME, NAME_error: steady quantities as a sweep has them; steady: whether hub drop, resistance and slip are."""
    wheel = read_wheel_run(run.folder)
    found = quantities_of((wheel,), {})
    row: Row = {"steady": all(found[name].steady for name in ("hub_drop", "resistance_coefficient", "slip"))}
    for name in quantities:
        row |= {name: found[name].mean, f"{name}_error": found[name].parts.time}
    return {**row, "cpu_time": wheel.cpu_time}
