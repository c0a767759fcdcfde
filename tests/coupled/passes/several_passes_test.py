# SPDX-License-Identifier: GPL-2.0-or-later
"""Rolling in a rut: one wheel twice, or two wheels one behind the other; stopped in the middle of it
and continued.

    several_passes_test.py sand <furrow>        one wheel twice, on grains
    several_passes_test.py sand_axles <furrow>  two wheels on grains
    several_passes_test.py snow <furrow> <results of inputs/scenes/two_axles.lig in its quick version>

The run that continues gives the histories of the run in one, bit for bit. The second pass goes
deeper, with less resistance than the first. Each of two wheels carries its own load, and keeps its
own energy and momentum. Snow: a second wheel behind the first finds what the second pass of the
first finds; sinkage and resistance coefficient of wheels and passes differ by no more than three
standard errors of their difference, and the sinkage by what the load of the other wheel adds.
"""

import json
import math
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import columns, script_output

HERE = Path(__file__).resolve().parent
COVERAGE = 3.0  # standard errors
SWING = 0.02
# [m] Boussinesq's P (1 - nu^2)/(pi E r): the load of the other wheel of two_axles.lig, 1 m away, lowers
# elastic ground that is infinitely deep by this; E is that of the material times modulus_scale
NEIGHBOUR = 6237 * (1 - 0.3**2) / (math.pi * 0.25 * 13.79e6 * 1.0)
ROUNDING = 1e-10  # of the largest energy, force, moment
LOADS = {"": 40.0, "rear": 30.0}  # of sand_axles.lig [N]
LOAD_ERROR = 0.1  # of the load: the mean over a short way
QUANTITIES = ("hub_drop", "resistance_coefficient")
# variables by which a run continues from a checkpoint
CONTINUED = {"sand": lambda file: {"from": file}, "sand_axles": lambda file: {"from": file}, "snow": lambda file: {"continued": 1}}


def histories(results):
    """Columns of all wheels, by folder and name."""
    return {(path.parent.name, name): column for path in sorted(results.rglob("history.h5")) for name, column in columns(path).items()}


def summary_of(results):
    return json.loads((results / "summary.json").read_text())


def values(found):
    """(mean, standard error) of QUANTITIES; found: a summary, or a pass of one"""
    return {name: (found["quantities"][name]["mean"], found["quantities"][name]["standard_error"])
            for name in QUANTITIES}


def check_continued(furrow, case, folder):
    """The run is there; it is continued from its checkpoint, and gives the same again."""
    results = folder / "results"
    whole = histories(results)
    (checkpoint,) = (path for path in folder.glob("checkpoint.*") if path.is_file())
    script_output(furrow, HERE / f"{case}.lig", folder, **CONTINUED[case](checkpoint.name))
    parts = histories(results)
    assert whole.keys() == parts.keys()
    different = [name for name in whole if not np.array_equal(whole[name], parts[name])]
    assert not different, f"the run that continues has other values of {different}"


def check_passes(first, second):
    print(f"first pass {first}, second {second}")
    assert second["hub_drop"][0] > first["hub_drop"][0], "the second pass does not go deeper"
    assert second["resistance_coefficient"][0] < first["resistance_coefficient"][0], \
        "the second pass has no less resistance"


def check_alike(what, one, other, share=0.0):
    """share: of a mean, that means may differ by beyond their errors"""
    for name, (mean, error) in one.items():
        other_mean, other_error = other[name]
        allowed = COVERAGE * math.hypot(error, other_error) + share * abs(mean)
        allowed += NEIGHBOUR if name == "hub_drop" else 0.0
        print(f"{what}, {name}: {mean:.5g}, {other_mean:.5g}, allowed difference {allowed:.2g}")
        assert abs(mean - other_mean) <= allowed, f"{what}: {name} {mean:.5g} and {other_mean:.5g}"


def check_wheel(results, load):
    found = summary_of(results)
    carried, audit = found["quantities"]["force_z"]["mean"], found["audit"]
    print(f"{results.name}: carries {carried:.4g} of {load:g} N")
    assert abs(carried - load) <= LOAD_ERROR * load, "a wheel does not carry its own load"
    for part, whole in (("energy_residual", "energy_scale"), ("force_imbalance", "force_scale"),
                        ("moment_imbalance", "moment_scale")):
        assert abs(audit[part]) <= ROUNDING * audit[whole], f"{part} {audit[part]:.3g}"


def main(case, furrow, *axles):
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        results = folder / "results"
        script_output(furrow, HERE / f"{case}.lig", folder)
        if case == "sand_axles":
            for wheel, load in LOADS.items():
                check_wheel(results / wheel, load)
        else:
            first, second = map(values, summary_of(results)["passes"])
            check_passes(first, second)
        check_continued(furrow, case, folder)
    if axles:
        front = Path(axles[0])
        check_alike("front wheel, first pass", values(summary_of(front)), first)
        # the rear wheel still swings from the place where the front wheel stood
        check_alike("rear wheel, second pass", values(summary_of(front / "rear")), second, SWING)


if __name__ == "__main__":
    main(*sys.argv[1:])
