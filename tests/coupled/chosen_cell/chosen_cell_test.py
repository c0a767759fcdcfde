# SPDX-License-Identifier: GPL-2.0-or-later
"""Ground whose line has no cell gets it from the wheel that it follows.

The run prints cell, reason and error, and records the cell. It is the run with the same cells written out, bit by
bit, and so is a run that is continued. The printed errors are those of the error budget.

    chosen_cell_test.py <furrow>
"""

import re
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parents[k] / name) for k, name in ((1, "support"), (3, "postproc"))]
from furrow_post.read.results import Results
from furrow_post.uncertainty.model_error import Case
from furrow_post.uncertainty.whole_error import SCHEME, SIZES, like_wheels
from furrow_run import columns, run, script_output, words_of

HERE = Path(__file__).resolve().parent
CELL, WIDTH, DEPTH_OF_FINE = 0.02, 0.16, 0.18  # [m]: an eighth of the width; nine cells reach 1.1 widths
SMALL = 5e-4  # of errors with three digits


def check_error(said, ground):
    """The constants of the message are those of the budget of a driven smooth wheel."""
    hub_drop, pull = map(float, re.search(rf"smooth wheel on {ground}: hub drop (\S+) %, pull (\S+) of the load", said).groups())
    case = Case(ground, "rigid wheel", "driven", "no", 0.1, 0.0, 0.0, 0.2, 0.37)
    depth, coefficient = (like_wheels(SIZES.stored(), SCHEME.stored(), "continuum", CELL / WIDTH, case, key).size
                          for key in ("sinkage", "coefficient"))
    assert abs(hub_drop / 100 - depth) < SMALL and abs(pull - coefficient) < SMALL, (hub_drop, depth, pull, coefficient)


def same_history(one, other):
    one, other = (columns(folder / "results" / "history.h5") for folder in (one, other))
    assert len(one["time"]) > 35 and one.keys() == other.keys()
    for name, values in one.items():
        assert np.array_equal(values, other[name]), f"{name} differs by up to {np.abs(values - other[name]).max()}"


def main(furrow):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)

        def roll(part, **variables):
            return script_output(furrow, HERE / "wheel.lig", folder / part, here=HERE, **variables)

        said = roll("chosen")
        assert f"Cells of {CELL} m by the wheel's width; " in said, said
        check_error(said, "sand")
        soil = Results(folder / "chosen" / "results").styles().terrain()
        assert (soil.number("cell"), soil.number("fine_depth")) == (CELL, DEPTH_OF_FINE), vars(soil)

        said = roll("written", cells=f"cell {CELL} fine_depth {DEPTH_OF_FINE}")
        assert "Cells of" not in said, said
        same_history(folder / "chosen", folder / "written")

        roll("parts", until=250)
        roll("parts", continued=1)
        same_history(folder / "chosen", folder / "parts")
        other = {"here": HERE, "continued": 1, "cells": "cell 0.03"}
        refused = run([furrow, "-in", HERE / "wheel.lig", "-log", "none", *words_of(other)], folder / "parts")
        assert refused.status != 0 and "cell" in refused.text.partition("ERROR")[2], refused.text

        said = roll("deep", until=0, cells="fine_depth 0.1")
        assert f"Cells of {CELL} m by the wheel's width; " in said, said
        check_error(roll("snow", until=0, material="fresh_snow_cam_clay"), "snow")
        said = roll("clay", until=0, material="clay_soft")
        assert "for a driven smooth wheel on clay is not known" in said, said


if __name__ == "__main__":
    main(*sys.argv[1:])
