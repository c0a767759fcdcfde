# SPDX-License-Identifier: GPL-2.0-or-later
"""The programs of one build, the source tree that they belong to, and short conversations with them."""

import os
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

from ..errors import ResultsError
from ..programs import find_program, inputs_folder

OTHERS = {"ccx": "calculix-ccx", "yade": "yade"}  # programs of others that studies compare with -> their packages


def project_root(path: Path) -> Path:
    """The folder above path that has the project's inputs, or the tree of this package. @raises ResultsError without one"""
    for folder in (*path.resolve().parents, Path(__file__).resolve().parents[3]):
        if (folder / "inputs").is_dir() and (folder / "CMakeLists.txt").is_file():
            return folder
    raise ResultsError(f"{path}: does not lie in a source tree of Furrow")


@dataclass(frozen=True)
class Tools:
    """A build folder, and the source tree: paths below it are stored relative to it."""

    build: Path
    root: Path

    @classmethod
    def of(cls, file: Path, build: Path | None = None) -> "Tools":
        """Tools for a file of the tree; build: default $FURROW_BUILD, or build in the tree."""
        root = project_root(file)
        chosen = build or Path(os.environ.get("FURROW_BUILD", root / "build"))
        return cls(chosen.resolve(), root)

    @classmethod
    def found(cls) -> "Tools":
        """Tools of the programs that this package finds. @raises ResultsError where there are none"""
        inputs = inputs_folder()
        return cls(find_program("furrow").parent.parent, inputs.parent if inputs else Path.cwd())

    def program(self, name: str) -> Path:
        """Path of a program of the build, or of one of OTHERS. @raises ResultsError where it is not there"""
        if name in OTHERS:
            found = shutil.which(name)
            if not found:
                raise ResultsError(f"{name}: is not installed, and this study compares with it; install Debian's package {OTHERS[name]}")
            return Path(found)
        path = self.build / "bin" / name
        if not os.access(path, os.X_OK):
            raise ResultsError(
                f"there is no program {path}; run 'bash inputs/run' once, which builds it, or name the "
                "build folder with --build"
            )
        return path

    def commit(self) -> str:
        """Commit of the source tree, "+" behind it where files differ from it; empty without git."""
        words = ["git", "-C", str(self.root), "describe", "--always", "--exclude=*", "--dirty=+"]
        try:
            return subprocess.run(words, capture_output=True, text=True).stdout.strip()
        except FileNotFoundError:
            return ""


class Refused(ResultsError):
    """A program ended with an error; cause: its message."""

    def __init__(self, program: str, cause: str) -> None:
        super().__init__(f"{program}: {cause}")
        self.cause = cause


def answer(command: Sequence[object]) -> str:
    """Output of a program. @raises Refused with its message where it fails"""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        name = Path(words[0]).name
        lines = [line.strip() for line in done.stderr.splitlines() if line.strip()]
        cause = lines[-1].removeprefix("ERROR: ").removeprefix(f"{name}: ") if lines else f"status {done.returncode}"
        raise Refused(name, cause)
    return done.stdout


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
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
