# SPDX-License-Identifier: GPL-2.0-or-later
"""Sinkage, resistance and the tyre's deflection; and how much of the tread lifts."""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from furrow_post.analyse.evaluations import watched_mean
from furrow_post.analyse.statistics import block_mean, drift
from furrow_post.arrays import Booleans, Floats
from furrow_post.csv_table import read_numbers
from furrow_post.errors import ResultsError
from furrow_post.read.results import Results
from furrow_post.read.terrain import read_terrain_fields
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

ACROSS, AROUND = 3, 36  # nodes of half a tread of this mesh
SECTION_HEIGHT = 0.164  # [m] [Shoop2001] Table 6; the report's percentages are of it
TIME_STEP = 2e-4  # [s], of roll.lig
WINDOW = 0.7  # [m] of travel before the end, over which is averaged: a third of a turn

# Of the runs whose tread lifts
LOW_PRESSURE, LOAD = 69, 5000  # [kPa], [N]
HALF_TREAD = 0.0785  # [m] of its width
ACROSS_HALF = 3  # elements across half the tread
AROUND_TREAD = 72  # elements around
NODE_STEP = 2 * math.pi * 0.3475 / AROUND_TREAD  # [m] between the tread's nodes along the travel
LOADED = 0.05  # of the inflation: what a place of the contact bears at least that has not lifted


def row_of(run: Run) -> dict[str, object]:
    """Means over the last WINDOW of travel; forces with the standard error of eight blocks."""
    results = Results(run.folder)
    history = results.columns
    last = history["x"] > history["x"][-1] - WINDOW
    load = history["force_z"][last].mean()
    sinkage = history["hub_drop"][last]
    row: dict[str, object] = {
        "case": run.name,
        "what": run.what,
        "user_s": run.seconds,
        "sinkage_mm": round(1e3 * sinkage.mean(), 1),
        "sinkage_drift_mm": round(1e3 * drift(sinkage), 1),
        "coefficient": round(-history["force_x"][last].mean() / load, 4),
        "coefficient_error": round(block_mean(-history["force_x"][last] / load)[1], 4),
        "load_N": round(load),
        "slip": round(history["slip"][last].mean(), 3),
        **stress_in_depth(run.folder, history["x"][-1]),
    }
    if run.case.stage == "tyre":
        surface = results.surface()
        if surface is None:
            raise ResultsError(f"{results.file}: has no surface of the tyre")
        row.update(deflections(run.folder, history, last, surface.x))
    return row


def stress_in_depth(folder: Path, axle: float) -> dict[str, object]:
    """Of vertical stress 10 to 15 cm below the undisturbed surface, near the axle at x [m]."""
    terrain = read_terrain_fields(folder)
    x = terrain["x"][:, 0] - axle
    depth = np.abs(terrain["initial_position"][:, 2] - 0.075) < 0.025
    middle = depth & (np.abs(x) < 0.4)
    stress = np.maximum(-terrain["vertical_stress"][middle], 0.0) * terrain["volume"][middle]
    return {
        "stress_front_share": round(stress[x[middle] > 0].sum() / stress.sum(), 3),
        "stress_centroid_mm": round(1e3 * (stress * x[middle]).sum() / stress.sum()),
    }


def deflections(
    folder: Path, history: dict[str, Floats], last: Booleans, nodes: Floats
) -> dict[str, object]:
    """Of the lowest point of the tread in the window, and how far the tread has come in at the end.

    last: rows of the window; nodes (n, 3) [m] of the tyre at the end
    """
    lowest = watched_mean(folder, 2, 3, float(history["time"][last][0]), TIME_STEP)
    # Half a model: column 0 of the tread is the middle
    tread = nodes[: AROUND * ACROSS].reshape(AROUND, ACROSS, 3)[:, 0]
    x, z = tread[:, 0] - history["x"][-1], tread[:, 2] - history["z"][-1]
    radius = np.hypot(x, z)
    angle = np.degrees(np.arctan2(x, -z))  # from straight down, forward
    come_in = np.median(radius[np.abs(angle) > 120]) - radius
    most = np.argmax(come_in)
    return {
        "deflection_mm": round(1e3 * lowest, 2),
        "deflection_share_section": round(lowest / SECTION_HEIGHT, 4),
        "largest_mm": round(1e3 * come_in[most], 2),
        "at_degrees": round(angle[most]),
    }


