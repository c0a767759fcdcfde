#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The tyre with a tread of rubber of [Shoop2001] on a rigid plane: identification at two pressures,
prediction of the other two, contact stress, treads, rolling. See README.md.

Makes the runs that are missing and prints and writes one table per part. --check fails when the
stored Table 6 misses the goals of 10 %, or when one state of it on a coarse mesh, made again in
seconds, is no longer what is stored.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import cases
import report

from furrow_post.study.case import Case
from furrow_post.study.study import Study, run_study


def in_check(case: Case) -> bool:
    return case is cases.CHECK


if __name__ == "__main__":
    study = Study(
        Path(__file__), __doc__ or "", cases.CASES, report.evaluate, checked=in_check
    )
    sys.exit(run_study(study))
