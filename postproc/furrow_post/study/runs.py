# SPDX-License-Identifier: GPL-2.0-or-later
"""The runs of a study that are there, as its evaluation takes them."""

import csv
import fnmatch
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultsError
from .case import Case
from .record import Record
from .runner import Runner


@dataclass(frozen=True)
class Run:
    """One that ended, finished or failed."""

    case: Case
    folder: Path
    record: Record

    @property
    def name(self) -> str:
        return self.case.name

    @property
    def what(self) -> str:
        return self.case.what

    @property
    def error(self) -> str:
        return self.record.error

    @property
    def seconds(self) -> float:
        """Of one core, to a tenth."""
        return round(self.record.cpu_time, 1)

    def number(self, variable: str, default: float = 0.0) -> float:
        """A variable of the script as the case has it."""
        return float(str(self.case.variables.get(variable, default)))


class Runs:
    """Of all cases of a study."""

    def __init__(self, cases: Sequence[Case], runner: Runner) -> None:
        self.cases, self.runner = cases, runner

    def ended(self, *names: str) -> list[Run]:
        """Whose stage or name is among names, which may be patterns, in the order of the study."""
        chosen = [c for c in self.cases if any(n == c.stage or fnmatch.fnmatchcase(c.name, n) for n in names)]
        found = ((case, self.runner.ended(case)) for case in chosen)
        return [Run(case, self.runner.folder(case), record) for case, record in found if record]

    def done(self, *names: str) -> list[Run]:
        """The same, without those that failed."""
        return [run for run in self.ended(*names) if not run.error]

    def resistance(self, run: Run, *options: object) -> list[dict[str, float]]:
        """The lines that furrow-resistance prints of a run, with --csv or --curve. @raises ResultsError"""
        program = self.runner.tools.program("furrow-resistance")
        command = [str(word) for word in (program, *options, run.folder)]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            cause = done.stderr.strip() or f"status {done.returncode}"
            raise ResultsError(f"{run.folder}: furrow-resistance stopped: {cause}")
        return [
            {name: float(text) for name, text in row.items() if name != "folder" and text}
            for row in csv.DictReader(done.stdout.splitlines())
        ]

    def one(self, name: str) -> Run | None:
        """The finished run of this name."""
        found = self.done(name)
        return found[0] if found else None
