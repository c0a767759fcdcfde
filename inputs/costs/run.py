#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against cost: makes the runs of runs.csv that are missing and writes the tables of this
folder from them. See README.md.

Stages are the tables. A table keeps the comments above its rows. The figure compares models of the
ground: models.csv and the wheel on sand of the cross-check.
"""

import math
import shlex
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

from furrow_post.analyse import cost, cost_table
from furrow_post.csv_table import read_rows
from furrow_post.figures.cost import Answer, draw_models
from furrow_post.read.wheel_run import read_wheel_run
from furrow_post.study.case import Case
from furrow_post.study.furrow_cases import named_values, script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner, State
from furrow_post.study.study import Study, run_study

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes"
SAND = HERE.parent / "crosscheck" / "wheel_on_sand_runs.csv"
PLANNED = read_rows(HERE / "runs.csv")
TABLES = tuple(dict.fromkeys(row["table"] for row in PLANNED))


def options(row: Mapping[str, str]) -> str:
    """Scene and options of inputs/run that make this run; empty for one that is not offered."""
    if row["offered"] != "yes":
        return ""
    variables = named_values(row["variables"])
    given = [word for name, value in variables.items() for word in ("-v", name, str(value))]
    return shlex.join([row["scene"], *given])


def make_case(row: Mapping[str, str]) -> Case:
    name = f"{row['table']}/{row['run']}"
    script = SCENES / f"{row['scene']}.lig"
    return script_case(name, script, {**named_values(row["variables"]), "vtk": 0}, stage=row["table"])


def hub_drops() -> tuple[list[Answer], tuple[float, float]]:
    """Of the wheel on sand by every model of the ground [m], and the reference with its error: the
    continuum in the finest cells."""
    rows, _ = cost_table.read_table(SAND)
    found = {key.ground: family for key, family in cost_table.families(rows).items()}
    answers = [
        Answer(row["model"], "", float(row["cpu_time"]), float(row["sinkage"]), math.nan)
        for row in read_rows(HERE / "models.csv")
    ]
    for ground, family in found.items():
        for row in family.bases:
            error = family.components("sinkage", row.size, row.sinkage_error).total
            label = f"{1000 * row.size:.0f}"
            answers.append(Answer(ground, label, row.cpu_time, row.sinkage, error))
    return answers, found["continuum"].reference("sinkage")


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    for table in TABLES:
        planned = [(row, make_case(row)) for row in PLANNED if row["table"] == table]
        rows = [
            cost_table.row_of(read_wheel_run(runner.folder(case), row["run"]), options(row))
            for row, case in planned
            if runner.state(case) is State.DONE
        ]
        if not rows:
            continue
        _, comments = cost_table.read_table(HERE / f"{table}.csv")
        cost_table.write_table(output.path(f"{table}.csv"), rows, comments)
        assessed = cost.assess(rows, cost_table.wanted_wheel(comments))
        print(f"{table}\n{cost.cost_report(assessed, 0.1)}\n")
    draw_models(*hub_drops(), "hub drop", output.path("models.png"))
    return []


if __name__ == "__main__":
    cases = tuple(make_case(row) for row in PLANNED)
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", cases, evaluate)))
