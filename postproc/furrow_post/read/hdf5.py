# SPDX-License-Identifier: GPL-2.0-or-later
"""Opening HDF5 files that may be damaged: the HDF5 library may crash, or never end, on those.

A file is therefore read once from end to end by a child process, before this process opens it.
"""

import contextlib
import multiprocessing
import os
import resource
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
    """@raises ResultsError"""
    receiver, sender = multiprocessing.Pipe(duplex=False)
    child = multiprocessing.get_context("fork").Process(
        target=_read_all, args=(file, size, sender), daemon=True
    )
    child.start()
    sender.close()
    child.join(PATIENCE + size / SLOWEST)
    if child.exitcode is None:
        child.kill()
        child.join()
        raise ResultsError(f"{file}: is damaged, reading it does not end; {REMEDY}")
    try:
        trouble: str = receiver.recv()
    except EOFError:  # it died before it could say anything
        trouble = "is damaged, the HDF5 library cannot read it"
    if trouble:
        raise ResultsError(f"{file}: {trouble}; {REMEDY}")


def _read_all(file: Path, size: int, sender: Connection) -> None:
    """In the child: sends what is wrong, or an empty text."""
    with open(os.devnull, "w", encoding="utf-8") as nowhere:
        os.dup2(nowhere.fileno(), 2)  # what the C library says when it stops the process
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        with h5py.File(file, "r") as content:
            _walk(content, size)
    except PermissionError as error:
        sender.send(f"{error.strerror}, check the rights")
    except Exception as error:
        sender.send(f"is not a results file of Furrow, or damaged ({' '.join(str(error).split())})")
    else:
        sender.send("")


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
