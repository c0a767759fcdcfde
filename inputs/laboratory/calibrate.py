#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Adjusts parameters of a ground of grains to measurements with a laboratory test.

Least squares (scipy.optimize.least_squares, trust region) in the logarithms of the parameters;
differences of 20 % make the Jacobian, all runs of which have one packing. Every run is kept in
FOLDER/log.jsonl: a calibration that was stopped continues where it was, and one that is done is
only evaluated again. The result goes to CALIBRATION.result.json, next to the input; it says whether
the calibration has converged, and by what factor the next step would change each parameter.

The input: "test", "ground", "variables" of all runs, "parameters": {name: [start, lower, upper]},
"seeds" for the scatter, and the target, either "reference" (reference.csv of an oedometer: ln of
stress at the measured densities from "lowest" to "highest" Pa, over "deviation", default 1) or
"quantities": {name: [value, deviation]} of the evaluation, with "series" of confinements whose
"together" values are used; a deviation "30%" compares logarithms, which a strength wants that is
far below its target: there its difference hardly depends on the parameters. Several tests at once:
"tests", a list of {"test", "variables", "series", target}; "variables" beside it are those of all.
"""

import argparse
import json
import math
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np
from scipy.optimize import least_squares

from task import Task, read_task

from furrow_post.analyse.statistics import rms
from furrow_post.arguments import at_least, fraction, path
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError, content_of
from furrow_post.json_text import parse_json
from furrow_post.laboratory.evaluation import values_of
from furrow_post.laboratory.together import together
from furrow_post.program import run_program
from furrow_post.read.laboratory import LaboratoryTest, cell_curve, read_oedometer_reference
from furrow_post.run.case import Value, laboratory_case
from furrow_post.run.executor import Executor
from furrow_post.run.tools import Tools

STEP = 0.2  # of a parameter's logarithm, for differences
WEAK = 0.05  # singular values below this share of the largest: a combination not determined
FAILED = 3.0  # residual of a test that did not reach the stress of a target
LEAST = 1e-3  # share of its target as which a quantity counts that is less, or has its sign wrong
LARGEST_STEP = 1.0  # of a parameter's logarithm, in the first iteration
SETTLED = 0.1  # step of a parameter's logarithm below which a calibration has converged

ENDS = {  # of scipy's least_squares
    0: "iterations used up",
    1: "gradient zero",
    2: "sum of squares no longer falls",
    3: "steps too small",
    4: "steps too small, and the sum of squares no longer falls",
}


class Runs:
    """The runs made so far, by their parameters; the log is read again after a stop."""

    def __init__(self, task: Task, folder: Path, most: int, tools: Tools) -> None:
        self.task, self.folder, self.most, self.tools = task, folder, most, tools
        self.names = list(task["parameters"])
        self.log = folder / "log.jsonl"
        self.known: dict[tuple[str | int, ...], list[float]] = {}
        self.made = 0
        if self.log.exists():
            self.read_log()

    def read_log(self) -> None:
        """@raises ResultsError of a damaged line; the last may be cut by a stop: it counts not"""
        text = self.log.read_text(encoding="utf-8", errors="replace")
        lines = text.splitlines() if text.endswith("\n") else text.splitlines()[:-1]
        for number, line in enumerate(lines, 1):
            with content_of(f"{self.log}, line {number}", "remove the line: its run is made again"):
                entry = parse_json(line)
                if entry["task"] == self.identity():
                    residuals = [float(value) for value in entry["residuals"]]
                    self.known[self.key(entry["values"], int(entry["seed"]))] = residuals
        if not text.endswith("\n"):
            self.log.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")

    def identity(self) -> Task:
        """What the runs of a log must have in common."""
        return {key: self.task[key] for key in ("ground", "tests")}

    @staticmethod
    def key(values: Sequence[float], seed: int) -> tuple[str | int, ...]:
        return (*(f"{v:.6g}" for v in values), seed)

    def residuals(self, values: Floats, seed: int | None = None) -> Floats:
        """Of the target, from the log or a new run; seed: default the first."""
        seed = seed or int(self.task["seeds"][0])
        key = self.key(list(values), seed)
        if key not in self.known:
            if self.made >= self.most:
                raise ResultsError(
                    f"{self.most} runs are made; start again with a larger --runs to continue "
                    f"(log: {self.log})"
                )
            self.made += 1
            began = time.time()
            self.known[key] = self.run(values, seed)
            self.keep(values, seed, self.known[key], time.time() - began)
        return np.array(self.known[key])

    def keep(self, values: Floats, seed: int, residuals: list[float], seconds: float) -> None:
        """Adds a run to the log, and prints it."""
        entry = {
            "task": self.identity(),
            "values": [float(f"{v:.6g}") for v in values],
            "seed": seed,
            "residuals": residuals,
            "wall_s": round(seconds, 1),
        }
        with open(self.log, "a", encoding="utf-8") as file:
            file.write(json.dumps(entry) + "\n")
        numbers = "  ".join(f"{n} {v:.4g}" for n, v in zip(self.names, values))
        misfit = f"rms {rms(residuals):.3f}"
        print(f"run {len(self.known):3}  {numbers}  seed {seed}  {misfit}", flush=True)

    def run(self, values: Floats, seed: int) -> list[float]:
        """Residuals of new runs of all tests. @raises ResultsError where one failed, Interrupted"""
        parameters = {"seed": seed, **dict(zip(self.names, (float(v) for v in values)))}
        residuals = []
        for number, test in enumerate(self.task["tests"], 1):
            residuals += misfit(test, self.results_of(test, f"run_{number}", parameters))
        return residuals

    def results_of(self, test: Task, name: str, parameters: Task) -> list[LaboratoryTest]:
        """One test, or one for each value of its series."""
        cases = []
        for confinement in test.get("series") or [None]:
            given = {**test["variables"], "ground": self.task["ground"], **parameters}
            if confinement:
                given["confinement"] = confinement
            variables: dict[str, Value] = {
                key: f"{value:.6g}" if isinstance(value, float) else str(value)
                for key, value in given.items()
            }
            case_name = f"{name}_{confinement}" if confinement else name
            cases.append(laboratory_case(case_name, test["test"], PROJECT, variables))
        executor = Executor(self.folder, self.tools, same_program=True, again=True)
        return [LaboratoryTest(run.folder) for run in executor.completed(cases)]


def targets(test: Task) -> list[str]:
    """What its residuals are of."""
    if "reference" in test:
        return [f"{test['test']} at {rho:g} kg/m3" for rho, _ in reference_of(test)]
    return [f"{test['test']} {name}" for name in test["quantities"]]


def misfit(test: Task, results: Sequence[LaboratoryTest]) -> list[float]:
    """Residuals of a test and its series."""
    if "reference" in test:
        return misfit_of_curve(test, results[0])
    shared = {q.name: q.value for q in together(results)}
    found = shared or values_of(results[0])
    wanted = test["quantities"].items()
    absent = [name for name, _ in wanted if not math.isfinite(found.get(name, math.nan))]
    if absent:
        raise ResultsError(
            f"{results[0].folder}: the test gives no {', '.join(absent)} for 'quantities'; "
            f"it gives {', '.join(found)}"
        )
    return [misfit_of_quantity(found[name], *target) for name, target in wanted]


def misfit_of_quantity(found: float, value: float, deviation: float | str) -> float:
    """Over its deviation; where that is a percentage, of the logarithm."""
    if isinstance(deviation, str):
        return math.log(max(found / value, LEAST)) / fraction(deviation)
    return (found - value) / deviation


def reference_of(test: Task) -> list[tuple[float, float]]:
    """Density and stress of the rows that count."""
    rows = read_oedometer_reference(HERE / test["reference"])
    return [(rho, sigma) for rho, sigma in rows if test["lowest"] <= sigma <= test["highest"]]


def misfit_of_curve(test: Task, result: LaboratoryTest) -> list[float]:
    """ln of computed over measured stress at the measured densities, over its deviation."""
    _, stress, density = cell_curve(result.curve())
    end = int(np.argmax(stress[:, 2])) + 1
    axial = np.maximum.accumulate(np.maximum(stress[:end, 2], 1.0))
    found = []
    for rho, sigma in reference_of(test):
        if rho <= density[end - 1]:
            found.append(math.log(np.interp(rho, density[:end], axial) / sigma))
        else:
            # A test that ended before the density was reached was too stiff, at least so much
            beyond = FAILED * (rho / density[end - 1] - 1)
            found.append(max(math.log(axial[-1] / sigma), float(beyond)))
    return [value / test.get("deviation", 1.0) for value in found]


class Bounds:
    """Logarithms of the parameters' start and limits."""

    def __init__(self, task: Task) -> None:
        self.start, self.lower, self.upper = np.log(list(task["parameters"].values())).T


