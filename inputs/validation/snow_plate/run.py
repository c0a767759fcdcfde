#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Plate of 20.32 cm into 50 cm of fresh snow, continuum, against the measured peak load. See
README.md.

Makes the runs that are missing and writes results.csv (cap laws and Cam clay), foam.csv,
curves.png, foam.png and density.png.
--check makes one of them, in seconds.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
import report

from furrow_post.study.study import Study, run_study

CHECKED = "fresh"  # run that is a test

if __name__ == "__main__":
    study = Study(
        Path(__file__),
        __doc__ or "",
        (*cases.CASES, *cases.CONFINED),
        report.evaluate,
        checked=lambda case: case.name == CHECKED,
    )
    sys.exit(run_study(study))
