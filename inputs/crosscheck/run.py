#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Cross-checks: the same test on grains and on continuum, side by side. See README.md.

Makes the runs of cases.csv that are missing, compares the grounds with furrow-post's
own comparison, and writes results.csv, README.md's table and the figures of this folder. Stages are
the cases; '*/continuum_*' are the runs of one ground.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

from cases import Made, plan
from lines import HEAD, OutputRow, table
from plate_cases import PlateCase
from series import draw_series, lines_of_series
from wheel_cases import WheelCase, cited_lines, cited_table

from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    lines: list[OutputRow] = list(cited_lines())
    plans = plan()
    for name in dict.fromkeys(planned.case for planned in plans):
        own = [planned for planned in plans if planned.case == name]
        made = Made(runner, own)
        if own[0].of_wheel:
            wheels = WheelCase(name, made)
            if wheels.complete:
                lines += [*wheels.lines(), *wheels.flow(output)]
                wheels.draw(output)
            bases = [line for line in lines if line["case"] == name]
            points = list(lines_of_series(made, cited_table(name) or wheels.table, bases))
            lines += points
            if points:
                draw_series(name, [*bases, *points], output.path(f"{name}_series.png"))
        else:
            plates = PlateCase(name, made)
            if len(plates.bases) > 1:
                lines += plates.lines()
                plates.draw(output)
    output.table("results.csv", lines, HEAD)
    output.section(table(lines))
    return []


if __name__ == "__main__":
    cases = tuple(planned.run for planned in plan())
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", cases, evaluate)))
