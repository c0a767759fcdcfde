# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters of a soil card or a material file with their standard errors, and the file with one of them changed.

A soil card has a standard error with each parameter. A material file NAME.yaml has them in NAME.errors.csv, which
'furrow-post fit law' writes: `law.beta,0.6`. A file with a base has the errors of the base too.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import getitem
from pathlib import Path
from typing import Any

import yaml

from ..csv_table import read_rows
from ..errors import ResultsError, content_of

BESIDE = ".errors.csv"  # instead of the ending of a material file
OF_CARD = ("pressure_sinkage", "shear")  # sections that a height field reads


@dataclass(frozen=True)
class Interval:
    """A parameter of a file with its standard error."""

    keys: tuple[str | int, ...]  # path of the value in the file
    value: float
    error: float

    @property
    def name(self) -> str:
        return ".".join(str(key) for key in self.keys if key != "value")


def intervals(file: Path) -> list[Interval]:
    """Intervals of a soil card or a material file; none where it has none. @raises ResultsError"""
    content = _content(file)
    if OF_CARD[0] in content:
        sections = ((name, key, entry) for name in OF_CARD for key, entry in content.get(name, {}).items())
        found = [Interval((name, key, "value"), float(e["value"]), float(e["error"])) for name, key, e in sections if isinstance(e, dict)]
        return [one for one in found if one.error > 0 and one.keys[1] != "speed_stress"]
    merged, errors = _merged(file), _errors(file)
    return [Interval(keys, float(_at(merged, keys)), error) for keys, error in errors.items()]


def varied_text(file: Path, interval: Interval) -> str:
    """The file with one parameter larger by its standard error."""
    content = _content(file) if OF_CARD[0] in _content(file) else _merged(file)
    _at(content, interval.keys[:-1])[interval.keys[-1]] = interval.value + interval.error
    head = str(interval.keys[0])
    if isinstance(content.get("contact"), str):
        content["contact"] = str((file.parent / content["contact"]).resolve())
    kept = content if OF_CARD[0] in content else {"base": str(file.resolve()), head: content[head]}
    return str(yaml.safe_dump(kept, sort_keys=False))


def _content(file: Path) -> dict[str, Any]:
    with content_of(file, "a soil card or a material file is YAML, inputs/guide/soil_files.md"):
        return dict(yaml.safe_load(file.read_text(encoding="utf-8")))


def _with_bases(file: Path) -> list[Path]:
    """A material file after its bases."""
    base = _content(file).get("base")
    return [*(_with_bases(file.parent / str(base)) if base else []), file]


def _merged(file: Path) -> dict[str, Any]:
    """Material file merged with its bases by sections, as Furrow reads it."""
    merged: dict[str, Any] = {}
    for name, section in (item for one in _with_bases(file) for item in _content(one).items()):
        below: Any = merged.get(name)
        mappings = isinstance(section, dict) and isinstance(below, dict)
        same = mappings and section.get("type", below.get("type")) == below.get("type")
        merged[name] = {**below, **section} if same and below else section
    return merged


def _errors(file: Path) -> dict[tuple[str | int, ...], float]:
    """Keys of a parameter -> standard error, with those of the bases."""
    found: dict[tuple[str | int, ...], float] = {}
    for beside in (one.with_suffix(BESIDE) for one in _with_bases(file)):
        if beside.is_file():
            with content_of(beside, "it has the columns parameter and error, as 'furrow-post fit law' writes it"):
                found |= {_keys(row["parameter"]): float(row["error"]) for row in read_rows(beside)}
    return found


def _keys(name: str) -> tuple[str | int, ...]:
    """ "hardening.p[2]": the second of a list."""
    parts = re.findall(r"[^.\[\]]+", name)
    return tuple(int(part) - 1 if part.isdigit() else part for part in parts)


def _at(content: Any, keys: Sequence[str | int]) -> Any:
    return reduce(getitem, keys, content)


def require_intervals(files: Mapping[str, Path]) -> tuple[str, Path, list[Interval]]:
    """The variable, file and intervals of the one file that has some. @raises ResultsError"""
    known = [(name, file, found) for name, file in files.items() if (found := intervals(file))]
    if len(known) == 1:
        return known[0]
    names = ", ".join(f"{name} {file.name}" for name, file in files.items()) or "no variable is a card or a material file"
    raise ResultsError(
        f"{'several files have' if known else 'no file has'} standard errors ({names}); give one with -v: a soil card with errors, or a "
        "material with NAME.errors.csv next to it"
    )
