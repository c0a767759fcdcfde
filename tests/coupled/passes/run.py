# SPDX-License-Identifier: GPL-2.0-or-later
"""A wheel that rolls twice in its rut, stopped in the middle of the second pass and continued.

    run.py sand <furrow>
    run.py snow <furrow> <results of inputs/scenes/two_axles.lig in its quick version>

On both grounds the run that continues gives the history of the run in one, bit for bit, and the
second pass goes deeper with less resistance than the first. Snow: a second wheel on an axle behind
the first finds what the second pass of the first finds; sinkage and resistance coefficient of the
wheels and of the passes differ by no more than three standard errors of their difference.
"""

import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
COVERAGE = 3.0  # standard errors
CHECKPOINT = "checkpoint.*"
# what makes a run continue from a checkpoint
CONTINUED = {"sand": lambda file: ("from", file), "snow": lambda file: ("continued", "1")}


def run(furrow, case, folder, *variables):
    words = [furrow, "-in", HERE / f"{case}.lig", "-log", "none"]
    if variables:
        words += ["-var", *variables]
    done = subprocess.run(words, cwd=folder, text=True, stdin=subprocess.DEVNULL, timeout=500,
                          env={**os.environ, "FURROW_CACHE": str(folder / "cache")},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"status {done.returncode}:\n{done.stdout[-4000:]}")


def columns(results):
    with h5py.File(results / "history.h5") as file:
        return {name: column[()] for name, column in file["history"].items()}


def check_continued(whole, parts):
    assert whole.keys() == parts.keys()
    different = [name for name in whole if not np.array_equal(whole[name], parts[name])]
    assert not different, f"the run that continues has other values of {', '.join(different)}"


def values(results, of_pass=None):
    """(mean, standard error) of sinkage and resistance coefficient."""
    summary = json.loads((results / "summary.json").read_text())
    found = summary if of_pass is None else summary["passes"][of_pass]
    return {name: (found["quantities"][name]["mean"], found["quantities"][name]["standard_error"])
            for name in ("sinkage", "resistance_coefficient")}


def check_alike(what, one, other):
    for name, (mean, error) in one.items():
        other_mean, other_error = other[name]
        allowed = COVERAGE * math.hypot(error, other_error)
        print(f"{what}, {name}: {mean:.5g}, {other_mean:.5g}, allowed difference {allowed:.2g}")
        assert abs(mean - other_mean) <= allowed, f"{what}: {name} {mean:.5g} and {other_mean:.5g}"


def main(case, furrow, *axles):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        run(furrow, case, folder)
        results = folder / "results"
        whole = columns(results)
        first, second = values(results, 0), values(results, 1)

        checkpoint, = folder.glob(CHECKPOINT)
        run(furrow, case, folder, *CONTINUED[case](checkpoint.name))
        check_continued(whole, columns(results))
    stages = whole["stage"][whole["pass"] == 2]
    assert {0, 1, 2} <= set(stages), "the second pass has no cruise"
    print(f"{case}: first pass {first}, second {second}")
    assert second["sinkage"][0] > first["sinkage"][0], "the second pass does not go deeper"
    assert second["resistance_coefficient"][0] < first["resistance_coefficient"][0], \
        "the second pass has no less resistance"
    if axles:
        check_alike("front wheel, first pass", values(Path(axles[0])), first)
        check_alike("rear wheel, second pass", values(Path(axles[0]) / "rear"), second)


if __name__ == "__main__":
    main(*sys.argv[1:])
