# SPDX-License-Identifier: GPL-2.0-or-later
"""Starts programs, passes signals on to them, asks them for checkpoints and shows their lines."""

import contextlib
import math
import os
import re
import select
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import FrameType, TracebackType
from typing import IO, Any

from ..errors import Interrupted
from ..whole_file import replaced
from .case import Case

CHECKPOINT = "checkpoint.data"  # the last one that a signal made
FORCED = "restart_forced_liggghts_*.data"  # name that LIGGGHTS gives, in the folder where the run started
PARTICLES = ".particles"  # ending of the folder next to a checkpoint, with the particles of terrain
LOOK_EVERY = 0.2  # [s] at the output of a program and at its checkpoints
SCREEN, ERRORS = "screen.txt", "errors.txt"  # stdout and stderr of the program
# Lines of furrow's output that go to the screen
SHOWN = re.compile(r"\[|.*ERROR|.*WARNING: *[^ ]|  at |.*Making the bed|run_until_steady")
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# furrow ends, with a checkpoint, when this program is killed
PREFIX = ("setpriv", "--pdeathsig", "TERM")
LOW_PRIORITY = ("nice", "-n", "10")
# Two runs at a time are not bound to the same cores; ranks have time to write a checkpoint
OPEN_MPI = {
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "OMPI_MCA_odls_base_sigkill_timeout": "10",
}
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


class Stopped(Interrupted):
    """A signal ended the runs."""

    def __init__(self, number: int) -> None:
        super().__init__(f"{signal.Signals(number).name} stopped the run", 128 + number)


@dataclass(frozen=True)
class Job:
    """A command of a case, where it starts, and what takes its lines."""

    case: Case
    command: Sequence[str]
    folder: Path  # folder of the output
    show: Callable[[str], None] | None = None  # takes each line for the screen
    low_priority: bool = False

    @property
    def start(self) -> Path:
        return self.case.start_in(self.folder)


@dataclass(frozen=True)
class Ending:
    """Ending of a program: status and reason."""

    status: int  # below 0: ended by this signal
    wall_time: float  # [s]
    cpu_time: float  # user time [s]
    system_time: float  # [s]
    late: bool  # killed at its time limit

    @property
    def by_signal(self) -> bool:
        """furrow takes a signal as a wish for a checkpoint and exits with 128 and its number."""
        return bool({-self.status, self.status - 128} & set(SIGNALS))


class Processes:
    """Programs started in a with statement. A signal to this program ends each with a checkpoint."""

    def __init__(self) -> None:
        self.stop = threading.Event()
        self._running: list[subprocess.Popen[bytes]] = []
        self._before: dict[int, Any] = {}
        self._signal = 0

    def __enter__(self) -> "Processes":
        if threading.current_thread() is threading.main_thread():
            for number in SIGNALS:
                if signal.getsignal(number) is not signal.SIG_IGN:  # nohup ignores SIGHUP
                    self._before[number] = signal.signal(number, self._pass_on)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, where: TracebackType | None
    ) -> None:
        for number, before in self._before.items():
            signal.signal(number, before)

    def _pass_on(self, number: int, _: FrameType | None) -> None:
        self._signal = self._signal or number
        self.stop.set()
        for process in list(self._running):
            send(process, number)

    def require_no_signal(self) -> None:
        """Ends the program if a signal has arrived. @raises Stopped after a signal"""
        if self._signal:
            raise Stopped(self._signal)

    def run(self, job: Job) -> Ending:
        """Runs a program to its end; its output goes to files of its folder. @raises Stopped"""
        self.require_no_signal()
        began, since = time.monotonic(), time.time_ns()
        prefix = (*PREFIX, *LOW_PRIORITY) if job.low_priority else PREFIX
        with open(job.folder / SCREEN, "wb") as screen, open(job.folder / ERRORS, "wb") as errors:
            process = subprocess.Popen(
                [*prefix, *job.command],
                cwd=job.start,
                env=environment(),
                stdin=subprocess.DEVNULL,
                stdout=screen,
                stderr=errors,
                start_new_session=True,  # the terminal's Ctrl-C comes from here alone
            )
        self._running.append(process)
        if self._signal:
            send(process, self._signal)
        with open(job.folder / SCREEN, "rb") as screen:
            late = _watch(process, job, screen, since)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self._running.remove(process)
        if job.case.keeps_checkpoint:
            keep_checkpoint(job.start, job.folder, since)
        if not (job.folder / ERRORS).stat().st_size:
            (job.folder / ERRORS).unlink()
        self.require_no_signal()
        wall_time = time.monotonic() - began
        return Ending(process.returncode, wall_time, usage.ru_utime, usage.ru_stime, late)


