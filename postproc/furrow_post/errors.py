# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors that end a program with a message instead of a traceback."""

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

# Errors that code raises on values, keys or types that it does not expect
CONTENT_ERRORS = (
    *(ArithmeticError, IndexError, KeyError, RuntimeError, TypeError, ValueError),
    SystemError,
)


class ResultsError(Exception):
    """Something asked for is not in the results; the message names file and remedy."""


def refuse_others(where: str, given: Iterable[object], known: Iterable[str]) -> None:
    """@raises ResultsError for keys of a mapping that nothing reads"""
    if unknown := sorted(map(str, set(given) - set(known))):
        raise ResultsError(f"{where} has unknown keys {unknown}; allowed are {', '.join(sorted(known))}")


class Interrupted(Exception):
    """A signal ended the run; it is neither finished nor failed."""

    def __init__(self, text: str, status: int = 1) -> None:
        super().__init__(text)
        self.status = status  # of the program that reports it


@contextmanager
def content_of(file: Path | str, remedy: str) -> Iterator[None]:
    """For code that takes a file's content as it comes: what that code raises blames the file.

    @raises ResultsError with file, what is wrong, remedy
    """
    try:
        yield
    except Exception as error:
        if not isinstance(error, CONTENT_ERRORS) and type(error).__name__ != "LinAlgError":  # of numpy
            raise
        raise ResultsError(f"{file}: {_in_words(error)}; {remedy}") from error


def _in_words(error: Exception) -> str:
    if isinstance(error, UnicodeDecodeError):
        return "is not text in UTF-8"
    if isinstance(error, KeyError):
        absent = re.search(r"(?:object|attribute:) '(.+?)'", str(error))  # text of HDF5
        return f"has no '{absent[1] if absent else error.args[0]}'"
    if isinstance(error, IndexError):
        return "has too few values"
    return f"cannot be used ({' '.join(str(error).split())})"
