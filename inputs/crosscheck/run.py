#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cross-checks: the same test on grains and on continuum, side by side. See README.md.

Makes the runs of cases.csv that are missing, lays both grounds beside each other with furrow-post's
own comparison, and writes results.csv, README.md's tables and the figures of this folder. Stages
are the cases; '*/continuum_*' are the runs of one ground.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

from cases import Made, OutputRow, plan
from curve_cases import CurveCase, curve_section
from wheel_cases import WheelCase, wheel_section

from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

RESULTS_HEAD = (
    "# Written by run.py; SI units, uncertainties are standard deviations; empty: not known;",
    "# program: of the executable, SHA-256",
)


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    lines: list[str] = []
    out: list[OutputRow] = []
    plans = plan()
    for name in dict.fromkeys(planned.case for planned in plans):
        own = [planned for planned in plans if planned.case == name]
        made = Made(runner, own)
        if own[0].of_wheel:
            wheels = WheelCase(name, made)
            if wheels.complete:
                lines += wheel_section(wheels, output, out)
        else:
            case = CurveCase(name, made)
            if len(case.curves) > 1:
                lines += curve_section(case, output, out)
    print("\n".join(lines))
    output.table("results.csv", out, RESULTS_HEAD)
    output.section(lines)
    return []


if __name__ == "__main__":
    cases = tuple(planned.run for planned in plan())
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", cases, evaluate)))
