# SPDX-License-Identifier: GPL-2.0-or-later
"""The values of a study: where each one is stored, its error, its reference and its verdict.

`values` in a study.yaml lists them. A value is the number in one column of the one row of a table
that has the given texts. The tables lie beside the study.yaml.
"""

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from ..csv_table import read_rows
from ..errors import ResultsError, content_of, refuse_others

DEFINITION = "study.yaml"
RESULTS = "results.csv"  # default table of a value
LABELS = ("fitted", "known", "held out", "blind", "scored")
REFERENCES = ("measured", "report", "formula", "ours", "program")  # kinds of sources of a reference
SOURCES = (  # of errors
    "time average", "cells", "grain size", "domain", "packings", "parameters", "contact", "tests", "none",
)  # fmt: skip
TABLE = "table of the study"  # source of an error that has no parts
NOT_ESTIMATED = "not estimated"
AGREES, NEAR = 0.10, 0.25  # relative differences
COVERAGE = 2.0  # standard errors within which values may differ

# Verdicts
AGREE, MET, CLOSE, DIFFERS, MISSED = "agrees", "met", "near", "differs", "missed"
INCONCLUSIVE, NOTHING = "inconclusive", "nothing to compare"
NOT_DONE, OUTSIDE = "not done", "outside"
VERDICTS = (AGREE, MET, CLOSE, DIFFERS, MISSED, INCONCLUSIVE, NOTHING, NOT_DONE, OUTSIDE)
NEED_REASON = (CLOSE, DIFFERS, MISSED, NOTHING, NOT_DONE, OUTSIDE)


def verdict_of(value: float, error: float, reference: float, reference_error: float = 0.0) -> str:
    """Verdict on a value that should be equal to its reference; errors are standard errors, 0: not known.

    Values agree within 10 % of the reference, or within the scatter of the measurement. A value
    that only its own error brings within reach of the reference is inconclusive, and so is every
    agreement that would allow more than 25 %.
    """
    off, scale = abs(value - reference), abs(reference)
    allowed = max(AGREES * scale, COVERAGE * reference_error)
    reach = max(allowed, COVERAGE * math.hypot(error, reference_error))
    if off <= reach:
        return AGREE if off <= allowed and reach <= NEAR * scale else INCONCLUSIVE
    return CLOSE if off <= NEAR * scale else DIFFERS


def limit_verdict(value: float, error: float, reference: float, upper: bool) -> str:
    """Verdict on a value that should not be above (upper) or below its reference.

    A limit that is met says nothing where the error allows more than 25 % of the larger of both.
    """
    inside = reference - value if upper else value - reference
    scale = max(abs(value), abs(reference))
    vague = reference != 0.0 and COVERAGE * error > NEAR * scale
    if abs(inside) < COVERAGE * error or (inside >= 0.0 and vague):
        return INCONCLUSIVE
    return MET if inside >= 0.0 else MISSED


@cache
def table_rows(path: Path) -> list[dict[str, str]]:
    return read_rows(path)


@dataclass(frozen=True)
class Stored:
    """One number of a study's table: that of a column in the one row with these texts."""

    table: Path
    row: Mapping[str, str]
    column: str
    scale: float = 1.0

    def read(self, folder: Path | None = None) -> float:
        """folder: another one with the same tables. @raises ResultsError"""
        path = folder / self.table.name if folder else self.table
        if not path.is_file():
            raise ResultsError(f"{path}: no such table; furrow-post study {path.parent} writes it")
        rows = table_rows(path)
        found = [r for r in rows if all(r.get(name) == text for name, text in self.row.items())]
        if len(found) != 1:
            raise ResultsError(f"{path}: {len(found)} rows have {dict(self.row)}, one is needed")
        try:
            return self.scale * float(found[0][self.column])
        except (KeyError, ValueError) as error:
            raise ResultsError(
                f"{path}: no number in column '{self.column}' of {self.row}"
            ) from error


@dataclass(frozen=True)
class Part:
    """One part of a standard error: a number, a stored one, or the distance between two stored ones.

    of: one of SOURCES, or TABLE; tests: their number where the value is an rms over tests, whose error is
    the rms over the root of twice the number.
    """

    of: str
    number: float | Stored = 0.0
    other: Stored | None = None
    tests: int = 0

    def size(self, value: float) -> float:
        if self.tests:
            return abs(value) / math.sqrt(2 * self.tests)
        number = self.number.read() if isinstance(self.number, Stored) else self.number
        return abs(number - self.other.read()) if self.other else abs(number)


