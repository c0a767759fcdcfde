# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of tests without a wheel: plates, cones, cells of grains, paths of a material point."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..analyse.evaluations import last_piece_of, path_states, plate_curve, pressure_near, whole_plate_curve
from ..uncertainty.statistics import rms
from ..csv_table import read_columns
from ..laboratory.evaluation import evaluate, reference_error
from ..read.laboratory import LaboratoryTest, cell_curve, read_oedometer_reference
from ..run.executor import Run
from ..soil import fits, instruments
from ..study.runs import Runs
from .frames import Row, read_frame


def plate(run: Run, whole: bool = True) -> Row:
    """Columns of curve.txt: sinkage [m], load [N], pressure [Pa]. whole: an error where it has no rows"""
    curve = whole_plate_curve(run.folder) if whole else plate_curve(run.folder)
    return {"sinkage": curve[:, 1], "load": curve[:, 2], "pressure": curve[:, 3]}


def smooth_plate(run: Run, width: float) -> Row:
    """Columns of plate() as means over a width of sinkage [m]."""
    curve = whole_plate_curve(run.folder)
    bins = (curve[:, 1] / width).astype(int)
    means = np.array([curve[bins == k].mean(axis=0) for k in np.unique(bins)])
    return {"sinkage": means[:, 1], "load": means[:, 2], "pressure": means[:, 3]}


SURFACES = np.arange(0.0, 0.601, 0.025)  # of the grain diameter: from the level of the mass to the highest grains


def smooth_force(run: Run, points: int = 11) -> Row:
    """sinkage [mm] and force [N], smoothed over so many rows of curve.txt."""
    curve, ones = whole_plate_curve(run.folder), np.ones(points) / points
    return {"sinkage": 1000 * curve[:, 1], "force": np.convolve(np.pad(curve[:, 2], points // 2, "edge"), ones, "valid")}


def plate_calibration(runs: Runs, candidates: Sequence[str], sizes: Sequence[int], measured: str) -> list[Row]:
    """A row for each candidate of grains whose plates plate_CANDIDATE_SIZE were pressed. surface [mm] above the level of
    the bed's mass, from which sinkage is counted, has the least rms of ln(computed/measured force): best. plain: that
    without a surface; by_size: rms of each plate; run: the smallest plate; plates: all. measured: table with kind,
    size_mm, sinkage_mm, force_N."""
    tests = [row for row in read_frame(Path(measured)).to_dict("records") if row["kind"] == "plate"]
    rows: list[Row] = []
    for candidate in candidates:
        plates = {size: run for size in sizes if (run := runs.one(f"plate_{candidate}_{size}"))}
        if not plates:
            continue
        curves = {size: smooth_force(run) for size, run in plates.items()}
        run = plates[min(plates)]

        def off(surface: float, size: int) -> list[float]:
            c = curves[size]
            mine = [test for test in tests if test["size_mm"] == size]
            return [float(np.log(np.interp(t["sinkage_mm"], c["sinkage"] + surface, c["force"]) / t["force_N"])) for t in mine]

        def error(surface: float) -> float:
            return rms([one for size in curves for one in off(surface, size)])

        surface = float(min(1000 * run.number("diameter") * SURFACES, key=error))
        by_size = {size: rms(off(surface, size)) for size in curves}
        found = {"candidate": candidate, "surface": surface, "best": error(surface), "plain": error(0.0)}
        rows.append({**found, "by_size": by_size, "run": run, "plates": list(plates.values())})
    return rows


def plate_pressure(run: Run, sinkages: Sequence[float], near: float) -> list[Row]:
    """A row for each sinkage [m]: the mean pressure [Pa] around it; near: [m] to both sides."""
    curve = whole_plate_curve(run.folder)
    return [{"sinkage": one, "pressure": pressure_near(curve, one, near)} for one in sinkages]


def cone_resistance(run: Run, depths: Sequence[float], near: float) -> Row:
    """resistance: pressures [Pa] on the base of a cone at depths [m], of a straight line through each window."""
    curve, found = whole_plate_curve(run.folder), []
    for depth in depths:
        chosen = np.abs(curve[:, 1] - depth) < near
        found.append(float(np.polyval(np.polyfit(curve[chosen, 1] - depth, curve[chosen, 3], 1), 0.0)))
    return {"resistance": found}


def cone_index(run: Run, size: float) -> Row:
    """index: mean pressure on a cone, whose base is so wide [m], down to this depth of the base [Pa]."""
    curve = instruments.cone_curve(instruments.read_curve(run.folder), size).down_to(size)
    return {"index": fits.cone_index(curve).index.value}


def columns(run: Run, file: str) -> Row:
    """Columns of a CSV file that the run wrote, by their names."""
    return dict(read_columns(run.folder / file))


def path(run: Run, steps: int, parts: int = 1) -> Row:
    """states: of a path of furrow-point at the ends of its parts, of so many steps each; end: the last one."""
    states = path_states(run.folder, steps, parts)
    return {"states": states, "end": states[-1]}


def piece(run: Run) -> Row:
    """piece: columns of the last piece of a path of furrow-point, with the state in which it begins."""
    return {"piece": last_piece_of(run.folder)}


def laboratory(run: Run, quantities: Sequence[str] = (), reference: str = "") -> Row:
    """Quantities of a test of inputs/laboratory by name, NaN for those named that it did not reach. reference: table of
    an oedometer, whose errors come too."""
    test = LaboratoryTest(run.folder)
    found = evaluate(test)
    if reference:
        found += reference_error(test, read_oedometer_reference(Path(reference)))
    return {**dict.fromkeys(quantities, np.nan), **{quantity.name: quantity.value for quantity in found}}


def cell(run: Run) -> Row:
    """strain (n, 3), stress (n, 3) [Pa], density (n) [kg/m3] of a cell of grains."""
    strain, stress, density = cell_curve(LaboratoryTest(run.folder).curve())
    return {"strain": strain, "stress": stress, "density": density}
