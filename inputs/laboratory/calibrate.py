#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Adjusts parameters of a ground of grains to measurements with laboratory tests.

Least squares in the logarithms of the parameters (furrow_post/laws/fitter.py). Differences of 20 % make the
Jacobian, all runs of which have one packing. Runs are kept in FOLDER: a calibration that was stopped continues where it
was. The result goes to CALIBRATION.result.json, next to the input. It states whether the calibration has converged, and
by what factor the next step would change each parameter.

The input: "test", "ground", "variables" of all runs, "parameters": {name: [start, lower, upper]}, with a fourth number
for a prior (the standard deviation of ln about the start), "seeds" for the scatter, and the target. It is either
"reference" (reference.csv of an oedometer: ln of stress at the measured densities from "lowest" to "highest" Pa, over
"deviation", default 1) or "quantities": {name: [value, deviation]} of the evaluation, with "series" of confinements
whose "together" values are used. A deviation "30%" compares logarithms. Several tests at once: "tests", a list of
{"test", "variables", "series", target}; "held_out": true leaves a test out of the fit and reports what the fit predicts.
"""

import json
import math
import sys
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: reports which of the next ones are missing

import numpy as np

from task import Task, read_task

from furrow_post.laws.fitter import Fit, Parameter, Search, fit
from furrow_post.uncertainty.statistics import rms
from furrow_post.arguments import at_least, fraction, path
from furrow_post.arrays import Floats
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command, option
from furrow_post.errors import ResultsError
from furrow_post.laboratory.evaluation import values_of
from furrow_post.laboratory.together import together
from furrow_post.read.laboratory import LaboratoryTest, cell_curve, read_oedometer_reference
from furrow_post.run.case import Case, Value, laboratory_case
from furrow_post.run.executor import Executor
from furrow_post.run.tools import Tools

STEP = 0.2  # of a parameter's logarithm, for differences
WEAK = 0.05  # singular values below this share of the largest: a combination that is not determined
FAILED = 3.0  # residual of a test that did not reach the stress of a target
LEAST = 1e-3  # share of its target as which a quantity counts that is less, or has its sign wrong
SETTLED = 0.1  # step of a parameter's logarithm below which a calibration has converged


class Trials:
    """Runs of trial parameters in a folder; most: new runs at most."""

    def __init__(self, task: Task, folder: Path, most: int, tools: Tools) -> None:
        self.task, self.folder, self.most = task, folder, most
        self.names = list(task["parameters"])
        self.executor = Executor(folder, tools, again=True)
        self.trials: set[str] = set()
        self.made = 0

    def residuals(self, values: Floats, seed: int) -> Floats:
        """Residuals of all tests. @raises ResultsError where a run failed, Interrupted"""
        label = "_".join([*(f"{value:.6g}" for value in values), str(seed)])
        parameters = {"seed": seed, **dict(zip(self.names, (float(f"{value:.6g}") for value in values)))}
        cases = [self.cases_of(test, f"{label}/run_{k}", parameters) for k, test in enumerate(self.task["tests"], 1)]
        self.made += len(self.executor.missing([case for own in cases for case in own]))
        if self.made > self.most * len(cases):
            raise ResultsError(f"{self.most} trials are made; start again with a larger --runs to continue in {self.folder}")
        found: list[float] = []
        for test, own in zip(self.task["tests"], cases):
            found += misfit(test, [LaboratoryTest(run.folder) for run in self.executor.completed(own)])
        if label not in self.trials:
            self.trials.add(label)
            numbers = "  ".join(f"{n} {v:.4g}" for n, v in zip(self.names, values))
            print(f"trial {len(self.trials):3}  {numbers}  seed {seed}  rms {rms(found):.3f}", flush=True)
        return np.array(found)

    def cases_of(self, test: Task, name: str, parameters: Task) -> list[Case]:
        """Cases of a test: one run, or one for each value of the series."""
        cases = []
        for confinement in test.get("series") or [None]:
            given = {**test["variables"], "ground": self.task["ground"], **parameters}
            given |= {"confinement": confinement} if confinement else {}
            variables: dict[str, Value] = {k: f"{v:.6g}" if isinstance(v, float) else str(v) for k, v in given.items()}
            cases.append(laboratory_case(f"{name}_{confinement}" if confinement else name, test["test"], PROJECT, variables))
        return cases


def targets(test: Task) -> list[str]:
    """Names of the quantities that the residuals compare."""
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
    """Misfit of a quantity over its deviation; of the logarithm for a deviation in percent."""
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


def calibrate(task: Task, trials: Trials) -> dict[str, Any]:
    """Result of the calibration as written to its file."""
    parameters = [
        Parameter(name, "", start, lower, upper, *prior) for name, (start, lower, upper, *prior) in task["parameters"].items()
    ]
    first, *others = task["seeds"]
    rows = [(name, bool(test.get("held_out"))) for test in task["tests"] for name in targets(test)]
    found = fit(
        parameters,
        partial(trials.residuals, seed=first),
        Search(STEP, central=False, ftol=0.02, xtol=0.03, scale=1.0, evaluations=task.get("iterations", 6)),
        known=False,
        held=np.array([held for _, held in rows]),
    )
    samples = [trials.residuals(found.values, seed) for seed in others]
    packings = [trials.residuals(found.values, first), *samples]
    fitted = [np.array([r for r, (_, held) in zip(packing, rows) if not held]) for packing in packings]
    found = found.with_samples(fitted[1:])
    step = found.next_step(WEAK)
    errors = [one.deviation / one.value for one in found.parameters]
    unsettled = [k for k in range(len(step)) if abs(step[k]) > max(SETTLED, 0.5 * errors[k])]
    scatter = float(np.sqrt(np.mean(np.var(fitted, axis=0, ddof=1)))) if samples else math.nan
    return {
        "converged": not unsettled,
        "next_factor": {name: float(f"{math.exp(ln):.3g}") for name, ln in zip(trials.names, step)},
        "ended": found.end,
        "parameters": {
            one.parameter.name: {
                "value": float(f"{one.value:.4g}"),
                "ln_error": float(f"{error:.3g}") if np.isfinite(error) else None,
                "interval_95": [float(f"{end:.3g}") for end in one.interval()] if np.isfinite(error) else None,
            }
            for one, error in zip(found.parameters, errors)
        },
        "targets": [name for name, _ in rows],
        "held_out": [name for name, held in rows if held],
        "rms_held_out": round(found.rms_held, 3) if len(found.held) else None,
        "rms_by_seed": [round(rms(r), 3) for r in fitted],
        "scatter_of_seeds": round(scatter, 3) if np.isfinite(scatter) else None,
        "residuals": [[round(float(v), 3) for v in r] for r in packings],
        "sensitivity": {
            name: [round(float(v), 2) for v in column] for name, column in zip(trials.names, found.slope.T)
        },
        "not_determined": findings(found),
        "runs": len(trials.trials),
    }


def findings(found: Fit) -> list[str]:
    """Sentences on parameters that the targets do not determine."""
    names = [one.parameter.name for one in found.parameters]
    text = []
    for share, direction in found.weak(WEAK):
        product = " ".join(f"{n}^{c:+.2f}" for n, c in zip(names, direction) if abs(c) > 0.2)
        text.append(f"the combination {product} is not determined (singular value {share:.3f} of the largest)")
    if len(found.residuals) < len(names):
        text.append(f"{len(names)} parameters and {len(found.residuals)} target(s): not all can be determined")
    return [*text, *(f"{one.parameter.name}: {one.remark}" for one in found.parameters if one.remark)]


@command(
    argument("calibration", "JSON file", path),
    option("-o", "--output", "folder", parse=path, help="where runs are kept"),
    option("--runs", parse=at_least(1), default=40, show_default=True, help="new trials at most"),
    option("--build", parse=path, help="default: $FURROW_BUILD, or build in the tree"),
    description=__doc__ or "",
)
def calibration(given: Given) -> None:
    file: Path = given.calibration
    task = read_task(file)
    folder = (given.folder or PROJECT / "results" / "laboratory" / f"calibrate_{file.stem}").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    trials = Trials(task, folder, given.runs, Tools.of(Path(__file__), given.build))
    result = json.dumps(calibrate(task, trials), indent=1)
    file.with_suffix(".result.json").write_text(result + "\n", encoding="utf-8")
    print(result)


def main() -> int:
    return start(calibration, "laboratory/calibrate.py")


if __name__ == "__main__":
    sys.exit(main())
