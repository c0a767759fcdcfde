#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Identifies the beginning of the field snow's compaction curve, three stresses, on the calibration rows with the tyre.

The fitter of laws (furrow_post/laws/fitter.py) sees the twelve calibration rows only: sinkage and resistance, over
the goals, and, weakly, the density under the wheel. Runs are made at three depths; rows between them are interpolated.
Every run is kept. Each trial is printed and goes to identified.csv next to this file.
"""

import math
import sys
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

import furrow_post  # first: reports which of the next ones are missing

import numpy as np

from furrow_post.laws.compressed_snow import cam_clay_material
from furrow_post.laws.fitter import Parameter, Search, fit
from furrow_post.uncertainty.statistics import rms
from furrow_post.arguments import at_least, path, positive
from furrow_post.arrays import Floats
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, command, option
from furrow_post.csv_table import read_numbers
from furrow_post.run.case import Case
from furrow_post.run.executor import Executor
from furrow_post.run.tools import Tools
from furrow_post.study.definition import cases_of, evaluation_of
from furrow_post.study.study_files import Output
from furrow_post.tables.ground_measures import rut
from furrow_post.tables.wheel_measures import steady

SNOW: Any = evaluation_of(HERE)
Make = Callable[[Case], Mapping[str, float]]
DEPTHS = (0.18, 0.20, 0.22)  # [m]
GOAL, DENSITY, DENSITY_SCALE = {"sinkage_m": 0.012, "resistance": 0.031}, 510.0, 50.0  # rms over rows; [kg/m3] under the wheel
# Physical range: above what half a metre of snow weighs, below the stress at 525 kg/m3 [CRREL95-7]
LOWEST, HIGHEST = 1e3, 210e3  # [Pa]
SEARCHED = ("stress_380", "stress_450", "stress_490")  # [Pa]
SEARCH = Search(step=0.2, central=False, ftol=1e-8, xtol=1e-8, scale=1.0)  # moves residuals by ten times the runs' scatter


def field_snow(density: float, beginning: tuple[float, ...] = SNOW.STRESSES[1:4], title: str = "Field snow", slope: float = 3.3) -> str:
    """A material file. beginning: axial stresses [Pa] from 380 kg/m3 on; slope: M of Cam clay (3.3: K0 0.12)."""
    pairs = [*zip(SNOW.DENSITIES, SNOW.STRESSES)]
    curve = [pairs[0], *zip(map(float, SNOW.DENSITIES[1:]), beginning), *(pair for pair in pairs if pair[0] >= 525)]
    return cam_clay_material(title, density, slope, 0.1, curve, "{type: linear, E: 13.79e6, nu: 0.3}")


def case_of(stresses: tuple[float, ...], depth: float) -> Case:
    """The tyre on 220 kg/m3 of this depth [m], with a compaction curve that begins so."""
    base = next(case for case in cases_of(HERE) if case.name == "row_220_20cm")
    name = f"identify/{'_'.join(f'{stress / 1e3:.4g}' for stress in stresses)}_{100 * depth:.0f}cm"
    text = field_snow(220.0, stresses, "field snow of 220 kg/m3")
    variables: dict[str, Any] = {**base.variables, "depth": depth, "cell": round(depth / round(depth / 0.04), 6)}
    return replace(base, name=name, stage="identify", files={"material.yaml": text}, variables=variables)


def identify(start: tuple[float, ...], make: Make, iterations: int) -> list[dict[str, Any]]:
    """Trials as rows of identified.csv. make: quantities of a run, which starts unless it is stored."""
    rows = [row for row in read_numbers(HERE / "reference.csv") if row["density_kgm3"] == 220 and 0.18 <= row["depth_m"] <= 0.22]
    depths, trials = [row["depth_m"] for row in rows], list[dict[str, Any]]()

    def residuals(values: Floats) -> Floats:
        rising = np.maximum.accumulate(np.maximum(values, LOWEST * np.array([1.0, 1.01, 1.03])))
        stresses = tuple(float(f"{stress:.4g}") for stress in rising * np.array([1.0, 1.0 + 1e-9, 1.0 + 2e-9]))
        found = [make(case_of(stresses, depth)) for depth in DEPTHS]
        density = float(np.mean([run["density_under"] for run in found]))
        trial: dict[str, Any] = {"trial": len(trials), **dict(zip(SEARCHED, stresses))}
        parts = [np.array([(density - DENSITY) / DENSITY_SCALE])]
        for what, goal in GOAL.items():
            wrong = np.interp(depths, DEPTHS, [run[what] for run in found]) - np.array([row[what] for row in rows])
            trial |= {f"{what}_rms": round(rms(wrong), 4), f"{what}_mean": round(float(wrong.mean()), 4)}
            parts.append(wrong / goal / math.sqrt(len(rows)))
        each: Floats = np.concatenate(parts)
        trials.append({**trial, "density_under": round(density), "sum_of_squares": round(float(each @ each), 3)})
        print("  ".join(f"{name} {value}" for name, value in trials[-1].items()), flush=True)
        return each

    fit([Parameter(name, "Pa", one, LOWEST, HIGHEST) for name, one in zip(SEARCHED, start)], residuals, replace(SEARCH, evaluations=iterations))
    return trials


@command(
    option("--start", "first", nargs=3, parse=positive, metavar="PA PA PA", default=SNOW.STRESSES[1:4], help="stresses at the start"),
    option("--iterations", parse=at_least(1), default=4, show_default=True, help="steps of the fit"),
    option("--results", parse=path, help="default: results/snow_wheel in the source tree"),
    option("--build", parse=path, help="build folder with the programs"),
    description=__doc__ or "",
)
def stresses(given: Given) -> None:
    tools = Tools.of(Path(__file__), given.build)
    executor, records = Executor(given.results or tools.root / "results" / HERE.name, tools), []

    def make(case: Case) -> Mapping[str, float]:
        (run,) = executor.completed([case])
        records.append(run.record)
        return {**steady(run, 0.5), "density_under": rut(run)["under"]}

    trials = identify(tuple(given.first), make, given.iterations)
    print("best:", min(trials, key=lambda trial: float(trial["sum_of_squares"])))
    with Output(HERE, page=False) as output:
        output.table("identified.csv", trials)
        output.publish(records, tools.root)


if __name__ == "__main__":
    sys.exit(start(stresses, "snow_wheel/identify.py"))
