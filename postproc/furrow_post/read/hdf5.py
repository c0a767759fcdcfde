# SPDX-License-Identifier: GPL-2.0-or-later
"""Opening HDF5 files that may be damaged: the HDF5 library may crash, or never end, on those.

A file is therefore read once from end to end by a child process, before this process opens it.
The child reads further files until one is damaged.
"""

import contextlib
import multiprocessing
import os
import resource
import signal
import threading
from collections.abc import Iterator
from functools import lru_cache
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import h5py

from ..errors import ResultsError, content_of

REMEDY = "repeat the run, or take the file from a copy"
SLOWEST = 5e6  # [byte/s] below which reading counts as endless
PATIENCE = 10.0  # [s] in any case
LARGEST = 1 << 28  # [byte] of memory beyond what the file's size explains


@contextlib.contextmanager
def opened(file: Path) -> Iterator[Any]:
    """The content of a file for reading.

    @raises ResultsError where it is damaged, no HDF5 file, or lacks what is read in the with block
    """
    try:
        status = file.stat()
    except OSError as error:
        raise ResultsError(f"{file}: {error.strerror}; check the path") from error
    _require_sound(file.resolve(), status.st_mtime_ns, status.st_size)
    try:
        with content_of(file, REMEDY), h5py.File(file, "r") as content:
            yield content
    except OSError as error:
        raise ResultsError(f"{file}: cannot be read ({error}); {REMEDY}") from error


@lru_cache(maxsize=None)
def _require_sound(file: Path, modified: int, size: int) -> None:
    """Requires a file that the child process can read completely. @raises ResultsError"""
    try:
        trouble = _reader_of(os.getpid()).trouble(file, size)
    except EOFError:  # perhaps not because of this file
        _reader_of.cache_clear()
        try:
            trouble = _reader_of(os.getpid()).trouble(file, size)
        except EOFError:
            trouble = "is damaged, the HDF5 library cannot read it"
    if trouble:
        _reader_of.cache_clear()  # a library that met a damaged file reads no other
        raise ResultsError(f"{file}: {trouble}; {REMEDY}")


class _Reader:
    """A child process that reads one file after another. It ends when this one closes its pipe."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("fork")
        self._pipe, other = context.Pipe()
        self._child = context.Process(target=_read_all, args=(other, self._pipe), daemon=True)
        self._child.start()
        other.close()
        self._in_use = threading.Lock()

    def trouble(self, file: Path, size: int) -> str:
        """Fault of a file, or an empty text.

        @raises EOFError if the child dies before it answers
        """
        with self._in_use:
            try:
                self._pipe.send((file, size))
                if self._pipe.poll(PATIENCE + size / SLOWEST):
                    return str(self._pipe.recv())
            except OSError as error:
                raise EOFError from error
            self._child.kill()
        return "is damaged, reading it does not end"


@lru_cache(maxsize=1)
def _reader_of(process: int) -> _Reader:
    """Reader of this process; a copy of the process needs another."""
    return _Reader()


def _read_all(pipe: Connection, other: Connection) -> None:
    """Loop of the child process: sends the fault of each requested file, or an empty text."""
    other.close()
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # a program that makes runs handles these signals
        signal.signal(number, signal.SIG_DFL)
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        os.dup2(nowhere.fileno(), 2)  # hides the message of the C library when it stops the process
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with contextlib.suppress(EOFError):
        while True:
            pipe.send(_trouble_of(*pipe.recv()))


def _trouble_of(file: Path, size: int) -> str:
    try:
        with h5py.File(file, "r") as content:
            _walk(content, size)
    except PermissionError as error:
        return f"{error.strerror}, check the rights"
    except Exception as error:
        return f"is not a results file of Furrow, or damaged ({' '.join(str(error).split())})"
    return ""


def _walk(content: Any, size: int) -> None:
    """Reads every attribute and dataset."""

    def visit(name: str, item: Any) -> None:
        for key in item.attrs:
            item.attrs[key]
        if isinstance(item, h5py.Dataset):
            if item.nbytes > size + LARGEST:
                raise ValueError(f"{name} would have {item.nbytes} bytes")
            item[()]

    visit("/", content)
    content.visititems(visit)
