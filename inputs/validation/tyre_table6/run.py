#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tyre of [Shoop2001] on a rigid plane (Table 6): identification at two pressures, prediction
of the other two, and what lies around it. See README.md.

Makes the runs that are missing and prints and writes one table per part. --check makes Table 6
alone with the tyre file as it stands, and fails beyond the goals: area within 10 % everywhere,
deflection within 10 % at 103 and 241 kPa and 15 % at 138 and 179 kPa.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
import report

from furrow_post.study.case import Case
from furrow_post.study.study import Study, run_study


def in_table6(case: Case) -> bool:
    return case is cases.TABLE6


if __name__ == "__main__":
    study = Study(
        Path(__file__), __doc__ or "", cases.CASES, report.evaluate, checked=in_table6
    )
    sys.exit(run_study(study))