Lines = Sequence[Floats]  # of the pressures [Pa] in a contact, along the travel, a step apart


def lines_of_plane(folder: Path, finer: int = 1) -> Lines:
    """At the nodes of the tread, none where a node does not touch.

    finer: so many times as many elements both ways; a line then has its nodes at every NODE_STEP,
    from each of its first nodes on.
    """
    file = folder / f"{LOW_PRESSURE}kPa_{LOAD}N_pressure.csv"
    nodes = read_numbers(file)
    x, y, pressure = (np.array([n[key] for n in nodes]) for key in ("x_m", "y_m", "pressure_Pa"))
    step, across = NODE_STEP / finer, finer * ACROSS_HALF
    index, line = np.round(x / step).astype(int), np.round(y / HALF_TREAD * across)
    lines = []
    for number in np.unique(line):
        mine = line == number
        places = index[mine] - index[mine].min()
        whole = np.zeros(places.max() + 1)
        whole[places] = pressure[mine]
        lines += [whole[start::finer] for start in range(finer)]
    return lines


def lines_of_snow(folder: Path) -> Lines:
    """In the uppermost particles below the tread, at steps of the tread's nodes, from the first to
    the last that bears a twentieth of the inflation."""
    terrain = read_terrain_fields(folder)
    initial, pressure = terrain["initial_position"], -terrain["vertical_stress"]
    top = initial[:, 2] > initial[:, 2].max() - 1e-5
    lines = []
    for y in np.unique(np.round(initial[top & (np.abs(initial[:, 1]) < HALF_TREAD), 1], 6)):
        line = np.flatnonzero(top & (np.abs(initial[:, 1] - y) < 1e-5))
        line = line[np.argsort(initial[line, 0])]
        bears = np.flatnonzero(pressure[line] > LOADED * 1e3 * LOW_PRESSURE)
        if len(bears):
            x = terrain["x"][line, 0]
            steps = np.arange(x[bears[0]], x[bears[-1]], NODE_STEP)
            lines.append(np.interp(steps, x, pressure[line]))
    if not lines:
        raise ResultsError(f"{folder}: the tread does not touch the snow")
    return lines


def unevenness(lines: Lines) -> tuple[float, float]:
    """Share of the places in the contact that bear nothing, and how much the pressure alternates:
    mean of |p_i - (p_(i-1) + p_(i+1))/2| over the mean of p."""
    every = np.concatenate(lines)
    lifted = np.count_nonzero(every < LOADED * 1e3 * LOW_PRESSURE) / len(every)
    bends = np.concatenate([line[1:-1] - 0.5 * (line[:-2] + line[2:]) for line in lines])
    return float(lifted), float(np.abs(bends).mean() / every.mean())


def lift_row(run: Run) -> dict[str, object]:
    if run.case.program == "furrow-tyre":
        words = [str(word) for word in run.case.arguments]
        lines = lines_of_plane(run.folder, int(words[words.index("--mesh") + 2]) // AROUND_TREAD)
    else:
        lines = lines_of_snow(run.folder)
    lifted, alternation = unevenness(lines)
    return {
        "run": run.name,
        "what": run.what,
        "user_s": run.seconds,
        "lifted_share": round(lifted, 4),
        "alternation": round(alternation, 3),
    }


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    output.table("results.csv", [row_of(run) for run in runs.done("rigid", "tyre")])
    output.table("lift.csv", [lift_row(run) for run in runs.done("lift")])
    return []
