# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the runs of a study that are not there yet, several at a time."""

import enum
import threading
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from pathlib import Path

from ..errors import Interrupted
from .case import Case
from .claim import claimed
from .launch import Tools, launch
from .progress import Progress
from .record import FAILED, FINISHED, Record, digest, digests, read_record

LOOK_EVERY = 1.0  # [s] at what is running


class State(enum.Enum):
    """Of a case in the results folder."""

    DONE = "done"
    FAILED = "failed"
    MISSING = "missing"


class Runner:
    """The runs of a study in its results folder.

    same_program: a run counts only when it was made by the executable and the input files as they
    are now (for tests); same_inputs: the input files alone; again: failed runs are made again.
    """

    def __init__(
        self,
        results: Path,
        tools: Tools,
        jobs: int = 1,
        same_program: bool = False,
        again: bool = False,
        same_inputs: bool = False,
    ) -> None:
        self.results, self.tools = results.resolve(), tools
        self.same_inputs = same_inputs or same_program
        self.jobs, self.same_program, self.again = jobs, same_program, again

    def folder(self, case: Case) -> Path:
        return self.results / case.name

    def record(self, case: Case) -> Record | None:
        """Of the finished run, or None."""
        return self._valid(case, FINISHED)

    def failure(self, case: Case) -> Record | None:
        """Of the failed run, whose error says why, or None."""
        return self._valid(case, FAILED)

    def ended(self, case: Case) -> Record | None:
        """Of the run, finished or failed, or None."""
        return self.record(case) or self.failure(case)

    def _valid(self, case: Case, file: str) -> Record | None:
        """The record in the folder, if it is of this very case."""
        record = read_record(self.folder(case) / file)
        if record is None or record.job != case.identity(self.tools.root):
            return None
        if self.same_program and record.program != digest(self.tools.program(case.program)):
            return None
        if self.same_inputs and record.inputs != digests(case.input_files()):
            return None
        return record

    def changed(self, case: Case) -> list[str]:
        """Input files that differ from those of the run, as far as its record has them."""
        record = self.ended(case)
        now = digests(case.input_files()) if record else {}
        return [name for name, found in record.inputs.items() if now.get(name) != found] if record else []

    def state(self, case: Case) -> State:
        if self.record(case):
            return State.DONE
        return State.FAILED if self.failure(case) else State.MISSING

    def missing(self, cases: Sequence[Case]) -> list[Case]:
        """Those that run() would make."""
        wanted = {State.MISSING, State.FAILED} if self.again else {State.MISSING}
        return [case for case in cases if self.state(case) in wanted]

    def forget(self, cases: Sequence[Case]) -> None:
        """Removes the records of failed runs, which are then missing."""
        for case in cases:
            (self.folder(case) / FAILED).unlink(missing_ok=True)

    def run(self, cases: Sequence[Case]) -> None:
        """Makes what is missing. Of cases that share something the first runs before the others.

        A failed run stops no other one. A run that another study makes at the same time is waited
        for and taken from it. @raises Interrupted; ResultsError without the program
        """
        missing = self.missing(cases)
        for program in {case.program for case in missing}:
            self.tools.program(program)
        progress = Progress(len(missing), self.jobs)
        for wave in _waves(missing):
            self._run_together(wave, progress)

    def _run_together(self, cases: Sequence[Case], progress: "Progress") -> None:
        stop = threading.Event()
        with ThreadPoolExecutor(self.jobs) as pool:
            futures: dict[Future[Record], Case] = {
                pool.submit(self._make, case, stop): case for case in cases
            }
            pending = set(futures)
            try:
                while pending:
                    done, pending = wait(pending, LOOK_EVERY, FIRST_COMPLETED)
                    for future in done:
                        progress.report(futures[future].name, future.result())
                    running = [futures[future] for future in pending if future.running()]
                    progress.show([self.folder(case) for case in running])
            except (Interrupted, KeyboardInterrupt):
                stop.set()
                progress.clear()
                pool.shutdown(cancel_futures=True)
                raise

    def _make(self, case: Case, stop: threading.Event) -> Record:
        """Makes a run, unless another study has made it since this one looked."""
        folder = self.folder(case)
        with claimed(folder, stop):
            made = self.record(case) if self.again else self.ended(case)
            return made or launch(case, folder, self.tools)


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
