#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Identifies the beginning of the field snow's compaction curve, three stresses, on the calibration
rows with the tyre, by Levenberg and Marquardt over their logarithms. See README.md.

Seen are the twelve calibration rows only: sinkage and resistance, over the goals, and, weakly, the
density under the wheel. Runs are made at three depths; rows between them are
interpolated. Every run is kept and not made twice. Prints each trial and adds it to identified.csv
beside this file.
"""

import argparse
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

import cases
import one_run
import snow
import table11

from furrow_post.analyse.statistics import rms
from furrow_post.arguments import at_least, path, positive
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError
from furrow_post.program import run_program
from furrow_post.study.case import Case
from furrow_post.study.launch import Tools
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner
from furrow_post.study.tables import aligned

DEPTHS = (0.18, 0.20, 0.22)  # [m]
# [kg/m3] measured, scale
DENSITY = {"density_under": (table11.DENSITY_UNDER, 50)}
START: snow.Beginning = (4e3, 25e3, 100e3)  # [Pa]
STEP = 0.2  # of a logarithm, for differences: moves residuals by ten times the runs' scatter
LARGEST = 0.5  # change of a logarithm in an iteration
SETTLED = 0.03  # relative gain below which the search ends: the runs' scatter is as large

Trial = dict[str, Any]  # a row of identified.csv

SEARCHED = tuple(f"stress_{rho:.0f}" for rho in snow.IDENTIFIED_DENSITIES)  # [Pa]
# Physical range of all three: above what half a metre of snow weighs, below the stress at 525 kg/m3
# [CRREL95-7]
LOWEST, HIGHEST = 1e3, 210e3  # [Pa]


class Search:
    """make: makes a run unless it is there, and evaluates it."""

    def __init__(self, start: snow.Beginning, make: Callable[[Case], one_run.Row]) -> None:
        self.start, self.make = start, make
        self.trials: list[Trial] = []

    def stresses(self, logs: Floats) -> snow.Beginning:
        """[Pa], increasing, in their range; logs: of the factors on the start."""
        inside = np.clip(self.start * np.exp(logs), LOWEST, HIGHEST)
        first, second, third = (float(f"{x:.4g}") for x in np.maximum.accumulate(inside))
        return first, max(second, 1.01 * first), max(third, 1.02 * second, 1.03 * first)

    def residuals(self, logs: Floats, note: str) -> Floats:
        """Of the rows, over the goals and the square root of their number; of the density."""
        beginning = self.stresses(logs)
        label = "_".join(f"{stress / 1e3:.4g}" for stress in beginning)
        found = []
        for depth in DEPTHS:
            name = f"identify/{label}_{100 * depth:.0f}cm"
            density = table11.CALIBRATION_DENSITY
            run = self.make(
                cases.on_field_snow(name, "identify", density, depth, beginning=beginning)
            )
            if run["error"]:
                raise ResultsError(f"{run['run']}: {run['error']}")
            found.append(run)
        rows = [row for row in table11.reference() if table11.is_calibration(row)]
        depths = [row["depth_m"] for row in rows]
        trial: Trial = {"trial": note, **dict(zip(SEARCHED, beginning))}
        parts: list[float] = []
        for what, goal in table11.GOAL.items():
            computed = np.interp(depths, DEPTHS, [run[what] for run in found])
            wrong = computed - np.array([row[what] for row in rows])
            trial[f"{what}_rms"] = round(rms(wrong), 4)
            trial[f"{what}_mean"] = round(float(wrong.mean()), 4)
            parts += list(wrong / goal / math.sqrt(len(rows)))
        for what, (measured, scale) in DENSITY.items():
            trial[what] = round(float(np.mean([run[what] for run in found])))
            parts.append((trial[what] - measured) / scale)
        residuals = np.array(parts)
        trial["sum_of_squares"] = round(float(residuals @ residuals), 3)
        self.trials.append(trial)
        print(aligned([trial]), flush=True)
        return residuals

    def run(self, iterations: int) -> Trial:
        """The trial of the smallest sum of squares."""
        logs: Floats = np.zeros(len(SEARCHED))
        damping = 0.1
        r = self.residuals(logs, "start")
        for iteration in range(1, iterations + 1):
            columns = []
            for k, name in enumerate(SEARCHED):
                step = STEP * np.eye(len(logs))[k]
                columns.append((self.residuals(logs + step, f"{iteration}: {name}") - r) / STEP)
            J = np.array(columns).T
            H, gradient = J.T @ J, J.T @ r
            gain = 0.0
            for _ in range(3):
                change = -np.linalg.solve(H + damping * np.diag(np.diag(H)), gradient)
                change *= min(1.0, LARGEST / np.abs(change).max())
                new = self.residuals(logs + change, f"{iteration}: step")
                gain = 1.0 - float((new @ new) / (r @ r))
                if gain > 0:
                    logs, r, damping = logs + change, new, damping / 4
                    break
                damping *= 8
            if gain < SETTLED:
                break
        return min(self.trials, key=lambda trial: float(trial["sum_of_squares"]))


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--start", nargs=3, type=positive, metavar="PA", default=START, help="instead of START"
    )
    parser.add_argument("--iterations", type=at_least(1), default=4)
    parser.add_argument("--results", type=path, help="as of run.py")
    parser.add_argument("--build", type=path, help="as of run.py")
    return parser.parse_args()


def identify(parsed: argparse.Namespace) -> None:
    tools = Tools.of(Path(__file__), parsed.build)
    results = parsed.results or tools.root / "results" / HERE.name
    runner = Runner(results, tools)
    made: list[Record] = []

    def make(case: Case) -> one_run.Row:
        runner.run([case])
        record = runner.ended(case)
        assert record
        made.append(record)
        return one_run.row_of(case, runner.folder(case), record)

    first, second, third = parsed.start
    search = Search((first, second, third), make)
    best = search.run(parsed.iterations)
    print(f"best:\n{aligned([best])}\n")
    with Output(HERE, page=False) as output:
        output.table("identified.csv", search.trials)
        output.publish(made, tools.root)


if __name__ == "__main__":
    sys.exit(run_program("snow_wheel/identify.py", lambda: identify(parse())))
