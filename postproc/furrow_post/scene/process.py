# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs furrow with its progress on the screen, and passes signals on to it."""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import FrameType, TracebackType
from typing import Any

from ..errors import Interrupted, ResultsError
from ..whole_file import replaced

CHECKPOINT = "checkpoint.data"  # the last one that a signal made
FORCED = "restart_forced_liggghts_*.data"  # as LIGGGHTS names it, where the run was started
PARTICLES = ".particles"  # ending of the folder next to a checkpoint, with the particles of terrain
LOOK_EVERY = 0.2  # [s] for a checkpoint that was asked for
SCREEN, ERRORS = "screen.txt", "errors.txt"  # stdout and stderr of the program
# Of furrow's output, what goes to the screen
SHOWN = re.compile(r"\[|.*ERROR|.*WARNING: *[^ ]|  at |.*Making the bed|run_until_steady")
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# furrow ends, with a checkpoint, when this program is killed
PREFIX = ("setpriv", "--pdeathsig", "TERM")
# Two runs side by side are not bound to the same cores; ranks have time to write a checkpoint
OPEN_MPI = {
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "OMPI_MCA_odls_base_sigkill_timeout": "10",
}
AS_ROOT = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


class Failed(ResultsError):
    """furrow stopped with a status other than 0; its messages are on the screen."""

    def __init__(self, status: int) -> None:
        super().__init__(f"furrow ended with status {status}; its error is above")
        self.status = status


class Stopped(Interrupted):
    """A signal ended the runs."""

    def __init__(self, number: int) -> None:
        super().__init__(f"{signal.Signals(number).name} stopped the run")
        self.status = 128 + number


@dataclass(frozen=True)
class Cost:
    """Of a run that came to its end [s]."""

    cpu_time: float
    wall_time: float


class Runs:
    """The runs of this program: a signal is passed on to each, which ends it with a checkpoint."""

    def __init__(self) -> None:
        self._running: list[subprocess.Popen[bytes]] = []
        self._before: dict[int, Any] = {}
        self.stopped_by = 0

    def __enter__(self) -> "Runs":
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
        self.stopped_by = self.stopped_by or number
        for process in list(self._running):
            send(process, number)

    def require_going(self) -> None:
        """@raises Stopped after a signal"""
        if self.stopped_by:
            raise Stopped(self.stopped_by)

    def run(
        self, command: Sequence[object], start: Path, folder: Path, label: str = "", every: float = 0.0
    ) -> Cost:
        """Runs a command in the folder start; its output goes to files of a results folder.

        label: stands before each line on the screen; every: time between checkpoints [s], 0: none.
        @raises Stopped, Failed
        """
        self.require_going()
        began, since = time.monotonic(), time.time_ns()
        with open(folder / SCREEN, "wb", buffering=0) as screen, open(folder / ERRORS, "wb") as errors:
            process = subprocess.Popen(
                [*PREFIX, *map(str, command)],
                cwd=start,
                env=environment(),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=errors,
                start_new_session=True,  # the terminal's Ctrl-C comes from here alone
            )
            self._running.append(process)
            if self.stopped_by:
                send(process, self.stopped_by)
            assert process.stdout
            with checkpoints(process, every, lambda: keep_checkpoint(start, folder, since)) as begin:
                for line in process.stdout:
                    screen.write(line)
                    text = line.decode("utf-8", "replace").rstrip("\n")
                    if SHOWN.match(text):
                        begin.set()
                        _show(label + text)
            process.stdout.close()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self._running.remove(process)
        keep_checkpoint(start, folder, since)
        self.require_going()
        if process.returncode:
            _show_end(folder)
            raise Failed(process.returncode if process.returncode > 0 else 128 - process.returncode)
        (folder / ERRORS).unlink()
        return Cost(usage.ru_utime, time.monotonic() - began)


def send(process: "subprocess.Popen[bytes]", number: int) -> None:
    """Sends a signal to furrow. Of several ranks one gets it: mpirun would kill all of them soon."""
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    with contextlib.suppress(OSError):
        for child in map(int, children.read_text().split()):
            if Path(f"/proc/{child}/comm").read_text().strip() == "furrow":
                os.kill(child, number)
                return
    with contextlib.suppress(ProcessLookupError):
        os.kill(process.pid, number)


@contextlib.contextmanager
def checkpoints(
    process: "subprocess.Popen[bytes]", every: float, keep: Callable[[], bool]
) -> Iterator[threading.Event]:
    """Asks a run for a checkpoint again and again, from the moment when the event is set.

    SIGUSR1 has one written when neighbour lists are due anyway, so it does not change the run.
    keep: whether there is a new one, which it puts in its place.
    """
    begin, end = threading.Event(), threading.Event()

    def ask() -> None:
        """A run that pours grains takes no notice, so it is asked again."""
        begin.wait()
        asked = time.monotonic()
        while not end.wait(min(every, LOOK_EVERY)):
            keep()
            if time.monotonic() - asked >= every:
                send(process, signal.SIGUSR1)
                asked = time.monotonic()

    asking = threading.Thread(target=ask)
    if every:
        asking.start()
    try:
        yield begin
    finally:
        end.set()
        begin.set()
        if every:
            asking.join()


def keep_checkpoint(start: Path, folder: Path, since: int) -> bool:
    """Whether a signal has made a checkpoint, which then replaces the former one in the results.

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
    """The names of its particles, which move before the checkpoint: until then the former one is whole."""
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
    """Those of the former checkpoint."""
    target = folder / f"{CHECKPOINT}{PARTICLES}"
    if target.is_dir():
        for particles in target.iterdir():
            if particles.name not in names:
                particles.unlink()


def environment() -> Mapping[str, str]:
    """Open MPI's settings, where the user has none."""
    settings = {**OPEN_MPI, **(AS_ROOT if os.getuid() == 0 else {})}
    return {**settings, **os.environ}


def _show(line: str) -> None:
    """The results are in files: whoever reads the screen may leave."""
    try:
        print(line, flush=True)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _show_end(folder: Path) -> None:
    print(f"The run stopped; the last lines of {folder / SCREEN}:", file=sys.stderr)
    for name in (SCREEN, ERRORS):
        lines = (folder / name).read_text(errors="replace").splitlines()
        sys.stderr.writelines(f"{line}\n" for line in lines[-5:])


def require_executable(program: Path) -> None:
    """@raises ResultsError"""
    if not os.access(program, os.X_OK):
        raise ResultsError(f"there is no program {program}; run 'bash inputs/run' once, which builds it")
