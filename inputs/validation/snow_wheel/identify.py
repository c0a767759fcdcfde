#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Identifies the beginning of the field snow's compaction curve, three stresses, on the calibration
rows with the tyre, by SciPy's least squares over their logarithms. See README.md.

Seen are the twelve calibration rows only: sinkage and resistance, over the goals, and, weakly, the
density under the wheel. Runs are made at three depths; rows between them are interpolated. Every run
is kept and not made twice. Prints each trial and adds it to identified.csv next to this file.
"""

import argparse
import math
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

import furrow_post  # first: reports which of the next ones are missing

import numpy as np
from scipy.optimize import least_squares

from furrow_post.analyse.statistics import rms
from furrow_post.arguments import at_least, path, positive
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError
from furrow_post.program import run_program
from furrow_post.run.case import Case
from furrow_post.study.definition import cases_of, evaluation_of
from furrow_post.run.tools import Tools
from furrow_post.study.output import Output
from furrow_post.run.record import Record
from furrow_post.run.executor import Executor
from furrow_post.study.runs import Run
from furrow_post.study.tables import aligned

study: Any = evaluation_of(HERE)

DEPTHS = (0.18, 0.20, 0.22)  # [m]
DENSITY_SCALE = 50.0  # [kg/m3]
START = (4e3, 25e3, 100e3)  # [Pa]
STEP = 0.2  # of a logarithm, for differences: moves residuals by ten times the runs' scatter
SEARCHED = tuple(f"stress_{rho:.0f}" for rho in study.IDENTIFIED_DENSITIES)  # [Pa]
# Physical range of all three: above what half a metre of snow weighs, below the stress at 525 kg/m3
# [CRREL95-7]
LOWEST, HIGHEST = 1e3, 210e3  # [Pa]

Trial = dict[str, Any]  # a row of identified.csv


def case_of(stresses: tuple[float, ...], depth: float) -> Case:
    """The tyre on 220 kg/m3 of this depth [m], with a compaction curve that begins so."""
    base = next(case for case in cases_of(HERE) if case.name == study.ERROR_BASE)
    density = study.CALIBRATION_DENSITY
    text = study.field_snow(density, stresses, f"field snow of {density:g} kg/m3")
    label = "_".join(f"{stress / 1e3:.4g}" for stress in stresses)
    cell = round(depth / round(depth / 0.04), 6)
    return replace(
        base,
        name=f"identify/{label}_{100 * depth:.0f}cm",
        stage="identify",
        files={"material.yaml": text},
        variables={**base.variables, "depth": depth, "cell": cell},
    )


class Search:
    """make: makes a run unless it is there, and evaluates it."""

    def __init__(self, start: tuple[float, ...], make: Callable[[Case], dict[str, Any]]) -> None:
        self.start, self.make = start, make
        self.trials: list[Trial] = []

    def stresses(self, logs: Floats) -> tuple[float, ...]:
        """[Pa], increasing, in their range; logs: of the factors on the start."""
        inside = np.clip(self.start * np.exp(logs), LOWEST, HIGHEST)
        first, second, third = (float(f"{x:.4g}") for x in np.maximum.accumulate(inside))
        return first, max(second, 1.01 * first), max(third, 1.02 * second, 1.03 * first)

    def residuals(self, logs: Floats) -> Floats:
        """Of the rows, over the goals and the square root of their number; of the density."""
        stresses = self.stresses(logs)
        found = [self.make(case_of(stresses, depth)) for depth in DEPTHS]
        for run in found:
            if run["failure"]:
                raise ResultsError(f"{run['run']}: {run['failure']}")
        rows = [row for row in study.reference() if study.is_calibration(row)]
        depths = [row["depth_m"] for row in rows]
        trial: Trial = {"trial": len(self.trials), **dict(zip(SEARCHED, stresses))}
        parts: list[float] = []
        for what, goal in study.GOAL.items():
            computed = np.interp(depths, DEPTHS, [run[what] for run in found])
            wrong = computed - np.array([row[what] for row in rows])
            trial[f"{what}_rms"] = round(rms(wrong), 4)
            trial[f"{what}_mean"] = round(float(wrong.mean()), 4)
            parts += list(wrong / goal / math.sqrt(len(rows)))
        trial["density_under"] = round(float(np.mean([run["density_under"] for run in found])))
        parts.append((trial["density_under"] - study.DENSITY_UNDER) / DENSITY_SCALE)
        residuals = np.array(parts)
        trial["sum_of_squares"] = round(float(residuals @ residuals), 3)
        self.trials.append(trial)
        print(aligned([trial]), flush=True)
        return residuals

    def run(self, evaluations: int) -> Trial:
        """The trial of the smallest sum of squares."""
        least_squares(  # from ones: SciPy's steps are relative
            lambda x: self.residuals(x - 1.0), np.ones(len(SEARCHED)), diff_step=STEP, max_nfev=evaluations
        )
        return min(self.trials, key=lambda trial: float(trial["sum_of_squares"]))


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--start", nargs=3, type=positive, metavar="PA", default=START, help="instead of START"
    )
    parser.add_argument("--iterations", type=at_least(1), default=4)
    parser.add_argument("--results", type=path, help="default: results/snow_wheel in the source tree")
    parser.add_argument("--build", type=path, help="build folder with the programs")
    return parser.parse_args()


def identify(parsed: argparse.Namespace) -> None:
    tools = Tools.of(Path(__file__), parsed.build)
    executor = Executor(parsed.results or tools.root / "results" / HERE.name, tools)
    made: list[Record] = []

    def make(case: Case) -> dict[str, Any]:
        executor.run([case])
        record = executor.ended(case)
        assert record
        made.append(record)
        row: dict[str, Any] = study.row_of(Run(case, executor.folder(case), record))
        return row

    search = Search(tuple(parsed.start), make)
    best = search.run(parsed.iterations)
    print(f"best:\n{aligned([best])}\n")
    with Output(HERE, page=False) as output:
        output.table("identified.csv", search.trials)
        output.publish(made, tools.root)


if __name__ == "__main__":
    sys.exit(run_program("snow_wheel/identify.py", lambda: identify(parse())))