@dataclass(frozen=True)
class StudyValue:
    """A number of a study, and what it is compared with.

    reference: a number, or another stored one; limit: "upper" or "lower" where the reference is
    one; without: verdict of an entry that nothing was computed for; reason: of a verdict of
    NEED_REASON, for "nothing to compare" what a comparison needs.
    """

    id: str
    stored: Stored | None = None
    error: tuple[Part, ...] | None = None  # of the standard error, their root sum square; None: not estimated
    over: Stored | None = None  # divides the stored number: the value is a ratio
    unit: str = ""
    place: str = ""  # page, table or figure of the source
    group: str = ""
    what: str = ""
    quantity: str = ""
    reference: float | Stored | None = None
    reference_error: float | Stored = 0.0  # standard error; of a mean of tests it follows from their scatter
    reference_scatter: float = 0.0  # standard deviation of one test
    reference_tests: int = 1  # number of tests in the mean of the reference
    reference_of: str = ""
    limit: str = ""
    label: str = "known"
    reason: str = ""
    remark: str = ""
    hours: str = ""  # [h] duration of the computation of the source
    cost: Stored | None = None  # [s] of one core
    cheap: bool = False  # the test of seconds repeats it
    without: str = NOT_DONE

    @property
    def study(self) -> str:
        return self.id.partition(".")[0]

    def computed(self, folder: Path | None = None) -> float | None:
        if self.stored is None:
            return None
        return self.stored.read(folder) / (self.over.read(folder) if self.over else 1.0)

    def uncertainty(self) -> float | None:
        """Standard error of the computed value; None where it is not known."""
        return None if self.error is None else self._sum(self.error)

    def _sum(self, parts: Sequence[Part]) -> float:
        value = self.computed() or 0.0
        return math.hypot(*(part.size(value) for part in parts))

    def time_error(self) -> float:
        """The part of the error that a repeated run may show."""
        return self._sum([part for part in self.error or () if part.of in ("time average", TABLE)])

    def sources(self) -> str:
        """Sources of the error."""
        return "; ".join(part.of for part in self.error or ())

    def expected(self) -> float | None:
        return self.reference.read() if isinstance(self.reference, Stored) else self.reference

    def expected_error(self) -> float:
        """Standard error of the reference."""
        error = self.reference_error
        of_tests = self.reference_scatter / math.sqrt(self.reference_tests)
        return math.hypot(error.read() if isinstance(error, Stored) else error, of_tests)

    def verdict(self, folder: Path | None = None) -> str:
        value, expected = self.computed(folder), self.expected()
        if value is None:
            return self.without
        if expected is None:
            return NOTHING
        error = self.uncertainty()
        if error is None:
            return INCONCLUSIVE
        if self.limit:
            return limit_verdict(value, error, expected, self.limit == "upper")
        return verdict_of(value, error, expected, self.expected_error())

    def row(self) -> dict[str, str]:
        """Row of experiments.csv."""
        verdict, error = self.verdict(), self.uncertainty()
        return {
            "id": self.id,
            "group": self.group,
            "source": self.place,
            "what": self.what,
            "quantity": self.quantity,
            "unit": self.unit,
            "computed": number(self.computed(), 4),
            "error": NOT_ESTIMATED if self.stored and error is None else number(error, 2),
            "error_of": self.sources() if self.stored else "",
            "reference": number(self.expected(), 4),
            "reference_error": number(self.expected_error() or None, 2),
            "reference_scatter": number(self.reference_scatter or None, 2),
            "reference_of": self.reference_of,
            "limit": self.limit,
            "label": self.label if self.stored and self.reference is not None else "",
            "verdict": verdict,
            "study": self.study,
            "hours": self.hours,
            "core_s": number(self.cost.read() if self.cost else None),
            "remark": self.remark,
            "reason": self.reason if verdict in NEED_REASON else "",
        }


def number(value: float | None, digits: int = 3) -> str:
    """Rounded to so many digits, without an exponent; empty for None."""
    if value is None:
        return ""
    text = f"{float(f'{value:.{digits}g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


# ---- study.yaml


class _Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):  # type: ignore[misc]
    """YAML in which on, off, yes and no are words."""