def jacobian(runs: Runs, bounds: Bounds, logs: Floats) -> Floats:
    """(residuals, parameters) from differences of STEP towards the inside.

    Written out because every run must come again with the same digits from the log.
    """
    base = runs.residuals(np.exp(logs))
    columns = []
    for k in range(len(logs)):
        step = STEP if logs[k] + STEP <= bounds.upper[k] else -STEP
        moved = logs.copy()
        moved[k] += step
        columns.append((runs.residuals(np.exp(moved)) - base) / step)
    return np.array(columns).T


def calibrate(task: Task, runs: Runs) -> dict[str, Any]:
    """The result, as it is written."""
    bounds = Bounds(task)
    # From the start on: the size of a logarithm, by which xtol is measured, depends on units
    fit = least_squares(
        lambda way: runs.residuals(np.exp(bounds.start + way)),
        np.zeros(len(bounds.start)),
        jac=lambda way: jacobian(runs, bounds, bounds.start + way),
        bounds=(bounds.lower - bounds.start, bounds.upper - bounds.start),
        x_scale=LARGEST_STEP,
        ftol=0.02,
        xtol=0.03,
        max_nfev=task.get("iterations", 6),
    )
    logs = bounds.start + fit.x
    best = np.exp(logs)
    residuals = [runs.residuals(best, seed) for seed in task["seeds"]]
    scatter = math.nan
    if len(residuals) > 1:
        scatter = float(np.sqrt(np.mean(np.var(residuals, axis=0, ddof=1))))
    slopes = jacobian(runs, bounds, logs)
    spread, findings = uncertainty(runs.names, bounds, logs, fit.fun, slopes, scatter)
    step = next_step(bounds, logs, fit.fun, slopes)
    unsettled = [k for k in range(len(step)) if abs(step[k]) > max(SETTLED, 0.5 * spread[k])]
    return {
        "converged": not unsettled,
        "next_factor": {
            name: float(f"{math.exp(ln):.3g}") for name, ln in zip(runs.names, step)
        },
        "ended": ENDS.get(fit.status, fit.message),
        "parameters": {
            name: {
                "value": float(f"{value:.4g}"),
                "ln_error": float(f"{error:.3g}") if np.isfinite(error) else None,
            }
            for name, value, error in zip(runs.names, best, spread)
        },
        "targets": [name for test in task["tests"] for name in targets(test)],
        "rms_by_seed": [round(rms(r), 3) for r in residuals],
        "scatter_of_seeds": round(scatter, 3) if np.isfinite(scatter) else None,
        "residuals": [[round(float(v), 3) for v in r] for r in residuals],
        "sensitivity": {
            name: [round(float(v), 2) for v in column] for name, column in zip(runs.names, slopes.T)
        },
        "not_determined": findings,
        "runs": len(runs.known),
    }


