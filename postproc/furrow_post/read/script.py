# SPDX-License-Identifier: GPL-2.0-or-later
"""The variables of a LIGGGHTS script, as its text has them: what -v may set.

LIGGGHTS takes any name on its command line; one that no line reads changes nothing. Files that the
script includes (include, jump) and the script of its bed are read too.
"""

import difflib
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import ResultsError, content_of

# Styles of the command variable that leave a value of the command line as it is
SETTABLE = ("index", "loop", "world", "universe", "uloop")
# By a line, or, in quotes, by a command "if"
DECLARED = re.compile(r"""(?:^|(["']))\s*variable\s+(\S+)\s+(\w+)\s*(.*?)(?:\1|$)""")
READ = re.compile(r"\$\{([^}]+)\}|\$(\w)|\bv_(\w+)")
OF_BED = "bed_"  # variables that the command bed makes begin so


@dataclass
class ScriptVariables:
    """Of one script with all that it includes."""

    defaults: dict[str, str] = field(default_factory=dict)  # settable name -> its value, as written
    computed: set[str] = field(default_factory=set)  # the script makes these itself
    read: set[str] = field(default_factory=set)  # used somewhere
    files: list[Path] = field(default_factory=list)  # the script and what it includes
    not_found: list[str] = field(default_factory=list)  # included files that could not be read

    @property
    def settable(self) -> list[str]:
        """Names that the command line may set."""
        undeclared = {n for n in self.read - self.computed if not n.startswith(OF_BED)}
        return sorted(set(self.defaults) | undeclared)


def script_variables(script: Path, given: Mapping[str, str]) -> ScriptVariables:
    """given: values of the command line, which may be part of the names of included files.

    @raises OSError without the script; ResultsError where it is not a text
    """
    found = ScriptVariables()
    _Reader(dict(given), found).read(script)
    return found


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


class _Reader:
    """Goes through a script from the top, with the values that variables have so far."""

    def __init__(self, values: dict[str, str], found: ScriptVariables) -> None:
        self.values, self.found = values, found

    def read(self, file: Path) -> None:
        self.found.files.append(file.resolve())
        with content_of(file, "name a LIGGGHTS script"):
            lines = list(_lines(file.read_text(encoding="utf-8")))
        on_condition = []
        for line in lines:
            self.found.read |= {a or b or c for a, b, c in READ.findall(line)}
            for quote, name, style, value in DECLARED.findall(line):
                if quote and style in SETTABLE:
                    on_condition.append((name, style, value))
                else:
                    self._declare(name, style, value.strip())
            command, *words = line.split()
            if command in ("include", "jump", "bed") and words and words[0] != "SELF":
                name = _unquoted(self._substituted(words[0]))
                # Furrow's paths are relative to the file with the line, LIGGGHTS's to where it runs
                self._follow(file.parent / name if command == "bed" else Path(name))
        for name, style, value in on_condition:  # a default that holds without it comes first
            self._declare(name, style, value.strip())

    def _declare(self, name: str, style: str, value: str) -> None:
        if style in SETTABLE:
            self.found.defaults.setdefault(name, value)
            self.values.setdefault(name, _unquoted(value))
        elif style != "delete":
            self.found.computed.add(name)
            if style == "string":
                self.values[name] = _unquoted(value)

    def _follow(self, file: Path) -> None:
        if not file.is_file():
            self.found.not_found.append(str(file))
        elif file.resolve() not in self.found.files:
            self.read(file)

    def _substituted(self, word: str) -> str:
        return re.sub(r"\$\{([^}]+)\}", lambda m: self.values.get(m[1], m[0]), word)


def _unquoted(word: str) -> str:
    return word[1:-1] if len(word) > 1 and word[0] == word[-1] and word[0] in "\"'" else word


def _lines(text: str) -> Iterator[str]:
    """Commands without comments; lines that end in & are joined."""
    joined = re.sub(r"&[ \t]*\n", " ", text)
    for line in joined.splitlines():
        command = _without_comment(line).strip()
        if command:
            yield command


def _without_comment(line: str) -> str:
    """As LIGGGHTS has it: # inside quotes is none."""
    quote = ""
    for place, letter in enumerate(line):
        if letter == "#" and not quote:
            return line[:place]
        if letter == quote:
            quote = ""
        elif not quote and letter in "\"'":
            quote = letter
    return line
