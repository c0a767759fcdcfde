#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tyre of [Shoop2001] and a rigid wheel of its outline on 20 cm of fresh snow: sinkage,
resistance and the tyre's deflection. See README.md.

Makes the runs that are missing and writes results.csv.
"""

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
from furrow_post.csv_table import read_matrix
from furrow_post.errors import ResultsError
from furrow_post.read.results import Results
from furrow_post.read.terrain import read_terrain_fields
from furrow_post.study.case import Case, Value
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

CASES = (
    rigid("rigid_50", "rigid, cells of 5 cm"),
    rigid("rigid_40", "rigid, cells of 4 cm", cell=0.04),
    tyre("tyre_241_50", "241 kPa, cells of 5 cm", 241),
    tyre("tyre_241_40", "241 kPa, cells of 4 cm", 241, cell=0.04),
    tyre("tyre_179_50", "179 kPa, cells of 5 cm", 179),
    tyre("tyre_103_50", "103 kPa, cells of 5 cm", 103),
    rigid("rigid_d30_50", "rigid, d 30 kPa, cells of 5 cm", material=STRONG),
    tyre("tyre_241_d30_50", "241 kPa, d 30 kPa, cells of 5 cm", 241, material=STRONG),
)


def row_of(case: Case, folder: Path, cpu_time: float) -> dict[str, object]:
    """Means over the last WINDOW of travel; forces with the standard error of eight blocks."""
    results = Results(folder)
    history = results.columns
    last = history["x"] > history["x"][-1] - WINDOW
    load = history["force_z"][last].mean()
    sinkage = history["sinkage"][last]
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


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    rows = [
        row_of(case, runner.folder(case), record.cpu_time)
        for case in CASES
        if (record := runner.record(case))
    ]
    output.table("results.csv", rows)
    return []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", CASES, evaluate)))
