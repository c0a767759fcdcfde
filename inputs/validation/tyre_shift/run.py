#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""How far a tyre's tread moves as a whole against the rim, on a plane and on snow: the least
deflection that its load allows. See README.md.

Makes the runs that are missing and writes results.csv and modes.csv, the tyres' lowest natural
modes. --check makes those at rest on a plane alone, in seconds.
"""

import csv
import math
import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix
from furrow_post.errors import ResultsError, content_of
from furrow_post.read.results import Results
from furrow_post.read.vtk import read_vtp
from furrow_post.study.case import FOLDER, Case, Value
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

TYRES = PROJECT / "inputs/tyres"
MATERIALS = PROJECT / "inputs/materials"
LOAD, PRESSURE = 6227, 241  # [N], [kPa]
AROUND = 36  # sections of both tyres
# Of p235_75r15.yaml: belts of radius 0.3475 m and 15.7 cm of width with 19.6 kg/m2
TREAD_MASS = 19.6 * 2 * math.pi * 0.3475 * 0.157  # [kg]
WINDOW = 0.7  # [m] of travel before the end
SHAKING = "shaking in the wheel's plane"
KINDS = {  # of natural modes: waves around the tread, whether it moves along the axle
    ("0", False): "turning",
    ("0", True): "along the axle",
    ("1", False): SHAKING,
    ("1", True): "tilting",
}
AGAIN = "make the run again: remove its folder"
TIME_STEP = 2e-4  # [s] of roll.lig


def plane(name: str, what: str, file: str, *mesh: Value) -> Case:
    """At rest on a rigid plane."""
    arguments = (
        TYRES / f"{file}.yaml",
        *mesh,
        "--pressure",
        PRESSURE,
        "--load",
        LOAD,
        "--modes",
        8,
        "--no-plot",
        "--folder",
        FOLDER,
    )
    return Case(name, "furrow-tyre", arguments, what=what, stage="plane")


def snow(name: str, what: str, tyre: str, radius: float, material: str) -> Case:
    """Over 20 cm of snow, as in tyre_on_snow."""
    variables: dict[str, Value] = {
        "material": MATERIALS / f"{material}.yaml",
        "body": f"{tyre} pressure {PRESSURE}e3 half yes mass 30 inertia 1",
        "watch": "f_wheel[1] f_wheel[3]",
        "radius": radius,
    }
    return script_case(
        name, HERE.parent / "tyre_on_snow/roll.lig", variables, what=what, stage="snow"
    )


DARNELL = f"tyre/darnell file {TYRES}/p235_75r15.yaml mesh 4 {AROUND}"
BRICK = f"tyre/brick file {TYRES}/p235_75r15_smooth.yaml sections {AROUND}"
CASES = (
    plane("plane", "plane", "p235_75r15", "--mesh", 4, AROUND),
    plane("plane_brick", "plane, tread of rubber", "p235_75r15_smooth", "--sections", AROUND),
    snow("d_30", "snow, d 30 kPa", DARNELL, 0.3483, "fresh_snow_d_30"),
    snow("d_30_brick", "snow, d 30 kPa, tread of rubber", BRICK, 0.3717, "fresh_snow_d_30"),
    snow("d_5", "snow, d 5 kPa", DARNELL, 0.3483, "fresh_snow_shoop"),
)


def shift(tread: Floats, axle: Floats) -> tuple[float, float]:
    """Forward and upward [mm], of the tread as a whole from where it stands round the axle.

    tread: (n, 3) nodes in whole rings, evenly spaced, whose mean is the axle's place without load
    """
    if len(tread) % AROUND:
        raise ResultsError(f"{len(tread)} nodes of the tread are no rings of {AROUND}")
    moved = 1e3 * (tread.mean(axis=0) - axle)
    return float(moved[0]), float(moved[2])


def outside(x: Floats, axle: Floats) -> Floats:
    """Nodes of the tread, of all nodes of a surface (n, 3): within 6 cm of the middle."""
    radius = np.hypot(x[:, 0] - axle[0], x[:, 2] - axle[2])
    tread: Floats = x[(np.abs(x[:, 1]) < 0.06) & (radius > 0.30)]
    return tread


def road_deflection(file: Path) -> float:
    """Of the last state that furrow-tyre printed [mm]. @raises ResultsError"""
    with content_of(file, AGAIN):
        with open(file, encoding="utf-8") as lines:
            return 10 * float(list(csv.DictReader(lines))[-1]["deflection_cm"])


def modes(folder: Path) -> dict[str, float]:
    """Natural frequencies [Hz] of the inflated tyre without load, by how the tread moves."""
    file = folder / f"{PRESSURE}kPa_0N_modes.csv"
    found: dict[str, float] = {}
    with content_of(file, AGAIN):
        with open(file, encoding="utf-8") as lines:
            for mode in csv.DictReader(line for line in lines if not line.startswith("#")):
                kind = KINDS.get((mode["waves"], float(mode["axial"]) > 0.5))
                if kind:
                    found.setdefault(kind, float(mode["frequency_Hz"]))
    return found


def shift_by_mode(folder: Path) -> float:
    """How far the load moves the tread as a whole [mm], from the natural frequency at which it
    shakes in the wheel's plane: one wave around, next to nothing along the axle."""
    return 1e3 * LOAD / (TREAD_MASS * (2 * math.pi * modes(folder)[SHAKING]) ** 2)


def row_of(case: Case, runner: Runner, cpu_time: float) -> dict[str, object]:
    folder = runner.folder(case)
    if is_plane(case):
        deflection = road_deflection(folder / "screen.txt")
        x = read_vtp(folder / f"{PRESSURE}kPa_{LOAD}N.vtp").x
        axle = np.array([0.0, 0.0, -1e-3 * deflection])
        c = 0.0
    else:
        results = Results(folder)
        history, surface = results.columns, results.surface()
        if surface is None:
            raise ResultsError(f"{results.file}: has no surface of the tyre")
        last = history["x"] > history["x"][-1] - WINDOW
        watch = read_matrix(folder / "watch.txt", 3)
        watched = watch[:, 0] * TIME_STEP > history["time"][last][0]
        deflection = 1e3 * float(watch[watched, 2].mean())
        x = surface.x
        axle = np.array([history["x"][-1], 0.0, history["z"][-1]])
        c = float(-history["force_x"][last].sum() / history["force_z"][last].sum())
    forward, upward = shift(outside(x, axle), axle)
    row: dict[str, object] = {
        "run": case.name,
        "what": case.what,
        "user_s": round(cpu_time, 1),
        "deflection_mm": round(deflection, 1),
        "shift_up_mm": round(upward, 2),
        "shift_back_mm": round(-forward, 2),
        "flattening_mm": round(deflection - upward, 1),
        "resistance": round(c, 3),
    }
    if case.name == "plane":
        row["shift_by_mode_mm"] = round(shift_by_mode(folder), 2)
    return row


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    rows = [
        row_of(case, runner, record.cpu_time) for case in CASES if (record := runner.record(case))
    ]
    output.table("results.csv", rows)
    frequencies = [
        {"run": case.name, "mode": kind, "frequency_Hz": round(frequency, 1)}
        for case in CASES
        if is_plane(case) and runner.record(case)
        for kind, frequency in modes(runner.folder(case)).items()
    ]
    output.table("modes.csv", frequencies)
    return []


def is_plane(case: Case) -> bool:
    return case.stage == "plane"


if __name__ == "__main__":
    study = Study(Path(__file__), __doc__ or "", CASES, evaluate, checked=is_plane)
    sys.exit(run_study(study))
