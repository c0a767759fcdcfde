# SPDX-License-Identifier: GPL-2.0-or-later
"""The variables and files of a LIGGGHTS script: what -v may set, as 'furrow --variables' prints it.

LIGGGHTS takes any name on its command line; one that no line reads changes nothing.
"""

import difflib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import ResultsError
from ..json_text import parse_json
from ..programs import find_program
from .tools import answer

OF_BED = "bed_"  # variables that the command bed makes begin so


@dataclass(frozen=True)
class ScriptVariables:
    """Variables and files of one script with all that it includes."""

    defaults: Mapping[str, str]  # settable name -> its value, as written
    computed: frozenset[str]  # the script makes these itself
    read: frozenset[str]  # used somewhere
    files: tuple[Path, ...]  # the script and what it includes
    not_found: tuple[str, ...]  # included files that could not be read
    in_paths: Mapping[str, str | None] = field(default_factory=dict)  # given values on which paths of files depend
    states: Mapping[Path, object] = field(default_factory=dict)  # of the files that the answer depends on

    @property
    def settable(self) -> list[str]:
        """Names that the command line may set."""
        undeclared = {n for n in self.read - self.computed if not n.startswith(OF_BED)}
        return sorted(set(self.defaults) | undeclared)

    def holds(self, given: Mapping[str, str]) -> bool:
        """True while the program would answer the same to these values."""
        same = all(given.get(name) == value for name, value in self.in_paths.items())
        return same and all(_state(path) == state for path, state in self.states.items())


_answers: dict[tuple[Path, Path], list[ScriptVariables]] = {}


def script_variables(
    script: Path, given: Mapping[str, str], program: Path | None = None
) -> ScriptVariables:
    """given: values of the command line, which may be part of the names of included files; program: furrow.

    @raises ResultsError without the script or the program, and for what is no script
    """
    furrow = program or find_program("furrow")
    known = _answers.setdefault((furrow, Path.cwd() / script), [])
    for one in known:
        if one.holds(given):
            return one
    words = [
        word for name, value in given.items() if re.fullmatch(r"\w+", name) and value for word in ("-var", name, value)
    ]
    found = parse_json(answer([furrow, "--variables", script, *words]))
    files = tuple(map(Path, found["files"]))
    known.append(
        ScriptVariables(
            found["defaults"],
            frozenset(found["computed"]),
            frozenset(found["mentioned"]),
            files,
            tuple(found["not_found"]),
            {name: given.get(name) for name in found["in_paths"]},
            {path: _state(path) for path in (furrow, script, *files, *map(Path, found["not_found"]))},
        )
    )
    return known[-1]


def _state(path: Path) -> object:
    """State of a file, which differs once it was written again."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


RESERVED = {"results": "-o for the results folder"}  # variables that a program sets itself


def check_variables(
    script: Path,
    given: Sequence[tuple[str, str]],
    reserved: Mapping[str, str],
    surroundings: Mapping[str, str] | None = None,
    option: str = "-v",
) -> list[str]:
    """Refuses variables that no line of the script reads; the result are warnings.

    reserved: names that the caller sets -> what to use instead; surroundings: values that it sets,
    on which the names of included files depend; option: of the command line that gives the variables.
    @raises ResultsError, OSError
    """
    known = script_variables(script, {**dict(given), **(surroundings or {})})
    settable = [name for name in known.settable if name not in reserved]
    names = [name for name, _ in given]
    for name, value in given:
        if not name.strip():
            raise ResultsError(f"{option} has an empty name; it takes a name and a value")
        if names.count(name) > 1:
            raise ResultsError(f"{option} {name} is given {names.count(name)} times; give it once")
        if name in reserved:
            raise ResultsError(f"{option} {name}: use {reserved[name]}")
        if not value.strip() and known.defaults.get(name, "") not in ('""', "''"):
            raise ResultsError(f"{option} {name} has an empty value; give one, or leave it out")
        if name in known.computed and name not in known.defaults:
            raise ResultsError(
                f"{script}: computes '{name}' itself, so that {option} cannot set it; "
                f"it takes {_listed(settable)}"
            )
        if name not in settable and not known.not_found:
            near = difflib.get_close_matches(name, settable, n=3)
            hint = f"did you mean {' or '.join(near)}? It takes" if near else "it takes"
            raise ResultsError(f"{script}: no line reads '{name}'; {hint} {_listed(settable)}")
    require_files(script, known.defaults, given, option)
    return [
        f"{script}: includes {file}, which was not found: whether all variables are read is not "
        "known"
        for file in known.not_found
    ]


def require_files(
    script: Path, defaults: Mapping[str, str], given: Iterable[tuple[str, str]], option: str
) -> None:
    """@raises ResultsError where the default of a variable is a file, and a value is none

    A value may list the files of layers of ground, 'file:thickness,...,file'.
    """
    for name, value in given:
        usual = _unquoted(defaults.get(name, ""))
        if "$" in value or not (script.parent / usual).is_file():
            continue
        files = [layer.split(":")[0] for layer in _unquoted(value).split(",")]
        missing = [file for file in files if not (script.parent / file).is_file()]
        # a path with blanks may be relative to where the run is started
        if not missing or (len(value.split()) > 1 and Path(value).is_file()):
            continue
        raise ResultsError(
            f"{option} {name}: there is no file {missing[0]}; a path is relative to {script.parent}, "
            f"like {usual}"
        )


def as_word(script: Path, value: str) -> str:
    """LIGGGHTS splits a value at blanks: the path of a file gets quotes, and is right from anywhere."""
    if len(value.split()) > 1:
        if (script.parent / value).exists():
            return f'"{value}"'
        if Path(value).exists():
            return f'"{Path(value).resolve()}"'
    return value


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names) if names else "no variables"


def _unquoted(word: str) -> str:
    return word[1:-1] if len(word) > 1 and word[0] == word[-1] and word[0] in "\"'" else word
