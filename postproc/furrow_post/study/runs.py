# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of a study that are there, as its evaluation takes them."""

import csv
import fnmatch
from collections.abc import Sequence

from ..run.case import Case
from ..run.executor import Executor, Run
from ..run.tools import answer

__all__ = ["Run", "Runs"]  # names that evaluations import


class Runs:
    """Runs of all cases of a study."""

    def __init__(self, cases: Sequence[Case], executor: Executor) -> None:
        self.cases, self.executor = cases, executor

    def ended(self, *names: str) -> list[Run]:
        """Whose stage or name is among names, which may be patterns, in the order of the study."""
        chosen = [c for c in self.cases if any(n == c.stage or fnmatch.fnmatchcase(c.name, n) for n in names)]
        return [run for case in chosen if (run := self.executor.ended(case))]

    def done(self, *names: str) -> list[Run]:
        """Rows of the runs that succeeded."""
        return [run for run in self.ended(*names) if not run.error]

    def resistance(self, run: Run, *options: object) -> list[dict[str, float]]:
        """The lines that furrow-resistance prints of a run, with --csv or --curve. @raises ResultsError"""
        program = self.executor.tools.program("furrow-resistance")
        table = answer([program, *options, run.folder])
        return [
            {name: float(text) for name, text in row.items() if name != "folder" and text}
            for row in csv.DictReader(table.splitlines())
        ]

    def one(self, name: str) -> Run | None:
        """The finished run of this name."""
        found = self.done(name)
        return found[0] if found else None
