#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Identifies three parameters of a law on the calibration rows, by Levenberg and Marquardt over
their logarithms. See README.md.

Seen are the twelve calibration rows only: sinkage and resistance, over the goals, and the density
under the wheel and at its shoulder. Runs are made at three depths; rows between them are
interpolated. Every run is kept and not made twice. Prints each trial and adds it to identified.csv
beside this file.
"""

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

import cases
import report

from furrow_post.analyse.statistics import rms
from furrow_post.arguments import at_least, path, positive
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.program import run_program
from furrow_post.study.case import Case
from furrow_post.study.launch import Tools
from furrow_post.study.output import Output
from furrow_post.study.record import Record
from furrow_post.study.runner import Runner
from furrow_post.study.tables import aligned

DEPTHS = (0.18, 0.20, 0.22)  # [m]
GOAL = {"sinkage_m": 0.012, "resistance": 0.031}  # rms over rows
# [kg/m3] measured [Shoop2001], scale: weak, as all cannot be met together
DENSITY = {"density_under": (510, 150), "density_shoulder": (290, 150)}
STEP = 0.2  # of a logarithm, for differences: moves residuals by ten times the runs' scatter
LARGEST = 0.5  # change of a logarithm in an iteration
SETTLED = 0.03  # relative gain below which the search ends: the runs' scatter is as large

Parameters = dict[str, float]  # slope, d [Pa], tan_beta, E [Pa], p_510 [Pa]
Trial = dict[str, Any]  # a row of identified.csv

SEARCHED = {"zero_slip": ("p_510", "slope", "d"), "towed": ("tan_beta", "E", "p_510")}
START: dict[str, Parameters] = {
    "zero_slip": {
        "slope": 16,
        "d": 6e3,
        "tan_beta": math.tan(math.radians(22.53)),
        "E": 13.79e6,
        "p_510": 150e3,
    },
    "towed": {
        "slope": 30,
        "d": 1000,
        "tan_beta": math.tan(math.radians(57)),
        "E": 0.3e6,
        "p_510": 115e3,
    },
}


def law_of(parameters: Parameters) -> cases.Law:
    """For cases.power_law."""
    law = {name: float(f"{v:.4g}") for name, v in parameters.items() if name != "tan_beta"}
    return {**law, "beta": round(math.degrees(math.atan(parameters["tan_beta"])), 2)}


class Search:
    """make: makes a run unless it is there, and evaluates it."""

    def __init__(
        self,
        mode: str,
        searched: Sequence[str],
        start: Parameters,
        make: Callable[[Case], report.Row],
    ) -> None:
        self.mode, self.searched, self.start, self.make = mode, searched, start, make
        self.trials: list[Trial] = []

    def parameters(self, logs: Floats) -> Parameters:
        """logs: of the factors on the start."""
        factors = dict(zip(self.searched, np.exp(logs)))
        return {name: value * factors.get(name, 1.0) for name, value in self.start.items()}

    def residuals(self, logs: Floats, note: str) -> Floats:
        """Of the rows, over the goals and the square root of their number; of the densities."""
        law = law_of(self.parameters(logs))
        label = "_".join(f"{name}{value:.4g}" for name, value in law.items())
        found = []
        for depth in DEPTHS:
            name = f"identify/{self.mode}_{label}_{100 * depth:.0f}cm"
            density = cases.CALIBRATION_DENSITY
            run = self.make(cases.on_law(name, "identify", density, depth, self.mode, law))
            if run["error"]:
                raise ResultsError(f"{run['run']}: {run['error']}")
            found.append(run)
        rows = [row for row in cases.reference() if cases.is_calibration(row)]
        depths = [row["depth_m"] for row in rows]
        trial: Trial = {"mode": self.mode, "trial": note, **law}
        parts: list[float] = []
        for what, goal in GOAL.items():
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
        logs: Floats = np.zeros(len(self.searched))
        damping = 0.1
        r = self.residuals(logs, "start")
        for iteration in range(1, iterations + 1):
            columns = []
            for k, name in enumerate(self.searched):
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
        "mode", choices=START, help="of the wheel: as [Shoop2001] compares, or free as measured"
    )
    parser.add_argument(
        "--search",
        nargs="+",
        metavar="NAME",
        choices=list(START["towed"]),
        help=f"at most three of {', '.join(START['towed'])}; default: "
        + ", ".join(f"{mode}: {' '.join(names)}" for mode, names in SEARCHED.items()),
    )
    parser.add_argument(
        "--start", nargs="+", metavar="NAME=VALUE", default=[], help="instead of START"
    )
    parser.add_argument("--iterations", type=at_least(1), default=4)
    parser.add_argument("--results", type=path, help="as of run.py")
    parser.add_argument("--build", type=path, help="as of run.py")
    parsed = parser.parse_args()
    if parsed.search and len(parsed.search) > 3:
        parser.error("at most three parameters")
    return parsed


def start_values(pairs: Sequence[str], known: Parameters) -> Parameters:
    """Of "NAME=VALUE". @raises ResultsError for another name, or a value not above 0"""
    given: Parameters = {}
    for pair in pairs:
        name, _, value = pair.partition("=")
        if name not in known:
            raise ResultsError(f"--start {pair}: NAME is one of {', '.join(known)}")
        try:
            given[name] = positive(value)
        except argparse.ArgumentTypeError as error:
            raise ResultsError(f"--start {pair}: {error}") from error
    return given


def identify(parsed: argparse.Namespace) -> None:
    tools = Tools.of(Path(__file__), parsed.build)
    results = parsed.results or tools.root / "results" / HERE.name
    runner = Runner(results, tools)
    made: list[Record] = []

    def make(case: Case) -> report.Row:
        runner.run([case])
        record = runner.record(case) or runner.failure(case)
        assert record
        made.append(record)
        return report.row_of(case, runner.folder(case), record)

    start = {**START[parsed.mode], **start_values(parsed.start, START[parsed.mode])}
    search = Search(parsed.mode, parsed.search or SEARCHED[parsed.mode], start, make)
    best = search.run(parsed.iterations)
    print(f"best:\n{aligned([best])}\n")
    path = HERE / "identified.csv"
    known = read_rows(path) if path.exists() else []
    others: list[Trial] = [dict(row) for row in known if row["mode"] != parsed.mode]
    with Output(HERE, page=False) as output:
        output.table("identified.csv", others + search.trials)
        output.publish(made, tools.root)


if __name__ == "__main__":
    sys.exit(run_program("snow_wheel/identify.py", lambda: identify(parse())))
