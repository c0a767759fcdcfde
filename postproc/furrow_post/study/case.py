# SPDX-License-Identifier: GPL-2.0-or-later
"""One run of a study: a program with its arguments, in a folder of its own."""

import math
from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import ResultsError

Value = str | float | int | Path

FOLDER = "{folder}"  # in an argument, a variable or a file's text: the folder of the run


def _has_blanks(path: Path) -> bool:
    return len(str(path).split()) > 1


@dataclass(frozen=True)
class Case:
    """What is run. Two cases are the same run when their identity is the same.

    Arguments and variables are passed as str() writes them.
    """

    name: str  # folder of the run below that of the study; may have "/"
    program: str  # executable in the build's bin folder
    arguments: tuple[Value, ...] = ()
    variables: Mapping[str, Value] = field(default_factory=dict)  # of a script: -var NAME VALUE
    files: Mapping[str, str] = field(default_factory=dict)  # name -> text, put into the folder
    what: str = ""  # a few words for tables and figures
    stage: str = ""  # part of the study
    shares: Hashable = None  # runs with the same key share what the first one makes
    time_limit: float = math.inf  # [s]
    may_fail: bool = False  # its failure is a result of the study too
    fallback: Mapping[str, Value] = field(default_factory=dict)  # variables of a second attempt
    ranks: int = 1  # of MPI; the results do not depend on them but for rounding
    reads: tuple[Path, ...] = ()  # further files that it is made from

    def command(self, program: Path, folder: Path, changes: Mapping[str, Value]) -> list[str]:
        """The command line. changes: variables that differ in this attempt. @raises ResultsError"""
        launcher = ["mpirun", "-n", str(self.ranks)] if self.ranks > 1 else []
        given = (str(word).replace(FOLDER, str(folder)) for word in self.arguments)
        words = [*launcher, str(program), *given]
        # A run starts in its folder, which has a name without blanks from there
        inside = str(folder) if not _has_blanks(folder) else "."
        for name, value in {**self.variables, **changes}.items():
            if isinstance(value, Path) and _has_blanks(value):
                raise ResultsError(
                    f"{value}: has blanks, at which LIGGGHTS splits the value of a variable "
                    f"({name}); move the source tree to a path without blanks"
                )
            words += ["-var", name, str(value).replace(FOLDER, inside)]
        return words

    def identity(self, root: Path) -> dict[str, object]:
        """What tells this run from others, as JSON has it; root: of the project, which may move."""

        def portable(value: Value) -> str:
            return str(value).replace(f"{root}/", "")

        return {
            "program": self.program,
            "arguments": [portable(argument) for argument in self.arguments],
            "variables": {name: portable(value) for name, value in self.variables.items()},
            "files": {name: portable(text) for name, text in self.files.items()},
        }

    def input_files(self) -> list[Path]:
        """Files that the command line names: scripts, materials, tyres; and those of reads."""
        named = [Path(str(value)) for value in (*self.arguments, *self.variables.values())]
        paths = dict.fromkeys((*named, *self.reads))
        return [path for path in paths if path.is_absolute() and path.is_file()]
