#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Identifies three parameters of a law on the calibration rows, by Levenberg and Marquardt over their logarithms. See README.md.

  identify.py zero_slip|towed    mode of the wheel: as TR compares, or free as it was measured
  --search NAME NAME NAME        of slope d tan_beta E p_510; default SEARCHED
  --start NAME=VALUE ...         instead of START
  --iterations N                 default 4
  --results FOLDER, --furrow PROGRAM   as of run; every run is kept there and not made twice

Seen are the twelve calibration rows only: sinkage and resistance, over the goals, and the density under the wheel and at its shoulder. Runs are made
at three depths; rows between them are interpolated. Prints each trial and adds it to identified.csv beside this file.
"""
import argparse, csv, importlib.machinery, importlib.util, math, os, pathlib, sys

import numpy as np

sys.dont_write_bytecode = True
import report, study

here = pathlib.Path(__file__).resolve().parent
DEPTHS = (0.18, 0.20, 0.22)                                        # m
GOAL = dict(sinkage_m=0.012, resistance=0.031)                     # rms over rows
DENSITY = dict(density_under=(510, 150), density_shoulder=(290, 150))  # kg/m3: measured (TR), scale; weak, as all cannot be met together
STEP = 0.2        # of a logarithm, for differences: moves the residuals by ten times the runs' scatter or more
LARGEST = 0.5     # change of a logarithm in an iteration
SETTLED = 0.03    # relative gain of the sum of squares below which the search ends: the runs' scatter is as large

SEARCHED = {"zero_slip": ("p_510", "slope", "d"), "towed": ("tan_beta", "E", "p_510")}
START = {"zero_slip": dict(slope=16, d=6e3, tan_beta=math.tan(math.radians(22.53)), E=13.79e6, p_510=150e3),
         "towed": dict(slope=30, d=1000, tan_beta=math.tan(math.radians(57)), E=0.3e6, p_510=115e3)}


def law_of(parameters):
    """For study.power_law."""
    law = {name: float(f"{value:.4g}") for name, value in parameters.items() if name != "tan_beta"}
    return dict(law, beta=round(math.degrees(math.atan(parameters["tan_beta"])), 2))


class Search:
    def __init__(self, mode, searched, start, launch):
        self.mode, self.searched, self.start, self.launch = mode, searched, start, launch
        self.trials = []

    def parameters(self, theta):
        return dict(self.start, **{name: self.start[name] * math.exp(t) for name, t in zip(self.searched, theta)})

    def residuals(self, theta, note):
        """Of the rows, over the goals and the square root of their number; of the densities."""
        law = law_of(self.parameters(theta))
        label = "_".join(f"{name}{value:.4g}" for name, value in law.items())
        found = []
        for depth in DEPTHS:
            run = self.launch(f"{self.mode}_{label}_{100 * depth:.0f}cm", study.on_law(study.CALIBRATION["density"], depth, self.mode, law))
            if run["error"]:
                raise SystemExit(f"{run['run']}: {run['error']}")
            found.append(run)
        rows, out = [r for r in study.reference() if study.is_calibration(r)], []
        trial = dict(mode=self.mode, trial=note, **law)
        for what, goal in GOAL.items():
            wrong = np.array([np.interp(r["depth_m"], DEPTHS, [run[what] for run in found]) - r[what] for r in rows])
            trial[f"{what}_rms"], trial[f"{what}_mean"] = round(report.rms(list(wrong)), 4), round(float(wrong.mean()), 4)
            out += list(wrong / goal / math.sqrt(len(rows)))
        for what, (measured, scale) in DENSITY.items():
            trial[what] = round(np.mean([run[what] for run in found]))
            out.append((trial[what] - measured) / scale)
        out = np.array(out)
        trial["sum_of_squares"] = round(float(out @ out), 3)
        self.trials.append(trial)
        report.show([trial])
        return out

    def run(self, iterations):
        """Parameters of the smallest sum of squares."""
        theta, damping = np.zeros(len(self.searched)), 0.1
        r = self.residuals(theta, "start")
        for n in range(1, iterations + 1):
            columns = []
            for k, name in enumerate(self.searched):
                step = STEP * np.eye(len(theta))[k]
                columns.append((self.residuals(theta + step, f"{n}: {name}") - r) / STEP)
            J = np.array(columns).T
            for _ in range(3):
                H = J.T @ J
                change = -np.linalg.solve(H + damping * np.diag(np.diag(H)), J.T @ r)
                change *= min(1.0, LARGEST / np.abs(change).max())
                new = self.residuals(theta + change, f"{n}: step")
                gain = 1.0 - (new @ new) / (r @ r)
                if gain > 0:
                    theta, r, damping = theta + change, new, damping / 4
                    break
                damping *= 8
            if gain < SETTLED:
                break
        return min(self.trials, key=lambda trial: trial["sum_of_squares"])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mode", choices=START)
    parser.add_argument("--search", nargs="+", metavar="NAME", choices=list(START["towed"]))
    parser.add_argument("--start", nargs="+", metavar="NAME=VALUE", default=[])
    parser.add_argument("--iterations", type=int, default=4)
    parser.add_argument("--results", type=pathlib.Path, default=here.parents[2] / "results" / "snow_wheel")
    parser.add_argument("--furrow", type=pathlib.Path, default=pathlib.Path(os.environ.get("FURROW_BUILD", here.parents[2] / "build")) / "bin" / "furrow")
    arguments = parser.parse_args()
    if arguments.search and len(arguments.search) > 3:
        parser.error("at most three parameters")
    loader = importlib.machinery.SourceFileLoader("run", str(here / "run"))
    runner = importlib.util.module_from_spec(importlib.util.spec_from_loader("run", loader))
    loader.exec_module(runner)
    folder = arguments.results.resolve() / "identify"

    def launch(name, job):
        runner.launch(arguments.furrow.resolve(), folder / name, job)
        return report.evaluate(folder / name)
    start = dict(START[arguments.mode], **{name: float(value) for name, value in (pair.split("=") for pair in arguments.start)})
    search = Search(arguments.mode, arguments.search or SEARCHED[arguments.mode], start, launch)
    best = search.run(arguments.iterations)
    print("best:")
    report.show([best])
    path = here / "identified.csv"
    known = list(csv.DictReader(open(path))) if path.exists() else []
    report.write_table(path, [row for row in known if row["mode"] != arguments.mode] + search.trials)


if __name__ == "__main__":
    main()
