# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes the runs of a list that are not there yet, several at a time; nothing else starts a run."""

import enum
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from ..errors import Interrupted, ResultsError
from ..formatting import duration
from .case import FOLDER, Case, Value
from .process import ERRORS, Ending, Job, Processes, output_lines
from .progress import Progress
from .record import FAILED, FINISHED, Record, claimed, digest, digests, forget, is_busy, read_record
from .tools import Tools

LOOK_EVERY = 1.0  # interval between looks at the running programs [s]
PROGRAM = ""  # name of the program's digest among those of files
PATIENCE = 10.0  # time in which a stopped run releases its folder [s]


class State(enum.Enum):
    """State of a case in the results folder."""

    DONE = "done"
    FAILED = "failed"
    MISSING = "missing"


@dataclass(frozen=True)
class Run:
    """A run that ended, finished or failed."""

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
        """Core time in seconds, rounded to a tenth."""
        return round(self.record.cpu_time, 1)

    def number(self, variable: str, default: float = 0.0) -> float:
        """A variable of the script as the case has it."""
        return float(str(self.case.variables.get(variable, default)))


class Failed(ResultsError):
    """A run stopped with an error."""

    def __init__(self, run: Run) -> None:
        super().__init__(f"{run.folder} failed: {run.error}; its output is in screen.txt there")
        self.status = run.record.status or 1


@dataclass(eq=False)
class Executor:
    """The runs of a list in a results folder. One counts only while its program and its input files are the same."""

    results: Path
    tools: Tools
    jobs: int = 1  # runs at a time
    again: bool = False  # failed runs are repeated
    low_priority: bool = True  # runs yield to other work
    watch: bool = False  # lines of the program go to the screen, instead of one line per run

    def __post_init__(self) -> None:
        self.results = self.results.resolve()

    def folder(self, case: Case) -> Path:
        return self.results / case.name

    def ended(self, case: Case) -> Run | None:
        """The finished run of this very case, else the failed one, whose error says why, or None."""
        valid = (record for record in self._stored(case) if not self._changed(case, record))
        return next((Run(case, self.folder(case), record) for record in valid), None)

    def _stored(self, case: Case) -> Iterator[Record]:
        """Records of a run with these arguments, variables and texts, whatever has changed since."""
        for file in (FINISHED, FAILED):
            record = read_record(self.folder(case) / file)
            if record and record.job == case.identity(self.tools.root):
                yield record

    def _changed(self, case: Case, record: Record) -> list[str]:
        """Names of the program and of input files that differ from those of a run."""
        now, then = self.digests_now(case), {PROGRAM: record.program, **record.inputs}
        differing = [name for name in {**then, **now} if now.get(name) != then.get(name)]
        return [case.program if name == PROGRAM else name for name in differing]

    def digests_now(self, case: Case) -> dict[str, str]:
        """Digests of all input files and of the program, which has none where it is not built."""
        program = self._built(case.program)
        return {PROGRAM: digest(program) if program else "", **digests(case.input_files(self._built("furrow")))}

    def _built(self, name: str) -> Path | None:
        try:
            return self.tools.program(name)
        except ResultsError:
            return None

    def outdated(self, cases: Sequence[Case]) -> str:
        """A sentence about stored runs that do not count, because something has changed; empty where all count."""
        stored = [(case, next(self._stored(case), None)) for case in cases]
        former = [(record, names) for case, record in stored if record and (names := self._changed(case, record))]
        if not former:
            return ""
        every = ", ".join(sorted({name for _, names in former for name in names}))
        cost = duration(sum(record.cpu_time for record, _ in former))
        return (
            f"{len(former)} runs in {self.results} do not count, because {every} changed since; "
            f"they took {cost} of one core"
        )

    def state(self, case: Case) -> State:
        run = self.ended(case)
        return State.MISSING if run is None else State.FAILED if run.error else State.DONE

    def missing(self, cases: Sequence[Case]) -> list[Case]:
        """Cases that run() would make."""
        wanted = {State.MISSING, State.FAILED} if self.again else {State.MISSING}
        return [case for case in cases if self.state(case) in wanted]

    def forget(self, cases: Sequence[Case]) -> None:
        """Removes the records of failed runs, which are then missing."""
        for case in cases:
            (self.folder(case) / FAILED).unlink(missing_ok=True)

    def completed(self, cases: Sequence[Case]) -> list[Run]:
        """Makes what is missing; all runs in the order of the cases. @raises Failed for the first failure"""
        self._run(self.missing(cases), None, anew=False, stop=True)
        runs = [run for case in cases if (run := self.ended(case))]
        for run in runs:
            if run.error and not run.case.may_fail:
                raise Failed(run)
        return runs

    def run(self, cases: Sequence[Case], ended: Callable[[Case], None] | None = None) -> None:
        """Makes the missing runs. Among cases that share something the first runs before the others.

        A failed run stops no other one. A run that another program makes at the same time is waited
        for and taken from it. ended: takes each case whose run came to its end, one at a
        time, while others run.
        @raises Interrupted; ResultsError without the program
        """
        self._run(self.missing(cases), ended, anew=False)

    def repeat(self, cases: Sequence[Case], ended: Callable[[Case], None] | None = None) -> None:
        """Makes all runs, whatever is there. @raises Interrupted, ResultsError"""
        self._run(cases, ended, anew=True)

    def _run(
        self, cases: Sequence[Case], ended: Callable[[Case], None] | None, anew: bool, stop: bool = False
    ) -> None:
        """stop: starts no further run after a failure."""
        for program in {case.program for case in cases}:
            self.tools.program(program)
        if not anew and (sentence := self.outdated(cases)):
            print(f"Repeating: {sentence}", flush=True)
        progress = Progress(len(cases), self.jobs, self.watch)
        failures: list[Run] = []
        with Processes() as processes:

            def make(case: Case) -> Record:
                if failures:
                    raise Failed(failures[0])
                record = self._make(case, processes, progress, anew)
                if stop and record.error and not case.may_fail:
                    failures.append(Run(case, self.folder(case), record))
                return record

            for wave in _waves(cases):
                self._run_together(wave, make, ended, processes, progress)

    def _run_together(
        self,
        cases: Sequence[Case],
        make: Callable[[Case], Record],
        ended: Callable[[Case], None] | None,
        processes: Processes,
        progress: Progress,
    ) -> None:
        with ThreadPoolExecutor(self.jobs) as pool:
            futures: dict[Future[Record], Case] = {pool.submit(make, case): case for case in cases}
            pending = set(futures)
            try:
                while pending:
                    done, pending = wait(pending, LOOK_EVERY, FIRST_COMPLETED)
                    for future in done:
                        case = futures[future]
                        record = future.result()
                        progress.report(case.name, self.folder(case), record)
                        if ended and not record.error:
                            ended(case)
                    running = [futures[future] for future in pending if future.running()]
                    progress.show([self.folder(case) for case in running])
            except BaseException:
                processes.stop.set()
                progress.clear()
                pool.shutdown(cancel_futures=True)
                raise

    def _make(self, case: Case, processes: Processes, progress: Progress, anew: bool) -> Record:
        """Makes a run, unless another program has made it since this one looked."""
        folder = self.folder(case)
        with claimed(folder, processes.stop):
            former = None if anew else self.ended(case)
            if former and not (self.again and former.error):
                return former.record
            return self._launch(case, folder, processes, progress)

    def _launch(self, case: Case, folder: Path, processes: Processes, progress: Progress) -> Record:
        """Makes a run and writes its record.

        A run that fails is repeated with the variables of the case's fallback, if it has one and the
        time was not too short.
        """
        program = self.tools.program(case.program)
        _require_free(folder)
        forget(folder, checkpoints=not case.continued)
        for name, text in case.files.items():
            (folder / name).write_text(text.replace(FOLDER, str(folder)), encoding="utf-8")
        before = self.digests_now(case)
        started = datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
        show = progress.printer(case.name)

        def attempt(changes: Mapping[str, Value]) -> tuple[Ending, str]:
            ending = processes.run(Job(case, case.command(program, folder, changes), folder, show, self.low_priority))
            return ending, _error_of(ending, case, folder)

        changes: Mapping[str, Value] = {}
        stopped: list[str] = []
        ending, error = attempt(changes)
        if error and case.fallback and not ending.late:
            stopped.append(error)
            changes = case.fallback
            ending, error = attempt(changes)
        # A file that the run makes counts as it is after the run, one that was there before as it was
        found = {**self.digests_now(case), **before}
        record = Record(
            job=case.identity(self.tools.root),
            program=found.pop(PROGRAM),
            inputs=found,
            commit=self.tools.commit(),
            started=started,
            wall_time=round(ending.wall_time, 3),
            cpu_time=round(ending.cpu_time, 3),
            system_time=round(ending.system_time, 3),
            facts=_facts(folder),
            changes={name: str(value) for name, value in changes.items()},
            stopped=tuple(stopped),
            error=error,
            status=ending.status if ending.status >= 0 else 128 - ending.status,
            ranks=case.ranks,
            words=case.words,
            continued=case.continued,
        )
        record.write(folder)
        return record


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