def next_step(bounds: Bounds, logs: Floats, residuals: Floats, slopes: Floats) -> Floats:
    """Of Gauss and Newton, inside the bounds; none along what is not determined.

    A calibration has converged when it is small, or small against the errors of the parameters: a
    sum of squares from packings has no digits left there to go by.
    """
    step = -np.linalg.pinv(slopes, rcond=WEAK) @ residuals
    inside: Floats = np.clip(logs + step, bounds.lower, bounds.upper) - logs
    return inside


def uncertainty(
    names: Sequence[str],
    bounds: Bounds,
    logs: Floats,
    residuals: Floats,
    slopes: Floats,
    scatter: float,
) -> tuple[Floats, list[str]]:
    """Standard deviations of the logarithms, and in words what the target does not determine.

    slopes: the Jacobian at logs; scatter: of the residuals from packing to packing
    """
    _, singular, directions = np.linalg.svd(slopes, full_matrices=False)
    degrees = max(len(residuals) - len(logs), 1)
    sigma = float(np.sqrt(np.sum(residuals**2) / degrees))
    sigma = max(sigma, scatter if np.isfinite(scatter) else 0.0)
    parts = directions.T / np.maximum(singular, 1e-12)
    spread: Floats = np.sqrt(np.sum(parts**2, axis=1)) * sigma
    findings = []
    if len(residuals) < len(logs):
        spread[:] = np.inf
    for value, direction in zip(singular, directions):
        if value < WEAK * singular[0]:
            product = " ".join(f"{n}^{c:+.2f}" for n, c in zip(names, direction) if abs(c) > 0.2)
            findings.append(
                f"the combination {product} is not determined "
                f"(singular value {value / singular[0]:.3f} of the largest)"
            )
    if len(residuals) < len(logs):
        findings.append(
            f"{len(logs)} parameters and {len(residuals)} target(s): not all can be determined"
        )
    for k, name in enumerate(names):
        if spread[k] > 1:
            findings.append(f"{name} is known no better than a factor of e")
        if min(logs[k] - bounds.lower[k], bounds.upper[k] - logs[k]) < 0.01:
            findings.append(f"{name} stands at a bound")
    return spread, findings


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("calibration", type=path)
    parser.add_argument("-o", "--output", type=path)
    parser.add_argument("--runs", type=at_least(1), default=40, help="new runs at most (40)")
    parser.add_argument("--build", type=path, help="default: $FURROW_BUILD, or build in the tree")
    parsed = parser.parse_args()
    calibration: Path = parsed.calibration
    task = read_task(calibration)
    default = PROJECT / "results" / "laboratory" / f"calibrate_{calibration.stem}"
    folder: Path = (parsed.output or default).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    runs = Runs(task, folder, parsed.runs, Tools.of(Path(__file__), parsed.build))
    result = json.dumps(calibrate(task, runs), indent=1)
    calibration.with_suffix(".result.json").write_text(result + "\n", encoding="utf-8")
    print(result)


if __name__ == "__main__":
    sys.exit(run_program("laboratory/calibrate.py", main))
