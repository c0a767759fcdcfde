# SPDX-License-Identifier: GPL-2.0-or-later
"""How far the tread moves as a whole against the rim, and the lowest natural modes."""

import csv
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from furrow_post.analyse.evaluations import AGAIN, tyre_states, watched_mean
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError, content_of
from furrow_post.read.results import Results
from furrow_post.read.vtk import read_vtp
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

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
TIME_STEP = 2e-4  # [s] of roll.lig


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


def row_of(run: Run) -> dict[str, object]:
    folder = run.folder
    if run.case.stage == "plane":
        deflection = 10 * tyre_states(folder, 2)[-1]["deflection_cm"]
        x = read_vtp(folder / f"{PRESSURE}kPa_{LOAD}N.vtp").x
        axle = np.array([0.0, 0.0, -1e-3 * deflection])
        c = 0.0
    else:
        results = Results(folder)
        history, surface = results.columns, results.surface()
        if surface is None:
            raise ResultsError(f"{results.file}: has no surface of the tyre")
        last = history["x"] > history["x"][-1] - WINDOW
        since = float(history["time"][last][0])
        deflection = 1e3 * watched_mean(folder, 2, 3, since, TIME_STEP)
        x = surface.x
        axle = np.array([history["x"][-1], 0.0, history["z"][-1]])
        c = float(-history["force_x"][last].sum() / history["force_z"][last].sum())
    forward, upward = shift(outside(x, axle), axle)
    row: dict[str, object] = {
        "run": run.name,
        "what": run.what,
        "user_s": run.seconds,
        "deflection_mm": round(deflection, 1),
        "shift_up_mm": round(upward, 2),
        "shift_back_mm": round(-forward, 2),
        "flattening_mm": round(deflection - upward, 1),
        "resistance": round(c, 3),
    }
    if run.name == "plane":
        row["shift_by_mode_mm"] = round(shift_by_mode(folder), 2)
    return row


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    output.table("results.csv", [row_of(run) for run in runs.done("plane", "snow")])
    frequencies = [
        {"run": run.name, "mode": kind, "frequency_Hz": round(frequency, 1)}
        for run in runs.done("plane", "finer")
        for kind, frequency in modes(run.folder).items()
    ]
    output.table("modes.csv", frequencies)
    return []