def _require_free(folder: Path) -> None:
    """@raises ResultsError while furrow writes to the folder"""
    until = time.monotonic() + PATIENCE
    while is_busy(folder):
        if time.monotonic() > until:
            raise ResultsError(
                f"{folder}: another run is writing to it; wait until that run has ended"
            )
        time.sleep(0.1)


def _error_of(ending: Ending, case: Case, folder: Path) -> str:
    """Error of a run that did not come to its end; empty for one that did. @raises Interrupted"""
    if ending.late:
        return f"time limit of {case.time_limit:g} s"
    # mpirun may end with another status. A run that was killed before may write its checkpoint late.
    if ending.by_signal or (ending.status and any(folder.glob("restart_forced*")) and not case.continued):
        raise Interrupted(f"{folder} was interrupted; start again")
    if not ending.status:
        return ""
    return _error_text(folder) or f"stopped with status {ending.status}"


def _error_text(folder: Path) -> str:
    """The first line with LIGGGHTS's word ERROR, else the last line on stderr."""
    marked = [line.strip() for line in output_lines(folder) if "ERROR" in line]
    if marked:
        return marked[0]
    errors = folder / ERRORS
    lines = errors.read_text(errors="replace").splitlines() if errors.is_file() else []
    return next((line.strip() for line in reversed(lines) if line.strip()), "")


def _facts(folder: Path) -> dict[str, float]:
    """Values of the last line "FACTS name value name value ..."; empty where there is none."""
    found = [line.split()[1:] for line in output_lines(folder) if line.startswith("FACTS ")]
    if not found:
        return {}
    return {name: float(value) for name, value in zip(found[-1][::2], found[-1][1::2])}
