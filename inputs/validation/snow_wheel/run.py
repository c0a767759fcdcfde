#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid wheel on fresh snow, continuum: predicted from the oedometer, by laws identified on one
depth and density, and the error of both. See README.md.

Makes the runs that are missing and writes the tables and pictures beside this file. Stages: predict
rows flowing slope error design; the laws are identified by identify.py, the slope M by slope.py.
--check makes one run of the stage design, in seconds.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
import report

from furrow_post.study.study import Study, run_study

if __name__ == "__main__":
    study = Study(
        Path(__file__),
        __doc__ or "",
        tuple(cases.all_cases().values()),
        report.report,
        checked=lambda case: case.name == cases.CHECKED,
    )
    sys.exit(run_study(study))
