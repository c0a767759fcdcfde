# SPDX-License-Identifier: GPL-2.0-or-later
"""By which program the runs of a stored table were made, and whether numbers have moved since.

provenance.csv of a study names commits. changes.csv is written by hand when a change of the
programs moves stored numbers: the studies that it reaches, and the commits that come before it.
"""

from functools import cache
from pathlib import Path
from typing import NamedTuple

from furrow_post.csv_table import read_rows
from furrow_post.study.provenance import read_origins

CHANGES = Path(__file__).resolve().parent / "changes.csv"
OLD = "old"


class Change(NamedTuple):
    """Of the programs, which moved stored numbers."""

    commit: str
    studies: frozenset[str]  # whose runs it reaches
    before: frozenset[str]  # commits that do not have it


@cache
def changes() -> tuple[Change, ...]:
    return tuple(
        Change(row["commit"], frozenset(row["studies"].split()), frozenset(row["before"].split()))
        for row in read_rows(CHANGES)
    )


def commits(table: Path) -> list[str]:
    """Of the source trees of the table's runs; none where that is not known."""
    origin = read_origins(table.parent).get(table.name)
    known = (commit.rstrip("+") for commit in origin.commit.split()) if origin else ()
    return list(dict.fromkeys(known))


def is_old(study: str, commit: str) -> bool:
    """Whether a change reaches the study and the commit does not have it."""
    return any(study in change.studies and commit in change.before for change in changes())


def cell(table: Path) -> str:
    """The commits of a table, with a word behind those that are old."""
    study = table.parent.name
    return ", ".join(
        f"{commit} {OLD}" if is_old(study, commit) else commit for commit in commits(table)
    )
