# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of error against cost, from the runs of runs.csv, whose stages are the tables.

A table keeps the comments above its rows. The figure compares models of the ground: models.csv and
the wheel on sand of the cross-check.
"""

import math
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from furrow_post.analyse import cost, cost_table
from furrow_post.csv_table import read_rows
from furrow_post.figures.cost import Answer, draw_models
from furrow_post.read.wheel_run import read_wheel_run
from furrow_post.study.case import Case
from furrow_post.study.furrow_cases import named_values, script_case
from furrow_post.study.output import Output
from furrow_post.study.runs import Runs

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


def cases() -> list[Case]:
    return [make_case(row) for row in PLANNED]


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    planned = {make_case(row).name: row for row in PLANNED}
    for table in TABLES:
        rows = [
            cost_table.row_of(
                read_wheel_run(run.folder, planned[run.name]["run"]), options(planned[run.name])
            )
            for run in runs.done(table)
        ]
        if not rows:
            continue
        _, comments = cost_table.read_table(HERE / f"{table}.csv")
        cost_table.write_table(output.path(f"{table}.csv"), rows, comments)
        assessed = cost.assess(rows, cost_table.wanted_wheel(comments))
        print(f"{table}\n{cost.cost_report(assessed, 0.1)}\n")
    draw_models(*hub_drops(), "hub drop", output.path("models.png"))
    return []
