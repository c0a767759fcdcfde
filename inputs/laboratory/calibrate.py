#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Adjusts parameters of a ground of grains to measurements with a laboratory test.

  inputs/laboratory/calibrate CALIBRATION.json [-o FOLDER] [--runs N]

Least squares (scipy.optimize.least_squares, trust region) in the logarithms of the parameters; differences of 20 % make the Jacobian,
well above the scatter of packings. Every run is kept in FOLDER/log.jsonl: a calibration that was stopped goes on where it was, and one
that is done is only evaluated again. The result goes to CALIBRATION.result.json, beside the input.

The input: "test", "ground", "variables" of all runs, "parameters": {name: [start, lower, upper]}, "seeds" for the scatter, and the target,
either "reference" (reference.csv of an oedometer: ln of stress at the measured densities from "lowest" to "highest" Pa) or
"quantities": {name: [value, deviation]} of the evaluation, with "series" of confinements whose "together" values are used.
"""
import argparse, json, os, pathlib, subprocess, sys, time

import numpy as np
from scipy.optimize import least_squares

here = pathlib.Path(__file__).resolve().parent
project = here.parents[1]
sys.path.insert(0, str(project / "postproc"))
from furrow_post import laboratory

STEP = 0.2               # of a parameter's logarithm, for differences
WEAK = 0.05              # singular values of the Jacobian below this share of the largest: a combination that is not determined
FAILED = 3.0             # residual of a test that did not reach the stress of a target


class Runs:
    """The runs made so far, by their parameters; the log is read again after a stop."""

    def __init__(self, task, folder, most):
        self.task, self.folder, self.most = task, folder, most
        self.names = list(task["parameters"])
        self.log = folder / "log.jsonl"
        self.known = {}
        self.made = 0
        if self.log.exists():
            for line in self.log.read_text().splitlines():
                entry = json.loads(line)
                if entry["task"] == self.identity():
                    self.known[self.key(entry["values"], entry["seed"])] = entry["residuals"]

    def identity(self):
        return {k: self.task[k] for k in ("test", "ground", "variables")} | {"target": self.task.get("reference") or self.task.get("quantities")}

    @staticmethod
    def key(values, seed):
        return tuple(f"{v:.6g}" for v in values) + (seed,)

    def residuals(self, values, seed=None):
        seed = seed or self.task["seeds"][0]
        key = self.key(values, seed)
        if key not in self.known:
            if self.made >= self.most:
                sys.exit(f"{self.most} runs are made; start again with a larger --runs to go on (log: {self.log})")
            self.made += 1
            began = time.time()
            self.known[key] = self.run(values, seed)
            entry = {"task": self.identity(), "values": [float(f"{v:.6g}") for v in values], "seed": seed,
                     "residuals": self.known[key], "wall_s": round(time.time() - began, 1)}
            with open(self.log, "a") as file:
                file.write(json.dumps(entry) + "\n")
            text = "  ".join(f"{n} {v:.4g}" for n, v in zip(self.names, values))
            print(f"run {len(self.known):3}  {text}  seed {seed}  rms {np.sqrt(np.mean(np.square(self.known[key]))):.3f}", flush=True)
        return np.array(self.known[key])

    def run(self, values, seed):
        tests = []
        for confinement in self.task.get("series", [None]):
            folder = self.folder / (f"run_{confinement}" if confinement else "run")
            given = dict(self.task["variables"], ground=self.task["ground"], seed=seed, **dict(zip(self.names, values)))
            if confinement:
                given["confinement"] = confinement
            folder.mkdir(parents=True, exist_ok=True)
            command = [os.environ.get("FURROW_BUILD", str(project / "build")) + "/bin/furrow", "-in", str(here / f"{self.task['test']}.lig"), "-log", "none"]
            command += ["-var", "results", str(folder), "-var", "here", str(here)]
            for name, value in given.items():
                command += ["-var", name, f"{value:.6g}" if isinstance(value, float) else str(value)]
            for old in folder.glob("restart_forced*"):
                old.unlink()
            with open(folder / "screen.txt", "w") as screen:
                if subprocess.run(command, cwd=folder, stdout=screen, stderr=subprocess.STDOUT).returncode:
                    sys.exit(f"the run failed: {folder / 'screen.txt'}")
            if any(folder.glob("restart_forced*")):  # a signal ended the run, and LIGGGHTS goes on with the script
                sys.exit(f"{folder} was interrupted; start again, the log goes on")
            tests.append(laboratory.Test(folder))
        if "reference" in self.task:
            return self.of_curve(tests[0])
        found = {q.name: q.value for q in (laboratory.together(tests) or tests[0].evaluate())}
        return [(found[name] - value) / deviation for name, (value, deviation) in self.task["quantities"].items()]

    def of_curve(self, test):
        _, stress, density = laboratory.cell_curve(test.curve())
        end = int(np.argmax(stress[:, 2])) + 1
        axial = np.maximum.accumulate(np.maximum(stress[:end, 2], 1.0))
        points = [(rho, sigma) for rho, sigma in laboratory.read_reference(here / self.task["reference"])
                  if self.task["lowest"] <= sigma <= self.task["highest"]]
        # A test that ended before a density was reached was too stiff, by at least this much.
        return [float(np.log(np.interp(rho, density[:end], axial) / sigma)) if rho <= density[end - 1] else
                max(float(np.log(axial[-1] / sigma)), FAILED * (rho / density[end - 1] - 1)) for rho, sigma in points]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("calibration", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=40, help="new runs at most (default 40)")
    arguments = parser.parse_args()
    task = json.loads(arguments.calibration.read_text())
    folder = (arguments.output or project / "results" / "laboratory" / f"calibrate_{arguments.calibration.stem}").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    runs = Runs(task, folder, arguments.runs)
    start, lower, upper = (np.log([limits[k] for limits in task["parameters"].values()]) for k in range(3))

    # Differences of STEP towards the inside; written out because every run must come again with the same digits from the log.
    def jacobian(x):
        base = runs.residuals(np.exp(x))
        columns = []
        for k in range(len(x)):
            step = STEP if x[k] + STEP <= upper[k] else -STEP
            moved = x.copy()
            moved[k] += step
            columns.append((runs.residuals(np.exp(moved)) - base) / step)
        return np.array(columns).T

    fit = least_squares(lambda x: runs.residuals(np.exp(x)), start, jac=jacobian, bounds=(lower, upper), x_scale=0.5, ftol=0.02, xtol=0.03,
                        max_nfev=task.get("iterations", 6))
    names, best = runs.names, np.exp(fit.x)
    seeds = [runs.residuals(best, seed) for seed in task["seeds"]]
    rms = [float(np.sqrt(np.mean(r**2))) for r in seeds]
    scatter = float(np.sqrt(np.mean(np.var(seeds, axis=0, ddof=1)))) if len(seeds) > 1 else float("nan")

    jac = jacobian(fit.x)
    _, singular, directions = np.linalg.svd(jac, full_matrices=False)
    degrees = max(len(fit.fun) - len(best), 1)
    sigma = max(np.sqrt(np.sum(fit.fun**2) / degrees), scatter if np.isfinite(scatter) else 0.0)
    spread = np.sqrt(np.sum((directions.T / np.maximum(singular, 1e-12)) ** 2, axis=1)) * sigma
    if len(fit.fun) < len(best):
        spread[:] = np.inf
    findings = []
    for value, direction in zip(singular, directions):
        if value < WEAK * singular[0]:
            parts = " ".join(f"{n}^{c:+.2f}" for n, c in zip(names, direction) if abs(c) > 0.2)
            findings.append(f"the combination {parts} is not determined (singular value {value / singular[0]:.3f} of the largest)")
    if len(fit.fun) < len(best):
        findings.append(f"{len(best)} parameters and {len(fit.fun)} target(s): not all can be determined")
    for k, name in enumerate(names):
        if spread[k] > 1:
            findings.append(f"{name} is known no better than a factor of e")
        if min(fit.x[k] - lower[k], upper[k] - fit.x[k]) < 0.01:
            findings.append(f"{name} stands at a bound")
    result = {
        "parameters": {n: {"value": float(f"{v:.4g}"), "ln_error": float(f"{s:.3g}") if np.isfinite(s) else None}
                       for n, v, s in zip(names, best, spread)},
        "rms_by_seed": [round(r, 3) for r in rms], "scatter_of_seeds": round(scatter, 3) if np.isfinite(scatter) else None,
        "residuals": [[round(float(v), 3) for v in r] for r in seeds],
        "sensitivity": {n: [round(float(v), 2) for v in column] for n, column in zip(names, jac.T)},
        "not_determined": findings, "runs": len(runs.known)}
    arguments.calibration.with_suffix(".result.json").write_text(json.dumps(result, indent=1) + "\n")
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
