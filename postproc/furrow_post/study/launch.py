# SPDX-License-Identifier: GPL-2.0-or-later
"""Makes one run and keeps its record."""

import os
import signal
import subprocess
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

from ..errors import Interrupted, ResultsError
from .case import FOLDER, Case, Value
from .claim import lock
from .record import Record, digest, digests, forget

# A study yields to other work; its runs end, with a checkpoint, when it is killed
PREFIX = ("setpriv", "--pdeathsig", "TERM", "nice", "-n", "10")
PATIENCE = 10.0  # [s] in which a run that is being stopped leaves its folder
SCREEN, ERRORS = "screen.txt", "errors.txt"  # stdout and stderr of the program
INTERRUPTIONS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def project_root(path: Path) -> Path:
    """The folder above path that has the project's inputs. @raises ResultsError without one"""
    for folder in path.resolve().parents:
        if (folder / "inputs").is_dir() and (folder / "CMakeLists.txt").is_file():
            return folder
    raise ResultsError(f"{path}: does not lie in a source tree of Furrow")


@dataclass(frozen=True)
class Tools:
    """Where the programs are, and the source tree they belong to."""

    build: Path
    root: Path

    @classmethod
    def of(cls, file: Path, build: Path | None = None) -> "Tools":
        """Of the tree of a driver; build: default $FURROW_BUILD, or build in the tree."""
        root = project_root(file)
        chosen = build or Path(os.environ.get("FURROW_BUILD", root / "build"))
        return cls(chosen.resolve(), root)

    def program(self, name: str) -> Path:
        """@raises ResultsError where it is not built"""
        path = self.build / "bin" / name
        if not path.is_file():
            raise ResultsError(
                f"there is no program {path}; build it with 'bash inputs/run --help' once, or "
                "name the build folder with --build"
            )
        return path

    def commit(self) -> str:
        """Of the source tree, "+" behind it where files differ from it; empty without git."""
        description = subprocess.run(
            ["git", "-C", self.root, "describe", "--always", "--exclude=*", "--dirty=+"],
            capture_output=True,
            text=True,
        )
        return description.stdout.strip()


@dataclass(frozen=True)
class _Attempt:
    """What one start of the program gave."""

    error: str
    wall_time: float
    cpu_time: float
    system_time: float


def launch(case: Case, folder: Path, tools: Tools) -> Record:
    """Makes a run, whatever the folder holds, and writes its record there.

    A run that fails is repeated with the variables of the case's fallback, if it has one and the
    time was not too short. @raises Interrupted; ResultsError where the program is not built, or
    another run is writing to the folder
    """
    program = tools.program(case.program)
    folder.mkdir(parents=True, exist_ok=True)
    _require_free(folder)
    forget(folder)
    for name, text in case.files.items():
        (folder / name).write_text(text.replace(FOLDER, str(folder)), encoding="utf-8")
    started = datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    changes: Mapping[str, Value] = {}
    stopped: list[str] = []
    attempt = _start(case, case.command(program, folder, changes), folder)
    if attempt.error and case.fallback and attempt.wall_time < case.time_limit:
        stopped.append(attempt.error)
        changes = case.fallback
        attempt = _start(case, case.command(program, folder, changes), folder)
    record = Record(
        job=case.identity(tools.root),
        program=digest(program),
        inputs=digests(case.input_files()),
        commit=tools.commit(),
        started=started,
        wall_time=round(attempt.wall_time, 3),
        cpu_time=round(attempt.cpu_time, 3),
        system_time=round(attempt.system_time, 3),
        facts=_facts(folder),
        changes={name: str(value) for name, value in changes.items()},
        stopped=tuple(stopped),
        error=attempt.error,
    )
    record.write(folder)
    return record


def _require_free(folder: Path) -> None:
    """@raises ResultsError while furrow writes to the folder: it then holds a lock of it"""
    until = time.monotonic() + PATIENCE
    while is_busy(folder):
        if time.monotonic() > until:
            raise ResultsError(
                f"{folder}: another run is writing to it; wait until that run has ended"
            )
        time.sleep(0.1)


def is_busy(folder: Path) -> bool:
    """Whether furrow writes to the folder."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        return not lock(handle)
    finally:
        os.close(handle)


def _start(case: Case, command: list[str], folder: Path) -> _Attempt:
    """Runs a command in the folder, its output into files there. @raises Interrupted"""
    began = time.monotonic()
    late = threading.Event()
    with open(folder / SCREEN, "wb") as screen, open(folder / ERRORS, "wb") as errors:
        process = subprocess.Popen([*PREFIX, *command], cwd=folder, stdout=screen, stderr=errors)

        def stop() -> None:
            late.set()
            process.kill()

        timer = threading.Timer(min(case.time_limit, threading.TIMEOUT_MAX), stop)
        timer.daemon = True
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    # furrow takes a signal as a wish for a checkpoint, ends the run and exits with 128 and the signal
    by_signal = {-process.returncode, process.returncode - 128} & set(INTERRUPTIONS)
    # mpirun may end with another status. A run that was killed before may write its checkpoint late.
    if by_signal or (process.returncode and any(folder.glob("restart_forced*"))):
        raise Interrupted(f"{folder} was interrupted; start again")
    error = ""
    if late.is_set():
        error = f"time limit of {case.time_limit:g} s"
    elif process.returncode:
        error = _error_text(folder) or f"stopped with status {process.returncode}"
    wall_time = time.monotonic() - began
    return _Attempt(error, wall_time, usage.ru_utime, usage.ru_stime)


def output_lines(folder: Path) -> list[str]:
    """All lines that the program wrote, its errors last."""
    texts = [(folder / name).read_text(errors="replace") for name in (SCREEN, ERRORS)]
    return [line for text in texts for line in text.splitlines()]


def _error_text(folder: Path) -> str:
    """The first line with LIGGGHTS's word ERROR, else the last line on stderr."""
    lines = [line.strip() for line in output_lines(folder)]
    marked = [line for line in lines if "ERROR" in line]
    if marked:
        return marked[0]
    told = (folder / ERRORS).read_text(errors="replace").split("\n")
    return next((line.strip() for line in reversed(told) if line.strip()), "")


def _facts(folder: Path) -> dict[str, float]:
    """Of the last line "FACTS name value name value ..."; empty where there is none."""
    found = [line.split()[1:] for line in output_lines(folder) if line.startswith("FACTS ")]
    if not found:
        return {}
    return {name: float(value) for name, value in zip(found[-1][::2], found[-1][1::2])}
