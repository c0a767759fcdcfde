# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of error against cost, from the runs of runs.csv, whose stages are the tables.

A table keeps the comments above its rows. The figure and the table of errors compare models of
the ground. They take models.csv and the wheel on sand of the cross-check.
"""

import math
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path

from furrow_post.analyse import cost_table
from furrow_post.csv_table import read_rows, write_rows
from furrow_post.errors import ResultsError
from furrow_post.figures.cost_figure import Answer, draw_models
from furrow_post.read.wheel_run import read_wheel_run
from furrow_post.run.case import Case, named_values, script_case
from furrow_post.study.study_files import Output
from furrow_post.study.runs import Runs

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent / "scenes"
SAND = HERE.parent / "crosscheck" / "wheel_on_sand_runs.csv"
PLANNED = read_rows(HERE / "runs.csv")
CASES = read_rows(HERE.parent / "crosscheck" / "cases.csv")
MODELS = "errors_wheel_on_scm.csv"
MODELS_HEAD = (
    "# reference: the continuum in cells of 33 mm",
    "# Rigid wheel on dry sand, 0.74 m x 0.272 m, 3120 N, slip 0, 1 m/s. hub_drop_error: difference from the",
    "# reference, numerical error and that of the reference (root sum square); cpu_time: s of one core.",
)
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
    """Of the wheel on sand by every model of the ground [m]. The reference with its error is the
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


def options_of(answer: Answer) -> str:
    """Scene and options of inputs/run that make a run of the cross-check."""
    size, here = 1e-3 * float(answer.label), "{inputs}/crosscheck"
    for row in CASES:
        variables = {name: str(value) for name, value in named_values(row["variables"]).items()}
        own = row["case"] == "wheel_on_sand" and row["ground"] == answer.model
        if not own or not row["role"].startswith(("base", "size")):
            continue
        if math.isclose(float(variables.get("cell") or variables["diameter"]), size, rel_tol=0.02):
            given = [word for pair in variables.items() for word in ("-v", *pair)]
            return shlex.join([f"{here}/{row['script']}.lig", "-v", "here", here, *given])
    raise ResultsError(f"{HERE}: no run of the cross-check has {answer.model} of {answer.label} mm")


def model_errors(answers: Sequence[Answer], reference: tuple[float, float]) -> list[dict[str, str | float]]:
    """Rows of errors_wheel_on_scm.csv. An error is the root sum square of three parts: the difference
    from the reference and both numerical errors."""
    value, error = reference
    simple = {row["model"]: row["options"] for row in read_rows(HERE / "models.csv")}
    return [
        {
            "run": f"{a.label} mm" if a.label else "card of the sand",
            "ground": a.model,
            "hub_drop_error": round(math.hypot(a.value - value, error, 0.0 if math.isnan(a.error) else a.error) / value, 3),
            "cpu_time": a.cpu_time,
            "options": simple.get(a.model) or options_of(a),
        }
        for a in answers
    ]


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
        print(f"{table}\n{cost_table.cost_report(rows)}\n")
    answers, reference = hub_drops()
    write_rows(output.path(MODELS), model_errors(answers, reference), MODELS_HEAD)
    draw_models(answers, reference, "hub drop", output.path("models.png"))
    return []
