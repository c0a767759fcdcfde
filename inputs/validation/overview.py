# SPDX-License-Identifier: GPL-2.0-or-later
"""The table of all experiments on this folder's page, made of the stored tables of the studies."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import programs

from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.study.tables import markdown

HERE = Path(__file__).resolve().parent
BEGIN, END = "<!-- written by run -->", "<!-- end -->"
UNMET = ("differs", "missed")  # verdicts that need a reason
NOTHING, OUTSIDE, NOT_DONE = "nothing to compare", "outside", "not done"
VERDICTS = ("agrees", "met", "near", *UNMET, NOTHING, OUTSIDE, NOT_DONE)
AGREES, NEAR = 0.10, 0.25  # relative differences that are called so
HEAD = (
    "in the report",
    "experiment",
    "quantity",
    "unit",
    "report",
    "measured",
    "ours",
    "±",
    "difference %",
    "verdict",
    "report h",
    "ours core s",
    "study",
    "program",
    "remark",
)


@dataclass(frozen=True)
class Stored:
    """One number of a study's table: that of a column in the one row with these texts."""

    table: str  # relative to this folder
    row: Mapping[str, str]
    column: str
    scale: float = 1.0

    @property
    def study(self) -> str:
        return self.table.rpartition("/")[0]

    def value(self, study: Path | None = None) -> float:
        """study: another folder with the study's tables.

        @raises ResultsError where the table, row or number is not there
        """
        path = study / Path(self.table).name if study else HERE / self.table
        if not path.is_file():
            raise ResultsError(f"{path}: is not there; inputs/validation/run {self.study} makes it")
        found = [
            row
            for row in read_rows(path)
            if all(row.get(name) == text for name, text in self.row.items())
        ]
        if len(found) != 1:
            raise ResultsError(f"{path}: {len(found)} rows have {dict(self.row)}, one is needed")
        try:
            return self.scale * float(found[0][self.column])
        except (KeyError, ValueError) as error:
            raise ResultsError(f"{path}: no number in '{self.column}' of {self.row}") from error


@dataclass(frozen=True)
class Experiment:
    """A row of the page. Numbers of the report and measured ones are as printed, or stored where a
    formula of the report gives them.

    why: the reason where ours differs or misses, and last, in brackets, the study whose page shows
    it; near: the same number with the next size of cells or mesh; the distance is its uncertainty.
    limit: the reference is an upper limit; floor: a lower one. A row without ours says why; aside:
    its verdict where nothing could be done.
    """

    place: str  # in the report
    what: str
    quantity: str
    unit: str = ""
    report: str | Stored = ""
    measured: str = ""
    ours: Stored | None = None
    near: Stored | None = None
    uncertainty: Stored | None = None
    limit: bool = False
    floor: bool = False
    hours: str = ""  # that the report's computation took [h]
    cost: Stored | None = None  # [core s] of ours
    remark: str = ""
    why: str = ""
    aside: str = ""

    def reference(self) -> float | None:
        """The measured number, or else the report's."""
        given = self.measured or self.report
        if isinstance(given, Stored):
            return given.value()
        return float(given) if given else None

    def error(self) -> float | None:
        """The uncertainty of ours, where it is known."""
        if self.ours is None:
            return None
        if self.uncertainty:
            return self.uncertainty.value()
        return abs(self.near.value() - self.ours.value()) if self.near else None

    def verdict(self, own: float | None = None) -> str:
        """own: another number in place of ours."""
        if self.ours is None:
            return self.aside or NOT_DONE
        reference, own = self.reference(), self.ours.value() if own is None else own
        if reference is None:
            return NOTHING
        if self.limit:
            return "met" if own <= reference else "missed"
        if self.floor:
            return "met" if own >= reference else "missed"
        off, error = abs(own - reference), self.error() or 0.0
        if off <= max(AGREES * abs(reference), error):
            return "agrees"
        return "near" if off <= NEAR * abs(reference) else "differs"

    def cells(self) -> list[str]:
        own, error, reference = None, self.error(), self.reference()
        difference = ""
        if self.ours is not None:
            own = self.ours.value()
            if reference and not (self.limit or self.floor):
                difference = f"{round(100 * (own / reference - 1)):+d}"
        study = self.ours.study if self.ours else ""
        sign = "< " if self.limit else "> " if self.floor else ""
        verdict = self.verdict()
        why = self.why if verdict in UNMET else ""
        stated = self.report if isinstance(self.report, str) else number(self.report.value())
        return [
            self.place,
            self.what,
            self.quantity,
            self.unit,
            sign + stated if stated else "",
            sign + self.measured if self.measured else "",
            number(own),
            number(error, 2),
            difference,
            verdict,
            self.hours,
            number(self.cost.value() if self.cost else None),
            f"[{Path(study).name}]({study}/README.md)" if study else "",
            programs.cell(HERE / self.ours.table) if self.ours else "",
            "; ".join(filter(None, (self.remark, why))),
        ]

    def reason(self) -> str:
        """Why the row differs, is missed, not done or outside; empty for others."""
        verdict = self.verdict()
        if verdict in UNMET:
            return self.why
        return self.remark if verdict in (NOT_DONE, OUTSIDE) else ""


def number(value: float | None, digits: int = 3) -> str:
    """Rounded to so many digits, without an exponent."""
    if value is None:
        return ""
    text = f"{float(f'{value:.{digits}g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


@dataclass(frozen=True)
class Group:
    """Rows under a heading."""

    title: str
    rows: Sequence[Experiment] = field(default_factory=tuple)


def counts(groups: Sequence[Group]) -> str:
    """How many rows have which verdict."""
    verdicts = [row.verdict() for group in groups for row in group.rows]
    parts = [f"{verdicts.count(name)} {name}" for name in VERDICTS if name in verdicts]
    return f"{len(verdicts)} rows: {', '.join(parts)}."


def old(groups: Sequence[Group]) -> str:
    """How many rows are by a program whose numbers have moved since."""
    column = HEAD.index("program")
    cells = [row.cells()[column] for group in groups for row in group.rows if row.ours]
    found = sum(f" {programs.OLD}" in cell for cell in cells)
    return f"By a program from before a change of numbers: {found} of {len(cells)} computed rows."


def reasons(groups: Sequence[Group]) -> list[str]:
    """A table of the reasons of all rows that are not met, each once; what is missed first."""
    order = ("missed", "differs", NOT_DONE, OUTSIDE)
    unmet: dict[str, list[Experiment]] = {}
    for row in (row for group in groups for row in group.rows):
        if reason := row.reason():
            unmet.setdefault(reason, []).append(row)
    lines = []
    for reason, rows in unmet.items():
        found = [row.verdict() for row in rows]
        counted = ", ".join(f"{found.count(name)} {name}" for name in order if name in found)
        places = "; ".join(dict.fromkeys(row.place for row in rows))
        lines.append((min(map(order.index, found)), (reason, counted, places)))
    lines.sort(key=lambda line: line[0])
    return markdown(("reason", "rows", "in the report"), (cells for _, cells in lines))


def section(groups: Sequence[Group]) -> list[str]:
    """Lines of the page's generated part."""
    lines = [counts(groups), "", old(groups), ""]
    lines += ["### Why rows differ, are missed, not done or outside", "", *reasons(groups), ""]
    for group in groups:
        lines += [f"### {group.title}", ""]
        lines += markdown(HEAD, (row.cells() for row in group.rows)) + [""]
    return lines
