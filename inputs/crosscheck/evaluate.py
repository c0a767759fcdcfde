# SPDX-License-Identifier: GPL-2.0-or-later
"""A test on grains and on continuum, side by side: results.csv, the page's table, figures.

Grounds are compared with furrow-post's own comparison. Stages are the cases.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from cases import Made, plan
from lines import HEAD, OutputRow, table
from plate_cases import PlateCase
from series import draw_series, lines_of_series
from wheel_cases import WheelCase, cited_lines, cited_table

from furrow_post.run.case import Case
from furrow_post.study.study_files import Output
from furrow_post.study.runs import Runs


def cases() -> list[Case]:
    return [planned.run for planned in plan()]


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    lines: list[OutputRow] = list(cited_lines())
    plans = plan()
    for name in dict.fromkeys(planned.case for planned in plans):
        own = [planned for planned in plans if planned.case == name]
        made = Made(runs.executor, own)
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
