# SPDX-License-Identifier: GPL-2.0-or-later
"""The folder of a run belongs to one program at a time."""

import fcntl
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import Interrupted, ResultsError

CLAIM = "claim"  # empty file in the folder of a run, locked while a program makes that run
LOOK_EVERY = 0.2  # [s] whether another program has left the folder


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
    except OSError:  # no locks here
        pass
    return True
