# SPDX-License-Identifier: GPL-2.0-or-later
"""Case of a run: a program with its arguments, variables and files, in its results folder."""

import math
import os
import re
import shlex
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import product
from pathlib import Path
from typing import Any

import yaml

from ..errors import ResultsError
from ..formatting import yaml_text
from .script import as_word, script_variables

Value = str | float | int | Path

YAML_NAMES = (".yaml", ".yml")
LONGEST_NAME = 256  # letters; longer texts are no names of files
SCRIPT = ".lig"
DEFAULT = re.compile(r"^variable\s+\w+\s+index.*|#.*", re.MULTILINE)
VARIABLE = re.compile(r"\$\{(\w+)\}")
FILE_NAME = re.compile(r"[^\s,:;=\"'()&|]+\.[A-Za-z]\w*")
RESULTS = "results"  # the variable of a script that is its results folder
CONTINUED = "until_steady.lig"  # the script of a run that goes on until it is steady
FOLDER = "{folder}"  # in an argument, a variable or a file's text: the folder of the run


def _has_blanks(path: Path) -> bool:
    return len(str(path).split()) > 1


@dataclass(frozen=True)
class Case:
    """One run. Two cases are the same run when their identity is the same.

    Arguments and variables are passed as str() writes them.
    """

    name: str  # folder of the run below that of the executor; may have "/"; empty: that folder
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
    reads: tuple[Path, ...] = ()  # further input files of the run
    start: Path | None = None  # folder in which the program starts; None for the folder of the run
    keeps_checkpoint: bool = False  # can be continued from the checkpoint that a signal makes
    checkpoint: float = 0.0  # [s] between further checkpoints; 0: none
    continued: bool = False  # begins from a checkpoint in its folder
    words: str = ""  # the scene and its options, as a user types them

    def command(self, program: Path, folder: Path, changes: Mapping[str, Value]) -> list[str]:
        """The command line. changes: variables that differ in this attempt. @raises ResultsError"""
        launcher = ["mpirun", "-n", str(self.ranks)] if self.ranks > 1 else []
        given = (str(word).replace(FOLDER, str(folder)) for word in self.arguments)
        words = [*launcher, str(program), *given]
        inside = str(folder) if not _has_blanks(folder) else "."
        for name, value in {**self.variables, **changes}.items():
            if isinstance(value, Path) and _has_blanks(value):
                raise ResultsError(
                    f"{value}: has blanks, at which LIGGGHTS splits the value of a variable "
                    f"({name}); move the source tree to a path without blanks"
                )
            words += ["-var", name, str(value).replace(FOLDER, inside)]
        return words

    def start_in(self, folder: Path) -> Path:
        """Folder in which the program starts; a path with blanks is "." inside this folder."""
        return folder if self.start is None or _has_blanks(folder) else self.start

    def identity(self, root: Path) -> dict[str, object]:
        """Properties that distinguish this run from others, as JSON has them; root: of the project, which may move."""

        def portable(value: Value) -> str:
            return str(value).replace(f"{root}/", "")

        return {
            "program": self.program,
            "arguments": [portable(argument) for argument in self.arguments],
            "variables": {name: portable(value) for name, value in self.variables.items()},
            "files": {name: portable(text) for name, text in self.files.items()},
        }

    def input_files(self, furrow: Path | None = None) -> list[Path]:
        """Files that the command line names: scripts, materials, tyres; those of reads; what YAML files of them
        name, as a material its base; and with the program furrow what its scripts include and name."""
        named = [Path(str(value)) for value in (*self.arguments, *self.variables.values())]
        found: dict[Path, None] = {}
        for path in (*named, *self.reads):
            if path.is_absolute() and path.is_file():
                _add_with_named(path, found)
        for text in (text for name, text in self.files.items() if Path(name).suffix in YAML_NAMES):
            for path in _named_in(text, Path("/")):
                _add_with_named(path, found)
        for script in (*named, *self.reads):
            if furrow and script in found and script.suffix == SCRIPT:
                for path in self._files_of(script, furrow):
                    _add_with_named(path, found)
        return list(found)

    def _files_of(self, script: Path, furrow: Path) -> Iterator[Path]:
        """The script, what it includes, and files that lines and variables of them name."""
        given = {name: str(value) for name, value in self.variables.items()}
        known = script_variables(script, given, furrow)
        values = {**known.defaults, **given}
        seen = {*known.files}
        start = () if self.start is None else (self.start,)
        scripts = dict.fromkeys(known.files)
        while scripts:
            file, _ = scripts.popitem()
            yield file
            text = DEFAULT.sub("", file.read_text("utf-8", "replace"))
            text = VARIABLE.sub(lambda found: values.get(found[1], ""), text)
            named = [*_files_among(FILE_NAME.findall(text), file.parent, *start)]
            scripts |= dict.fromkeys(path for path in named if path.suffix == SCRIPT and path not in seen)
            seen.update(named)
            yield from named
        for value in values.values():
            yield from _files_among((value, *FILE_NAME.findall(value)), script.parent, *start)


