# SPDX-License-Identifier: GPL-2.0-or-later
"""Compares the values of a study, made again, with the stored ones, and adds up what its runs cost."""

from collections.abc import Iterable, Iterator
from pathlib import Path

from ..csv_table import read_rows
from .values import StudyValue

TOLERANCE = 0.03  # of the stored number: what another processor or compiler may change
COSTS = ("user_s", "cpu_s")  # columns of a study's tables with the core seconds of a run
LISTED = "costs.csv"  # table of a study with every run's


def missed(values: Iterable[StudyValue], made: Path, whole: bool) -> Iterator[str]:
    """Sentences about the values that the tables of a folder have otherwise than they are stored.

    whole: of all values, not of those alone whose runs cost seconds
    """
    for value in values:
        if value.stored and (whole or value.cheap) and (sentence := difference(value, made)):
            yield f"{value.id}: {sentence}"


def difference(value: StudyValue, made: Path) -> str:
    """Difference that counts: of a limit the verdict, of others the number; beyond TOLERANCE the error of its time
    average, not how far the next size is. @raises ResultsError"""
    stored, again = value.computed(), value.computed(made)
    assert stored is not None and again is not None
    if value.limit:
        verdicts = value.verdict(), value.verdict(made)
        return "" if len(set(verdicts)) == 1 else f"{again:g} is {verdicts[1]}, not {verdicts[0]}"
    allowed = max(TOLERANCE * abs(stored), value.time_error())
    return "" if abs(again - stored) <= allowed else f"{again:g}, not {stored:g} ± {allowed:.2g}"


def known_cost(folder: Path) -> float:
    """Core seconds of all runs of a study, as its stored tables have them; 0: not known.

    A run of several tables counts once: by its name, or where the study lists its costs
    by that list alone.
    """
    per_run = dict[str, float]()
    tables = [folder / LISTED] if (folder / LISTED).is_file() else sorted(folder.glob("*.csv"))
    for table in tables:
        for index, row in enumerate(read_rows(table)):
            if row.get("quantity") in COSTS:  # a table with a column for each run
                runs = {run: text for run, text in row.items() if run != "quantity" and text}
                per_run.update({run: float(text) for run, text in runs.items()})
                continue
            name = row.get("run") or row.get("case") or f"{table.name} {index}"
            name = f"{row.get('family', '')}/{name}"  # grains has runs of one name in several
            for column in COSTS:
                if row.get(column):
                    per_run[name] = float(row[column])
    return sum(per_run.values())
