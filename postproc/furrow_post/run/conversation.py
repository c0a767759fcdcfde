# SPDX-License-Identifier: GPL-2.0-or-later
"""A program that stays open: a line of answer for each line of input."""

import subprocess
from pathlib import Path
from types import TracebackType
from typing import Self

from ..errors import ResultsError


class Conversation:
    """furrow-point, or another program of this kind, in a with statement."""

    def __init__(self, program: Path, *words: str | Path) -> None:
        self._name = program.name
        self._process = subprocess.Popen(
            [program, *words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            errors="backslashreplace",
        )

    def ask(self, question: str) -> str:
        """The answer to a line. @raises ResultsError with the program's message where it ended"""
        assert self._process.stdin
        try:
            self._process.stdin.write(question + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass  # the missing answer has the cause
        return self.line()

    def line(self) -> str:
        """The next line of its output. @raises ResultsError"""
        assert self._process.stdout and self._process.stderr
        line = self._process.stdout.readline()
        if not line:
            cause = " ".join(self._process.stderr.read().split()).removeprefix(f"{self._name}: ")
            raise ResultsError(cause or f"{self._name} ended without a message; start it by hand")
        return line

    def close(self) -> None:
        self._process.communicate()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()
