#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains: scatter of packings, influence of sizes, stiffness, step, rate and speed, cost. Makes the runs that are not there yet, writes results.csv and
the tables of README.md.

  inputs/validation/grains/run [--results FOLDER] [--only PATTERN] [--check]

Every variation is prepared anew (packed, settled) with its own numbers. FURROW_BUILD names the build. It may be stopped and started again.
--check: tables go to the results folder; exit status 1 when a limit below is missed (ctest study.grains).
"""
import argparse, csv, dataclasses, fnmatch, json, math, os, pathlib, resource, subprocess, sys

import numpy as np

here = pathlib.Path(__file__).resolve().parent
project = here.parents[2]
build = pathlib.Path(os.environ.get("FURROW_BUILD", project / "build"))
SEEDS = [86028121, 49979687, 67867967, 49979693, 67867979]


@dataclasses.dataclass
class Family:
    """A test, its base and what is changed one at a time: word -> (variables, packings)."""

    test: str          # of inputs/laboratory, or wheel_sand_grains, wheel_snow_grains of inputs/crosscheck
    ground: str
    base: dict
    changes: dict
    quantities: tuple  # of laboratory.json or summary.json
    packings: int      # of the base

    def runs(self):
        """(name, change, variables) of every run."""
        for change, (variables, packings) in {"base": ({}, self.packings), **self.changes}.items():
            for seed in SEEDS[:packings]:
                yield f"{change.replace(' ', '_').replace('/', '_')}_{seed}", change, {**self.base, **variables, "seed": seed}


STUDY = {
    "sand_triaxial": Family(
        "triaxial", "sand_dry", {"grains": 500, "confinement": 2e4, "rate": 0.4, "strain": 0.15}, {
            "1500 grains": ({"grains": 1500}, 2),
            "grains of 5 mm": ({"diameter": 0.005}, 2), "grains of 20 mm": ({"diameter": 0.02}, 2),
            "E 1e7 Pa": ({"young": 1e7, "confined_stiffness": 5e6}, 2), "E 3e7 Pa": ({"young": 3e7, "confined_stiffness": 1e7}, 2),
            "E 3e8 Pa": ({"young": 3e8, "confined_stiffness": 4e7}, 2),
            "half the step": ({"step_share": 0.1}, 2), "twice the step": ({"step_share": 0.4}, 2),
            "half the rate": ({"rate": 0.2}, 2), "four times the rate": ({"rate": 1.6}, 2),
        }, ("friction_angle_peak", "friction_angle_end"), 5),
    "snow_oedometer": Family(
        "oedometer", "snow", {"grains": 600, "stress": 1.1e6, "rate": 2, "strain": 1.25}, {
            "1500 clusters": ({"grains": 1500}, 2),
            "clusters of 10 mm": ({"diameter": 0.01}, 2), "clusters of 40 mm": ({"diameter": 0.04}, 2),
            "stiffness x 2": ({"stiffness": 6.24e6}, 2), "stiffness / 2": ({"stiffness": 1.56e6}, 2),
            "half the step": ({"step_share": 0.04}, 2), "twice the step": ({"step_share": 0.16}, 2),
            "half the rate": ({"rate": 1}, 2), "three times the rate": ({"rate": 6}, 2),
            "120 kg/m3": ({"bulk": 120, "strain": 1.8}, 1), "300 kg/m3": ({"bulk": 300, "strain": 0.9}, 1),
        }, ("rms_ln_stress", "density_100kPa"), 5),
    "sand_wheel": Family(
        "wheel_sand_grains", "sand_dry", {"diameter": 0.045}, {
            "grains of 34 mm": ({"diameter": 0.034}, 2), "grains of 27 mm": ({"diameter": 0.027}, 1),
            "E 1e7 Pa": ({"young": 1e7}, 1), "E 3e7 Pa": ({"young": 3e7}, 1),
            "half the step": ({"step_share": 0.1}, 1), "twice the step": ({"step_share": 0.4}, 1),
            "half the speed": ({"speed": 0.5}, 1), "twice the speed": ({"speed": 2}, 1),
        }, ("sinkage", "resistance_coefficient"), 3),
    "snow_wheel": Family(
        "wheel_snow_grains", "snow", {"diameter": 0.045}, {
            "clusters of 35 mm": ({"diameter": 0.035}, 2), "clusters of 28 mm": ({"diameter": 0.028}, 1),
            "stiffness x 2": ({"stiffness": 6.24e6}, 1), "stiffness / 2": ({"stiffness": 1.56e6}, 1),
            "half the step": ({"step_factor": 0.5}, 1), "twice the step": ({"step_factor": 2}, 1),
            "half the speed": ({"speed": 1.1175}, 1), "twice the speed": ({"speed": 4.47}, 1),
        }, ("sinkage", "resistance_coefficient"), 3),
}
WORDS = {"friction_angle_peak": "peak angle, degrees", "friction_angle_end": "angle at the end, degrees", "rms_ln_stress": "rms ln(stress) to Abele and Gow",
         "density_100kPa": "kg/m3 at 100 kPa", "sinkage": "sinkage, m", "resistance_coefficient": "resistance coefficient"}

# Limits of the check on the mean of the base's packings: what was reached (README.md), with their scatter.
LIMITS = {("sand_triaxial", "friction_angle_end"): (25.0, 30.0), ("snow_oedometer", "rms_ln_stress"): (0.10, 0.36)}


def command(family, target, variables):
    words = [word for name, value in variables.items() for word in (name, f"{value:g}" if isinstance(value, float) else str(value))]
    if family.test.startswith("wheel"):
        scenes = project / "inputs" / "crosscheck"
        start = [str(build / "bin" / "furrow"), "-in", str(scenes / f"{family.test}.lig"), "-log", str(target / "log.liggghts"), "-var", "here", str(scenes),
                 "-var", "results", str(target)]
        return start + [word for k in range(0, len(words), 2) for word in ("-var", *words[k:k + 2])]
    start = [str(project / "inputs" / "laboratory" / "run"), family.test, "--ground", family.ground, "-o", str(target)]
    if family.test == "oedometer":
        start += ["--reference", str(project / "inputs" / "validation" / "snow_oedometer" / "reference.csv")]
    return start + [word for k in range(0, len(words), 2) for word in ("-v", *words[k:k + 2])]


def made(target):
    return (target / "cpu.txt").exists()


def make(family, target, variables):
    target.mkdir(parents=True, exist_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    finished = subprocess.run(command(family, target, variables), capture_output=True, text=True, cwd=target)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if finished.returncode:
        sys.exit(f"{target} failed: {finished.stderr or finished.stdout[-600:]}")
    (target / "cpu.txt").write_text(f"{after.ru_utime - before.ru_utime:.1f}\n")
    print(f"{target.parent.name}/{target.name} {after.ru_utime - before.ru_utime:.1f} s", flush=True)


def values(target, quantities):
    """Values of a run; NaN for what the run did not reach."""
    if (target / "laboratory.json").exists():
        found = json.loads((target / "laboratory.json").read_text())["quantities"]
        return [found[name]["value"] if name in found else math.nan for name in quantities]
    found = json.loads((target / "summary.json").read_text())["quantities"]
    return [found[name]["mean"] for name in quantities]


def summary(rows, quantities):
    """change -> (number, [mean], [standard deviation of a packing], CPU seconds)."""
    found = {}
    for change in dict.fromkeys(row[1] for row in rows):
        these = np.array([row[3] for row in rows if row[1] == change])
        spread = these.std(axis=0, ddof=1) if len(these) > 1 else np.full(len(quantities), math.nan)
        found[change] = len(these), these.mean(axis=0), spread, np.mean([row[4] for row in rows if row[1] == change])
    return found


def table(name, family, found):
    """Markdown: every change against the base, with the error of the difference from the scatter of the base's packings."""
    lines = [f"**{name.replace('_', ' ')}**: " + ", ".join(f"{key} {value:g}" for key, value in family.base.items()), "",
             "| | packings | " + " | ".join(f"{WORDS[q]} | against base" for q in family.quantities) + " | CPU s |",
             "|---" * (2 * len(family.quantities) + 3) + "|"]
    number, base, spread, _ = found["base"]
    for change, (n, mean, _, cpu) in found.items():
        cells = [change, str(n)]
        for k in range(len(family.quantities)):
            digits = 1 if abs(base[k]) > 10 else 3
            error = spread[k] * math.sqrt(1 / n + 1 / number)
            cells += [f"{mean[k]:.{digits}f}" + (f", scatter {spread[k]:.{digits}f}" if change == "base" else ""),
                      "" if change == "base" else f"{mean[k] - base[k]:+.{digits}f} ± {error:.{digits}f}"]
        lines.append("| " + " | ".join(cells) + f" | {cpu:.0f} |")
    return lines + [""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=pathlib.Path, default=project / "results" / "grains")
    parser.add_argument("--only", default="*", help="runs to make: a pattern of family/run, e.g. 'sand_triaxial/*'")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.results.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    rows, lines, missed = [], [], []
    for name, family in STUDY.items():
        own = []
        for run, change, variables in family.runs():
            target = folder / name / run
            if fnmatch.fnmatch(f"{name}/{run}", arguments.only) and not made(target):
                make(family, target, variables)
            if made(target):
                own.append((run, change, variables, values(target, family.quantities), float((target / "cpu.txt").read_text())))
        rows += [[name, run, change, variables["seed"], *(f"{v:.6g}" if k == 1 else v for pair in zip(family.quantities, value) for k, v in enumerate(pair)), cpu]
                 for run, change, variables, value, cpu in own]
        if sum(row[1] == "base" for row in own) < 2:
            missed += [f"{name}: fewer than two packings of the base were run" for limited, _ in LIMITS if limited == name]
            continue
        found = summary(own, family.quantities)
        lines += table(name, family, found)
        for k, quantity in enumerate(family.quantities):
            low, high = LIMITS.get((name, quantity), (-math.inf, math.inf))
            if not low <= found["base"][1][k] <= high:
                missed.append(f"{name}: {quantity} {found['base'][1][k]:.3f} is not in [{low}, {high}]")
    print("\n".join(lines))
    with open((folder if arguments.check else here) / "results.csv", "w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([["family", "run", "change", "seed", "quantity_1", "value_1", "quantity_2", "value_2", "cpu_s"]] + rows)
    if arguments.check:
        sys.exit("Missed: " + "; ".join(missed) if missed else 0)
    page = here / "README.md"
    before, _, rest = page.read_text(encoding="utf-8").partition("<!-- written by ./run -->")
    after = rest.partition("<!-- end -->")[2]
    page.write_text(before + "<!-- written by ./run -->\n\n" + "\n".join(lines) + "\n<!-- end -->" + after, encoding="utf-8")


if __name__ == "__main__":
    main()