def _watch(process: "subprocess.Popen[bytes]", job: Job, screen: IO[bytes], since: int) -> bool:
    """Waits for the end of a program; whether it was killed at its time limit.

    From the first line for the screen on, SIGUSR1 asks for a checkpoint again and again: furrow
    writes it when neighbour lists are due anyway, so it does not change the run. A run that pours
    grains takes no notice, so it is asked again.
    """
    checkpoint = job.case.checkpoint or math.inf  # [s] between checkpoints
    limit = time.monotonic() + job.case.time_limit
    asked = math.inf
    part = b""
    end = os.pidfd_open(process.pid)
    try:
        ended = False
        while not ended:
            wait = min(LOOK_EVERY, max(limit - time.monotonic(), 0.0), checkpoint)
            ended = bool(select.select([end], [], [], wait)[0])
            *lines, part = (part + screen.read() + (b"\n" if ended else b"")).split(b"\n")
            for line in lines:
                text = line.decode("utf-8", "replace")
                if SHOWN.match(text):
                    asked = min(asked, time.monotonic())
                    if job.show:
                        job.show(text)
            if not ended and time.monotonic() >= limit:
                process.kill()
                return True
            if checkpoint < math.inf and not ended:
                keep_checkpoint(job.start, job.folder, since)
                if time.monotonic() - asked >= checkpoint:
                    send(process, signal.SIGUSR1)
                    asked = time.monotonic()
        return False
    finally:
        os.close(end)


def send(process: "subprocess.Popen[bytes]", number: int) -> None:
    """Sends a signal to furrow. Only one of several ranks gets it: mpirun would kill all of them soon."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    with contextlib.suppress(OSError):
        for child in map(int, children.read_text().split()):
            if Path(f"/proc/{child}/comm").read_text().strip() == "furrow":
                os.kill(child, number)
                return
    with contextlib.suppress(ProcessLookupError):
        os.kill(process.pid, number)


def keep_checkpoint(start: Path, folder: Path, since: int) -> bool:
    """True where a signal has made a checkpoint, which then replaces the one in the results.

    since: when the run was started [ns]
    """
    found = [(file.stat().st_mtime_ns, file) for file in start.glob(FORCED)]
    new = sorted(pair for pair in found if pair[0] >= since)
    for _, file in new:
        particles = _move_particles(file, folder)
        with replaced(folder / CHECKPOINT) as part:
            shutil.move(file, part)  # perhaps to another disk
        _remove_particles_but(particles, folder)
    return bool(new)


def _move_particles(file: Path, folder: Path) -> set[str]:
    """Moves particle files before their checkpoint, so that the stored checkpoint stays complete."""
    source, target = Path(f"{file}{PARTICLES}"), folder / f"{CHECKPOINT}{PARTICLES}"
    if not source.is_dir():
        return set()
    names = {particles.name for particles in source.iterdir()}
    target.mkdir(exist_ok=True)
    for name in names:
        shutil.move(source / name, target / name)
    source.rmdir()
    return names


def _remove_particles_but(names: set[str], folder: Path) -> None:
    target = folder / f"{CHECKPOINT}{PARTICLES}"
    if target.is_dir():
        for particles in target.iterdir():
            if particles.name not in names:
                particles.unlink()


def environment() -> Mapping[str, str]:
    """Settings of Open MPI, where the user has none."""
    settings = {**OPEN_MPI, **(AS_ROOT if os.getuid() == 0 else {})}
    return {**settings, **os.environ}


def show_line(line: str) -> None:
    """Prints a line. The results are in files: whoever reads the screen may leave."""
    try:
        print(line, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def output_lines(folder: Path) -> list[str]:
    """All lines that a program wrote, its errors last."""
    files = [folder / name for name in (SCREEN, ERRORS)]
    texts = [file.read_text(errors="replace") for file in files if file.is_file()]
    return [line for text in texts for line in text.splitlines()]
