#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid wheel on dry sand: grains calibrated on plates, then the wheel, against CMU's measurements.
See README.md.

Makes the runs that are missing and writes calibration.csv, results.csv, checks.csv and
comparison.png. Stages: calibrate wheel checks. --check fails when a limit of cases.REACHED is
missed.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
import report

from furrow_post.study.study import Study, run_study

if __name__ == "__main__":
    study = Study(Path(__file__), __doc__ or "", tuple(cases.all_cases().values()), report.report)
    sys.exit(run_study(study))
