# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the runs of a study that are not there yet, several at a time."""

import enum
import time
from collections.abc import Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from pathlib import Path

from ..errors import Interrupted
from ..formatting import duration
from .case import Case
from .launch import Tools, launch
from .record import FAILED, FINISHED, Record, digest, read_record


class State(enum.Enum):
    """Of a case in the results folder."""

    DONE = "done"
    FAILED = "failed"
    MISSING = "missing"


class Runner:
    """The runs of a study in its results folder.

    same_program: a run counts only when it was made by the executable and the input files as they
    are now (for tests); again: failed runs are made again.
    """

    def __init__(
        self,
        results: Path,
        tools: Tools,
        jobs: int = 1,
        same_program: bool = False,
        again: bool = False,
    ) -> None:
        self.results, self.tools = results.resolve(), tools
        self.jobs, self.same_program, self.again = jobs, same_program, again

    def folder(self, case: Case) -> Path:
        return self.results / case.name

    def record(self, case: Case) -> Record | None:
        """Of the finished run, or None."""
        return self._valid(case, FINISHED)

    def failure(self, case: Case) -> Record | None:
        """Of the failed run, whose error says why, or None."""
        return self._valid(case, FAILED)

    def _valid(self, case: Case, file: str) -> Record | None:
        """The record in the folder, if it is of this very case."""
        record = read_record(self.folder(case) / file)
        if record is None or record.job != case.identity(self.tools.root):
            return None
        if self.same_program:
            present = {path.name: digest(path) for path in case.input_files()}
            program = self.tools.program(case.program)
            if record.program != digest(program) or record.inputs != present:
                return None
        return record

    def state(self, case: Case) -> State:
        if self.record(case):
            return State.DONE
        return State.FAILED if self.failure(case) else State.MISSING

    def missing(self, cases: Sequence[Case]) -> list[Case]:
        """Those that run() would make."""
        wanted = {State.MISSING, State.FAILED} if self.again else {State.MISSING}
        return [case for case in cases if self.state(case) in wanted]

    def run(self, cases: Sequence[Case]) -> None:
        """Makes what is missing. Of cases that share something the first runs before the others.

        A failed run stops no other one. @raises Interrupted; ResultsError without the program
        """
        missing = self.missing(cases)
        for program in {case.program for case in missing}:
            self.tools.program(program)
        progress = _Progress(len(missing), self.jobs)
        for wave in _waves(missing):
            self._run_together(wave, progress)

    def _run_together(self, cases: Sequence[Case], progress: "_Progress") -> None:
        with ThreadPoolExecutor(self.jobs) as pool:
            futures: dict[Future[Record], Case] = {
                pool.submit(launch, case, self.folder(case), self.tools): case for case in cases
            }
            try:
                for future in as_completed(futures):
                    progress.report(futures[future], future.result())
            except (Interrupted, KeyboardInterrupt):
                pool.shutdown(cancel_futures=True)
                raise


def _waves(cases: Sequence[Case]) -> list[list[Case]]:
    """First one of each group that shares something, and what shares nothing; then the others."""
    seen, first, others = set(), [], []
    for case in cases:
        if case.shares is not None and case.shares in seen:
            others.append(case)
        else:
            first.append(case)
            seen.add(case.shares)
    return [wave for wave in (first, others) if wave]


class _Progress:
    """Prints a line per run with the time that is left, from the mean of those before."""

    def __init__(self, runs: int, jobs: int) -> None:
        self.runs, self.jobs, self.done = runs, jobs, 0
        self.wall_time = 0.0  # of all that are done [s]

    def report(self, case: Case, record: Record) -> None:
        self.done += 1
        self.wall_time += record.wall_time
        left = self.runs - self.done
        seconds = self.wall_time / self.done * left / min(self.jobs, max(left, 1))
        rest = f", about {duration(seconds)} left" if left else ""
        print(
            f"{time.strftime('%H:%M:%S')}  {case.name:34} {record.wall_time:7.1f} s wall "
            f"{record.cpu_time:7.1f} s user  ({self.done} of {self.runs}{rest})"
            f"{'  ' + record.error if record.error else ''}",
            flush=True,
        )
