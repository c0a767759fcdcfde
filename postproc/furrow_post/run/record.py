# SPDX-License-Identifier: GPL-2.0-or-later
"""The folder of a run: its record, run.json when it came to its end, else failed.json, and the claim of one program."""

import fcntl
import hashlib
import json
import os
import shutil
import threading
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from ..errors import Interrupted, ResultsError

FINISHED, FAILED = "run.json", "failed.json"
CLAIM = "claim"  # empty file in the folder of a run, locked while a program makes that run
LOOK_EVERY = 0.2  # [s] whether another program has left the folder


@lru_cache(maxsize=None)
def _digest(path: Path, modified: int) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()[:12]


def digest(path: Path) -> str:
    """First digits of a file's SHA-256."""
    return _digest(path, path.stat().st_mtime_ns)


def digests(paths: Iterable[Path]) -> dict[str, str]:
    """File name -> digest. Later files of the same name have a number."""
    found: dict[str, str] = {}
    for path in paths:
        name, count = path.name, 1
        while name in found:
            count += 1
            name = f"{path.name} {count}"
        found[name] = digest(path)
    return found


@dataclass(frozen=True)
class Record:
    """One run as it was made."""

    job: Mapping[str, object]  # Case.identity
    program: str  # digest of the executable
    inputs: Mapping[str, str]  # file name -> digest, of Case.input_files
    commit: str  # of the source tree; "+" behind it: with changes; empty: none
    started: str  # UTC, ISO 8601
    wall_time: float  # [s]
    cpu_time: float  # user time [s]
    system_time: float  # [s]
    facts: Mapping[str, float] = field(default_factory=dict)  # of the last line FACTS name value ...
    changes: Mapping[str, str] = field(default_factory=dict)  # variables of the second attempt
    stopped: tuple[str, ...] = ()  # errors of attempts before
    error: str = ""  # of a failed run
    status: int = 0  # of the program
    ranks: int = 1
    words: str = ""  # the scene and its options, as a user types them
    continued: bool = False  # from a checkpoint: the times are those of the last part

    @property
    def name_of_program(self) -> str:
        return str(self.job.get("program", ""))

    def variable(self, name: str) -> str:
        """Value of a variable in the last attempt. @raises KeyError"""
        variables = self.job["variables"]
        assert isinstance(variables, Mapping)
        return str({**variables, **self.changes}[name])

    def write(self, folder: Path) -> None:
        """Writes run.json, or failed.json for a run with an error."""
        text = json.dumps(asdict(self), indent=1)
        (folder / (FAILED if self.error else FINISHED)).write_text(text + "\n", encoding="utf-8")


def read_record(path: Path) -> Record | None:
    """None where there is no such file, or it is no record."""
    try:
        content: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        content["stopped"] = tuple(content["stopped"])
        return Record(**content)
    except (OSError, ValueError, KeyError, TypeError):
        return None


def forget(folder: Path, checkpoints: bool) -> None:
    """Removes by what an earlier run in the folder could be taken for finished, and its checkpoints."""
    for name in (FINISHED, FAILED, "facts.txt", "laboratory.json"):
        (folder / name).unlink(missing_ok=True)
    for checkpoint in folder.glob("restart_forced*") if checkpoints else ():
        if checkpoint.is_dir() and not checkpoint.is_symlink():
            shutil.rmtree(checkpoint)
        else:
            checkpoint.unlink()


@contextmanager
def claimed(folder: Path, stop: threading.Event) -> Iterator[None]:
    """Waits until no other program makes the run of this folder, and keeps others from it.

    The lock ends with the process, however that ends. On file systems that know no locks there is
    none. stop: set by others to end the waiting. @raises Interrupted, and ResultsError for a link
    """
    folder.mkdir(parents=True, exist_ok=True)
    try:
        flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC
        handle = os.open(folder / CLAIM, flags, 0o666)
    except OSError as error:
        message = f"{folder / CLAIM}: cannot be opened ({error.strerror}); remove it"
        raise ResultsError(message) from error
    try:
        while not lock(handle):
            if stop.wait(LOOK_EVERY):
                raise Interrupted(f"{folder}: another program is making this run; start again")
        yield
    finally:
        os.close(handle)


def is_busy(folder: Path) -> bool:
    """True where furrow writes to the folder: it then holds a lock of it."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        return not lock(handle)
    finally:
        os.close(handle)


def lock(handle: int) -> bool:
    """Locks an open file or folder for this process; False while another one holds the lock."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:  # the file system has no locks
        pass
    return True
