#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The rigid wheel of [Shoop2001] as its report ran it, on the report's snow: which of its numbers
gives the sinkage of 8 cm, depth, slip and friction. See README.md.

Makes the runs that are missing and writes tables and figures. Stages: reading artefact domain
slip friction depth.
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
        cases.all_cases(),
        report.report,
        checked=lambda case: case.name in cases.CHECKED,
    )
    sys.exit(run_study(study))
