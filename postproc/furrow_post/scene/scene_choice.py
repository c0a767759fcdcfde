# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs that a table of errors recommends for a wanted error, and whether the estimate was right."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..analyse import choice, cost, cost_table, measured_choice
from ..csv_table import read_comments
from ..errors import ResultsError
from ..programs import inputs_folder
from ..read.wheel_run import read_wheel_run


@dataclass(frozen=True)
class Chosen:
    """One run, or two that are to be extrapolated, the coarse one first."""

    runs: Sequence[Sequence[str]]  # scene and options of each
    reasons: Sequence[str]  # sentences


def table_of(scene: str) -> Path:
    """The table of errors of a scene. @raises ResultsError where there is none"""
    inputs = inputs_folder()
    name = f"{Path(scene).stem}.csv"
    found = []
    if inputs:
        # errors against a reference count where no numerical ones are known
        found = [inputs / "costs" / name, inputs / "costs" / f"errors_{name}"]
        found += sorted(inputs.glob(f"validation/*/errors_{name}"))
    for path in found:
        if path.is_file():
            return path
    raise ResultsError(
        f"errors of '{scene}' are not known: there is no table {found[0] if found else name}; "
        "'furrow-post cost --write' makes one from runs of other sizes"
    )


def _measurement(table: Path) -> str:
    try:
        return measured_choice.measurement(read_comments(table))
    except OSError:
        return ""  # the reader of the table reports it


def choose(table: Path, error: float) -> Chosen:
    """@raises ResultsError, OSError"""
    measured = _measurement(table)
    if measured:
        compared = measured_choice.read_compared(table)
        options = measured_choice.recommend(compared, error).options
        words = [word.replace("{inputs}", str(inputs_folder())) for word in shlex.split(options)]
        return Chosen([words], measured_choice.reasons(compared, error, measured))
    assessed = _assessed(table)
    run, within, pair = choice.choose(assessed, error)
    if pair:
        why = choice.reasons_of_pair(pair, run, within, error)
    else:
        why = choice.reasons(run, within, assessed, error)
    chosen = pair.runs if pair else (run,)
    return Chosen([shlex.split(one.row.options) for one in chosen], why)


def _assessed(table: Path) -> Sequence[cost.Assessed]:
    """Assessment of the runs that the table offers."""
    rows, comments = cost_table.read_table(table)
    runnable = {row.run for row in rows if row.options}
    found = [a for a in cost.assess(rows, cost_table.wanted_wheel(comments)) if a.row.run in runnable]
    if not found:
        raise ResultsError(f"{table}: no row says how to run it (column options)")
    return found


def outcome(table: Path, error: float, folders: Sequence[Path]) -> list[str]:
    """Sentences on whether the estimate was right. @raises ResultsError"""
    measured = _measurement(table)
    if measured:
        run = measured_choice.recommend(measured_choice.read_compared(table), error)
        return [
            f"Estimate: {run.describe()}. Errors and time are of the states that were compared "
            f"({measured}); this run is another one and is not judged."
        ]
    chosen, _, pair = choice.choose(_assessed(table), error)
    wanted = 2 if pair else 1
    if len(folders) != wanted:
        raise ResultsError(
            f"--held has {len(folders)} results folders; for this error the table's choice is {wanted}"
        )
    runs = [read_wheel_run(folder) for folder in folders]
    if pair:
        return choice.pair_held(pair, error, *runs)
    return choice.held(chosen, error, *runs)