def _files_among(names: Iterable[str], *folders: Path) -> Iterator[Path]:
    for name, folder in product(names, folders):
        path = os.path.join(folder, name)
        if os.path.splitext(name)[1] and os.path.isfile(path):
            yield Path(os.path.realpath(path))


def with_named_files(path: Path) -> list[Path]:
    """A file, and those that it names if it is YAML: bases, contacts, and what they name."""
    found: dict[Path, None] = {}
    _add_with_named(path.resolve(), found)
    return list(found)


def _add_with_named(path: Path, found: dict[Path, None]) -> None:
    if path in found:
        return
    found[path] = None
    if path.suffix in YAML_NAMES:
        for named in _named_in(path.read_text(encoding="utf-8", errors="replace"), path.parent):
            _add_with_named(named, found)


def _named_in(text: str, folder: Path) -> Iterator[Path]:
    """Files that the values of a YAML text name; none for other texts."""
    return _files_among(_words_of(text), folder)


@lru_cache(maxsize=None)
def _words_of(text: str) -> tuple[str, ...]:
    try:
        return tuple(_texts(yaml.safe_load(text)))
    except yaml.YAMLError:
        return ()


def _texts(content: Any) -> Iterator[str]:
    """Single words of nested mappings and lists."""
    if isinstance(content, dict):
        content = list(content.values())
    if isinstance(content, list):
        for each in content:
            yield from _texts(each)
    elif isinstance(content, str) and "\n" not in content and len(content) < LONGEST_NAME:
        yield content


def named_values(text: str) -> dict[str, Value]:
    """Variables of a script from "name=value name='two words'", as tables of runs have them."""
    pairs = (word.partition("=") for word in shlex.split(text))
    return {name: value for name, _, value in pairs}


def script_case(
    name: str, script: Path | str, variables: Mapping[str, Value], log: bool = False, **more: Any
) -> Case:
    """A script run by furrow; variables: of the script, beside results, which is the run's folder.

    script: also a text with FOLDER in it; log: keeps LIGGGHTS's log; more: further members of the
    Case
    """
    log_file = f"{FOLDER}/log.liggghts" if log else "none"
    arguments = ("-in", script, "-log", log_file)
    return Case(name, "furrow", arguments, {RESULTS: FOLDER, **variables}, **more)


def continued_script(script: Path, error: float, time_limit: float) -> str:
    """A script that runs another one, and on until hub drop and resistance are steady.

    @raises ResultsError for a path that LIGGGHTS cannot include
    """
    if len(str(script).split()) > 1:
        raise ResultsError(
            f"--until-steady: {script} has blanks in its path, from which LIGGGHTS cannot include; "
            "move it"
        )
    limit = f" wall_time {time_limit:.10g}" if time_limit else ""
    return f"include {script}\nrun_until_steady error {error:.10g}{limit}\n"


def scene_case(
    name: str,
    script: Path,
    variables: Mapping[str, str],
    until_steady: float,
    steady_limit: float,
    **more: Any,
) -> Case:
    """A run of a scene; until_steady: relative error, 0: as long as the script lasts; steady_limit: its time
    limit [s], 0: none; more: further members of the Case"""
    run: Path | str = script
    if until_steady:
        run = f"{FOLDER}/{CONTINUED}"
        more["reads"] = (script,)
        more["files"] = {CONTINUED: continued_script(script, until_steady, steady_limit)}
    known = script_variables(script, variables)
    case = script_case(
        name,
        run,
        {name: as_word(script, value) for name, value in variables.items()},
        log=True,
        **more,
    )
    if RESULTS in known.settable:
        return case
    return replace(case, variables={name: value for name, value in case.variables.items() if name != RESULTS})


def laboratory_case(
    name: str, test: str, root: Path, variables: Mapping[str, Value], **more: Any
) -> Case:
    """A test of inputs/laboratory; root: of the project."""
    folder = root / "inputs" / "laboratory"
    given: dict[str, Value] = {"here": folder, **variables}
    return script_case(name, folder / f"{test}.lig", given, log=True, **more)


def point_text(title: str, material: Path, path: str) -> str:
    """An input of furrow-point; path: its YAML mapping, "{type: ..., ...}"."""
    return f"title: {yaml_text(title)}\nmaterial: {yaml_text(str(material))}\npath: {path}\n"


def point_case(name: str, title: str, material: Path, path: str, **more: Any) -> Case:
    """A path of a material point by furrow-point; path: its YAML mapping, "{type: ..., ...}"."""
    arguments = ("run", f"{FOLDER}/path.yaml", "-o", FOLDER, "--no-plot")
    return Case(name, "furrow-point", arguments, files={"path.yaml": point_text(title, material, path)}, **more)