_Loader.yaml_implicit_resolvers = {
    first: [(tag, words) for tag, words in known if not tag.endswith(":bool")]
    for first, known in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
_Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(true|false)$"), list("tf"))


def load_yaml(path: Path) -> dict[str, Any]:
    """The mapping of a study.yaml. @raises ResultsError"""
    try:
        with content_of(path, "a study is described in YAML"), open(path, encoding="utf-8") as file:
            content = yaml.load(file, Loader=_Loader)
    except yaml.YAMLError as error:
        raise ResultsError(f"{path}: {' '.join(str(error).split())}; correct the YAML") from error
    if not isinstance(content, dict):
        raise ResultsError(f"{path}: is no mapping; a study has keys such as title, cases, values")
    return content


STORED_KEYS = ("table", "row", "column", "scale")
ALLOWED = {
    "label": LABELS, "reference_of": ("", *REFERENCES), "limit": ("", "upper", "lower"), "without": VERDICTS,
}  # fmt: skip


def _stored(folder: Path, entry: Any, like: Stored | None, where: str) -> Stored:
    """entry: a mapping with STORED_KEYS, or a column; keys that it lacks are as in like."""
    if not isinstance(entry, Mapping):
        entry = {"column": entry}
    refuse_others(where, entry, STORED_KEYS)
    like = like or Stored(folder / RESULTS, {}, "")
    return Stored(
        folder / str(entry.get("table") or like.table.name),
        {str(name): str(text) for name, text in entry.get("row", like.row).items()},
        str(entry.get("column") or like.column),
        float(entry.get("scale", like.scale)),
    )


def _part(folder: Path, entry: Mapping[str, Any], like: Stored | None, where: str) -> Part:
    """entry: `of` with value, or between (two stored numbers), or tests, or a stored number."""
    of, rest = entry.get("of", ""), {k: v for k, v in entry.items() if k != "of"}
    if of not in SOURCES:
        raise ResultsError(f"{where}: of, of a part of its error, is one of {', '.join(SOURCES)}")
    if set(rest) == {"tests"}:
        return Part(of, tests=int(rest["tests"]))
    if set(rest) == {"value"} or not rest:
        return Part(of, float(rest.get("value", 0.0)))
    if set(rest) == {"between"} and len(rest["between"]) == 2:
        first, second = (_stored(folder, one, like, f"{where}: error") for one in rest["between"])
        return Part(of, first, second)
    return Part(of, _stored(folder, rest, like, f"{where}: error"))


def _error(folder: Path, given: dict[str, Any], stored: Stored | None, where: str) -> tuple[Part, ...] | None:
    """Parts of the keys error and next: the same with the next size of cells, whose distance is the error."""
    error, following = given.pop("error", None), given.pop("next", None)
    if error is None and following is not None and stored:
        return (Part("cells", _stored(folder, following, stored, f"{where}: next"), stored),)
    if isinstance(error, list):
        return tuple(_part(folder, entry, stored, where) for entry in error)
    if error is None or isinstance(error, (int, float)):
        return None if error is None else (Part(TABLE, error),)
    return (Part(TABLE, _stored(folder, error, stored, f"{where}: error")),)


def _value(folder: Path, entry: Mapping[str, Any]) -> StudyValue:
    where = f"{folder / DEFINITION}: value '{entry.get('id', '')}'"
    refuse_others(where, entry, {*(item.name for item in fields(StudyValue)), "next", *STORED_KEYS})
    if not entry.get("id"):
        raise ResultsError(f"{where} has no id; give each value one")
    if "over" in entry and "next" in entry:
        raise ResultsError(f"{where}: next is no error of a ratio; give error in place of it")
    given = {k: v for k, v in entry.items() if k not in STORED_KEYS}
    own = {k: entry[k] for k in STORED_KEYS if k in entry}
    stored = _stored(folder, own, None, where) if "column" in entry else None
    given |= {"id": f"{folder.name}.{entry['id']}", "stored": stored, "error": _error(folder, given, stored, where)}
    for key in ("over", "reference", "reference_error", "cost"):
        if key in given and not isinstance(given[key], (int, float)):
            one = _stored(folder, given[key], stored, f"{where}: {key}")
            # a cost is in seconds and has no scale
            given[key] = replace(one, scale=1.0) if key == "cost" and isinstance(given[key], str) else one
    value = StudyValue(**given)
    for key, allowed in ALLOWED.items():
        if getattr(value, key) not in allowed:
            raise ResultsError(f"{where}: {key} is one of {', '.join(filter(None, allowed))}")
    return value


def values_of(folder: Path) -> list[StudyValue]:
    """Values of the study in this folder. @raises ResultsError"""
    return [_value(folder, entry) for entry in load_yaml(folder / DEFINITION).get("values") or []]


def study_folders(root: Path) -> list[Path]:
    """All folders below the inputs of a project that hold a study."""
    return sorted(path.parent for path in (root / "inputs").rglob(DEFINITION))


class Registry:
    """The values of all studies by their id. @raises ResultsError where two have the same"""

    def __init__(self, values: Sequence[StudyValue]) -> None:
        self.values: dict[str, StudyValue] = {}
        for value in values:
            if value.id in self.values:
                raise ResultsError(f"two values are called '{value.id}'; rename one of them")
            self.values[value.id] = value

    @classmethod
    def of(cls, root: Path) -> "Registry":
        return cls([value for folder in study_folders(root) for value in values_of(folder)])

    def __iter__(self) -> Iterator[StudyValue]:
        return iter(self.values.values())

    def __getitem__(self, id: str) -> StudyValue:
        if id not in self.values:
            raise ResultsError(f"no value is called '{id}'; inputs/validation/experiments.csv lists all")
        return self.values[id]
