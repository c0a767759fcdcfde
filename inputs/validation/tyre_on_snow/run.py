#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tyre of [Shoop2001] and a rigid wheel of its outline on 20 cm of fresh snow: sinkage,
resistance and the tyre's deflection; and how much of the tread lifts, on a plane and on snow. See
README.md.

Makes the runs that are missing and writes results.csv and lift.csv. --check makes the tread on the
plane alone, in seconds.
"""

import math
import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

from furrow_post.analyse.statistics import block_mean, drift
from furrow_post.arrays import Booleans, Floats
from furrow_post.csv_table import read_matrix, read_numbers
from furrow_post.errors import ResultsError
from furrow_post.read.results import Results
from furrow_post.read.terrain import read_terrain_fields
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

# The rigid wheel has the unloaded tyre's outline: radius, section width, shoulders of the
# sidewalls' bulge; mass and inertia of rim and tread
RIGID = "wheel/rigid diameter 0.6966 width 0.256 shoulder 0.0495 mass 36.7 inertia 1.81 segments 72"
TYRE_FILE = PROJECT / "inputs/tyres/p235_75r15.yaml"
TYRE = f"tyre/darnell file {TYRE_FILE} mesh 4 36 half yes mass 30 inertia 1 pressure"
ACROSS, AROUND = 3, 36  # nodes of half a tread of this mesh
MATERIALS = PROJECT / "inputs" / "materials"
SNOW = MATERIALS / "fresh_snow_shoop.yaml"
SECTION_HEIGHT = 0.164  # [m] [Shoop2001] Table 6; the report's percentages are of it
TIME_STEP = 2e-4  # [s], of roll.lig
WINDOW = 0.7  # [m] of travel before the end, over which is averaged: a third of a turn


def rigid(name: str, what: str, **variables: Value) -> Case:
    given: dict[str, Value] = {
        "material": SNOW,
        "body": RIGID,
        "watch": "f_touch[3]",
        "damping": 10000,
        **variables,
    }
    return script_case(name, HERE / "roll.lig", given, what=what, stage="rigid")


def tyre(name: str, what: str, pressure: int, **variables: Value) -> Case:
    """pressure [kPa]"""
    watch = "f_wheel[1] f_wheel[3]"
    given: dict[str, Value] = {
        "material": SNOW,
        "body": f"{TYRE} {pressure}e3",
        "watch": watch,
        **variables,
    }
    return script_case(name, HERE / "roll.lig", given, what=what, stage="tyre")


STRONG = MATERIALS / "fresh_snow_d_30.yaml"

ROLLED = (
    rigid("rigid_50", "rigid, cells of 5 cm"),
    rigid("rigid_40", "rigid, cells of 4 cm", cell=0.04),
    tyre("tyre_241_50", "241 kPa, cells of 5 cm", 241),
    tyre("tyre_241_40", "241 kPa, cells of 4 cm", 241, cell=0.04),
    tyre("tyre_179_50", "179 kPa, cells of 5 cm", 179),
    tyre("tyre_103_50", "103 kPa, cells of 5 cm", 103),
    rigid("rigid_d30_50", "rigid, d 30 kPa, cells of 5 cm", material=STRONG),
    tyre("tyre_241_d30_50", "241 kPa, d 30 kPa, cells of 5 cm", 241, material=STRONG),
)


# A state that is hard on the tread: little air, much load
LOW_PRESSURE, LOAD = 69, 5000  # [kPa], [N]
HALF_TREAD = 0.0785  # [m] of its width
ACROSS_HALF = 3  # elements across half the tread
NODE_STEP = 2 * math.pi * 0.3475 / 72  # [m] between the tread's nodes along the travel
LOADED = 0.05  # of the inflation: what a place of the contact bears at least that has not lifted

LIFT_PLANE = Case(
    "lift_plane",
    "furrow-tyre",
    (
        TYRE_FILE,
        *("--mesh", 6, 72, "--half"),
        *("--pressure", LOW_PRESSURE, "--load", LOAD, "--folder", FOLDER),
    ),
    what="plane",
    stage="lift",
)
LIFT_SNOW = tuple(
    script_case(
        f"lift_{name}",
        HERE / "press.lig",
        {"material": MATERIALS / f"{name}.yaml", "pressure": f"{LOW_PRESSURE}e3", "load": LOAD},
        what=what,
        stage="lift",
    )
    for name, what in (("field_snow", "field snow"),)
)
CASES = (*ROLLED, LIFT_PLANE, *LIFT_SNOW)


def row_of(case: Case, folder: Path, cpu_time: float) -> dict[str, object]:
    """Means over the last WINDOW of travel; forces with the standard error of eight blocks."""
    results = Results(folder)
    history = results.columns
    last = history["x"] > history["x"][-1] - WINDOW
    load = history["force_z"][last].mean()
    sinkage = history["hub_drop"][last]
    row: dict[str, object] = {
        "case": case.name,
        "what": case.what,
        "user_s": round(cpu_time, 1),
        "sinkage_mm": round(1e3 * sinkage.mean(), 1),
        "sinkage_drift_mm": round(1e3 * drift(sinkage), 1),
        "coefficient": round(-history["force_x"][last].mean() / load, 4),
        "coefficient_error": round(block_mean(-history["force_x"][last] / load)[1], 4),
        "load_N": round(load),
        "slip": round(history["slip"][last].mean(), 3),
        **stress_in_depth(folder, history["x"][-1]),
    }
    if case.stage == "tyre":
        surface = results.surface()
        if surface is None:
            raise ResultsError(f"{results.file}: has no surface of the tyre")
        row.update(deflections(folder, history, last, surface.x))
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
    watch = read_matrix(folder / "watch.txt", 3)
    watched = watch[:, 0] * TIME_STEP > history["time"][last][0]
    lowest = watch[watched, 2].mean()
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


def lines_of_plane(folder: Path) -> Lines:
    """At the nodes of the tread, none where a node does not touch."""
    file = folder / f"{LOW_PRESSURE}kPa_{LOAD}N_pressure.csv"
    nodes = read_numbers(file)
    x, y, pressure = (np.array([n[key] for n in nodes]) for key in ("x_m", "y_m", "pressure_Pa"))
    index, line = np.round(x / NODE_STEP).astype(int), np.round(y / HALF_TREAD * ACROSS_HALF)
    lines = []
    for number in np.unique(line):
        mine = line == number
        places = index[mine] - index[mine].min()
        lines.append(np.zeros(places.max() + 1))
        lines[-1][places] = pressure[mine]
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


def lift_rows(runner: Runner) -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for case in (LIFT_PLANE, *LIFT_SNOW):
        if not (record := runner.record(case)):
            continue
        folder = runner.folder(case)
        lines = lines_of_plane(folder) if case is LIFT_PLANE else lines_of_snow(folder)
        lifted, alternation = unevenness(lines)
        rows.append(
            {
                "run": case.name,
                "what": case.what,
                "user_s": round(record.cpu_time, 1),
                "lifted_share": round(lifted, 4),
                "alternation": round(alternation, 3),
            }
        )
    return rows


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    rows = [
        row_of(case, runner.folder(case), record.cpu_time)
        for case in ROLLED
        if (record := runner.record(case))
    ]
    output.table("results.csv", rows)
    output.table("lift.csv", lift_rows(runner))
    return []


def is_cheap(case: Case) -> bool:
    return case is LIFT_PLANE


if __name__ == "__main__":
    study = Study(Path(__file__), __doc__ or "", CASES, evaluate, checked=is_cheap)
    sys.exit(run_study(study))
