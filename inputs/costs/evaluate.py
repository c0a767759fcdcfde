# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of error against cost, from the runs of runs.csv, whose stages are the tables.

A table keeps the comments above its rows.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from furrow_post.uncertainty import cost_table
from furrow_post.csv_table import read_rows
from furrow_post.read.wheel_run import read_wheel_run
from furrow_post.run.case import Case, named_values, script_case
from furrow_post.study.study_files import Output
from furrow_post.study.runs import Runs

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes"
PLANNED = read_rows(HERE / "runs.csv")
TABLES = tuple(dict.fromkeys(row["table"] for row in PLANNED))


def make_case(row: Mapping[str, str]) -> Case:
    name = f"{row['table']}/{row['run']}"
    script = SCENES / f"{row['scene']}.lig"
    return script_case(name, script, {**named_values(row["variables"]), "vtk": 0}, stage=row["table"])


def cases() -> list[Case]:
    return [make_case(row) for row in PLANNED]


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    planned = {make_case(row).name: row for row in PLANNED}
    for table in TABLES:
        rows = [
            cost_table.row_of(read_wheel_run(run.folder, planned[run.name]["run"]))
            for run in runs.done(table)
        ]
        if not rows:
            continue
        _, comments = cost_table.read_table(HERE / f"{table}.csv")
        cost_table.write_table(output.path(f"{table}.csv"), rows, comments)
        print(f"{table}\n{cost_table.cost_report(rows)}\n")
    return []
