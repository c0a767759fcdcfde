# SPDX-License-Identifier: GPL-2.0-or-later
"""Which test repeats a row of the table, and whether what it finds is still what is stored.

Runs of some seconds are repeated by bash tests/run, in the test validation.<study>; all others by
bash tests/run --studies, in study.<study>.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import experiments
from overview import Experiment, Stored

TOLERANCE = 0.03  # of the stored number: what another processor or compiler may change

Chosen = Callable[[Stored], bool]


def every(stored: Stored) -> bool:
    return True


def of_table(name: str) -> Chosen:
    return lambda stored: Path(stored.table).name == name


def of_run(name: str, key: str = "run") -> Chosen:
    return lambda stored: stored.row.get(key) == name


# Study -> rows whose runs its driver's --check makes: those of bash tests/run
CHEAP: dict[str, Chosen] = {
    "free_travel": lambda stored: False,  # its own check: both rigs at one slip
    "report_inputs": every,
    "report_wheel": of_run("d_30_cell_10"),
    "snow_oedometer": every,
    "snow_plate": of_run("fresh", key="case"),
    "snow_wheel": of_run("design_56x27cm"),
    "tyre_brick": lambda stored: False,  # its own check: a coarse mesh beside the stored one
    "tyre_on_snow": of_run("lift_plane"),
    "tyre_shift": of_table("modes.csv"),
    "tyre_table6": of_table("table6.csv"),
}


def rows(study: str) -> list[Experiment]:
    """Of the table, with a number of this study."""
    return [
        row
        for group in experiments.GROUPS
        for row in group.rows
        if row.ours and row.ours.study == study
    ]


def is_cheap(row: Experiment) -> bool:
    return bool(row.ours and CHEAP.get(row.ours.study, lambda stored: False)(row.ours))


def guard(row: Experiment) -> str:
    """Name of the test that repeats the row."""
    study = row.ours.study if row.ours else ""
    return f"validation.{study}" if is_cheap(row) else f"study.{study}"


def missed(study: str, made: Path, whole: bool) -> Iterator[str]:
    """Sentences about the rows whose numbers in the tables of a folder are not the stored ones.

    whole: of all rows of the study, not of the cheap ones alone
    """
    for row in rows(study):
        if row.ours and (whole or is_cheap(row)) and (sentence := difference(row, row.ours, made)):
            yield f"{row.place}, {row.what}, {row.quantity}: {sentence}"


def difference(row: Experiment, ours: Stored, made: Path) -> str:
    """Of a limit the verdict counts, of others the number. @raises ResultsError"""
    stored, again = ours.value(), ours.value(made)
    if row.limit or row.floor:
        verdicts = row.verdict(), row.verdict(again)
        return "" if len(set(verdicts)) == 1 else f"{again:g} is {verdicts[1]}, not {verdicts[0]}"
    allowed = max(TOLERANCE * abs(stored), row.error() or 0.0)
    return "" if abs(again - stored) <= allowed else f"{again:g}, not {stored:g} ± {allowed:.2g}"
