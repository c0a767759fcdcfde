# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders as rows of a pandas table: variables, quantities with errors, facts, cost, error."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from ..csv_table import number_or_text
from ..errors import ResultsError, content_of
from .record import FAILED, FINISHED, Record, read_record
from .summary import Summary, whole_errors

SET = "set_"  # before the name of a variable of the script
# behind the name of a quantity: standard error over time, whole error where budget.json has it, whether it is steady
ERROR, WHOLE, STEADY = "_error", "_whole_error", "_steady"
FACTS = "facts.txt"  # names and values that a script of the laboratory writes
COSTS = {"wall_time": "s", "cpu_time": "s", "ranks": ""}
UNITS = "units"  # attribute of a table: column -> SI unit

Cell = str | float | bool


@dataclass
class Row:
    """One run; units: of the columns that have one."""

    cells: dict[str, Cell] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)


def read_row(folder: Path) -> Row:
    """The run of a results folder. A failed run has its message in the column error.

    @raises ResultsError where the folder has no run that ended
    """
    record = read_record(folder / FINISHED) or read_record(folder / FAILED)
    row = Row({"folder": str(folder)})
    if record:
        row.cells.update(_of_record(record))
    if not record or not record.error:
        _add_quantities(row, Summary(folder), whole_errors(folder))
        row.cells.update(read_facts(folder))
    if len(row.cells) == 1:
        raise ResultsError(f"{folder}: has no run that came to its end; start the run again")
    if record:
        row.cells.update({name: getattr(record, name) for name in COSTS}, error=record.error)
        row.units.update({name: unit for name, unit in COSTS.items() if unit})
    return row


def read_table(folders: Iterable[Path]) -> pd.DataFrame:
    """A row for each folder, in their order; attrs["units"] has the units. @raises ResultsError"""
    rows = [read_row(folder) for folder in folders]
    table = pd.DataFrame([row.cells for row in rows])
    table.attrs[UNITS] = {name: unit for row in rows for name, unit in row.units.items()}
    return table


def _of_record(record: Record) -> dict[str, Cell]:
    variables = record.job.get("variables")
    given = {**(variables if isinstance(variables, Mapping) else {}), **record.changes}
    set_by_user = {name: str(text) for name, text in given.items() if name != "results"}
    cells: dict[str, Cell] = {SET + name: number_or_text(text) for name, text in set_by_user.items()}
    return {**cells, **record.facts}


def _add_quantities(row: Row, summary: Summary, whole: Mapping[str, float]) -> None:
    for name in summary.quantities:
        value = summary.quantity(name)
        if value:
            row.cells |= {name: value.mean, name + ERROR: value.standard_error, name + STEADY: value.steady}
            row.cells |= {name + WHOLE: whole[name]} if name in whole else {}
            columns = (name, name + ERROR, *([name + WHOLE] if name in whole else []))
            row.units |= {column: value.unit for column in columns if value.unit}


def read_facts(folder: Path) -> dict[str, Cell]:
    """Names and values of facts.txt; empty where there is no such file. @raises ResultsError"""
    path = folder / FACTS
    if not path.is_file():
        return {}
    with content_of(path, "repeat the run: remove its folder"):
        words = path.read_text(encoding="utf-8").split()
        return {name: number_or_text(text) for name, text in zip(words[::2], words[1::2], strict=True)}
