# SPDX-License-Identifier: GPL-2.0-or-later
"""Base of all Python programs of Furrow: texts are UTF-8, and a fault is one line on stderr."""

import ctypes
import os
import sys
import traceback
from collections.abc import Callable
from pathlib import Path

from .errors import Interrupted, ResultsError

M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3  # of malloc.h, sizes in bytes
TRACEBACK = "FURROW_TRACEBACK"  # environment variable: errors come with their traceback


def run_program(name: str, action: Callable[[], int | None]) -> int:
    """The exit status of a program that does this; None is 0. name: as a user calls it."""
    require_utf8()
    keep_freed_memory()
    try:
        return action() or 0
    except BrokenPipeError:  # the reader of our output has gone, e.g. "| head"
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except KeyboardInterrupt:
        return _say(name, "interrupted; start again to do the rest", 130)
    except Exception as error:
        if os.environ.get(TRACEBACK):
            raise
        return _say(name, _text(error), getattr(error, "status", 1))


def require_utf8() -> None:
    """Starts this program again in Python's UTF-8 mode where the locale has another encoding.

    Files are written in UTF-8 and may name folders with any letter.
    """
    if sys.getfilesystemencoding().lower() != "utf-8" and not sys.flags.utf8_mode:
        sys.stdout.flush()
        os.execv(sys.executable, [sys.executable, "-X", "utf8", *sys.orig_argv[1:]])


def keep_freed_memory() -> None:
    """Lets glibc keep the memory of freed arrays for the next ones, which drawing makes by the dozen.

    By default it returns them to the kernel, and half of the time of a picture is for new pages.
    """
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    if mallopt is not None:
        for parameter, size in (M_MMAP_THRESHOLD, 256 << 20), (M_TRIM_THRESHOLD, 1 << 30):
            mallopt(parameter, size)


def _say(name: str, text: str, status: int) -> int:
    # A name of a file that is not UTF-8 is printed with escapes
    line = f"{name}: {text}\n".encode("utf-8", "backslashreplace").decode()
    sys.stderr.write(line)
    return status


def _text(error: Exception) -> str:
    if isinstance(error, (ResultsError, Interrupted)):
        return str(error)
    if isinstance(error, OSError) and error.strerror:
        where = f"{os.fsdecode(error.filename)}: " if error.filename is not None else ""
        return f"{where}{error.strerror[0].lower()}{error.strerror[1:]}; check path and rights"
    if isinstance(error, OSError):
        return str(error)
    if isinstance(error, UnicodeEncodeError):
        words = [word for word in error.object.split() if not word.isprintable()]
        return f"{' '.join(words[:1])}: is a name that is not UTF-8; rename the file or folder"
    if isinstance(error, MemoryError):
        return "there is not enough memory; close other programs, or evaluate fewer runs at a time"
    place = traceback.extract_tb(error.__traceback__)[-1]
    return (
        f"internal error in {Path(place.filename).name}, line {place.lineno} "
        f"({type(error).__name__}: {error}); please report it with what {TRACEBACK}=1 prints"
    )
