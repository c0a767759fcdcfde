# SPDX-License-Identifier: GPL-2.0-or-later
"""results.csv, a line per value, and the table of the page, which is made of its lines alone."""

import math
from collections.abc import Iterable, Mapping

from furrow_post.uncertainty.budget import Budget
from furrow_post.analyse.plates import pressure_at
from furrow_post.uncertainty.verdict import BEST, COVERAGE, FORMULA, MEASURED, QUANTITIES, RUN
from furrow_post.uncertainty.verdict import Agreement, Entry, Quantity, verdict_between
from furrow_post.formatting import in_unit, percent
from furrow_post.csv_table import markdown

OutputRow = dict[str, str]

HEAD = (
    "# Written by evaluate.py; SI units, uncertainties are standard deviations, their parts named",
    "# error_*; empty: not known. place: base, another law of the continuum, or the condition of a",
    "# point of a series; element: size of cells or grains; program: of the executable, SHA-256.",
)
GROUNDS = ("continuum", "grains", "hybrid")
PRESSURE = "pressure_"
ANSWERS = {
    Agreement.AGREE: "yes",
    Agreement.DIFFER: "no",
    Agreement.INCONCLUSIVE: "inconclusive",
}
TABLE_HEAD = ("case", "", *GROUNDS, "measured", "agree, difference (allowed)")


def known(number: float) -> str:
    return f"{number:.6g}" if math.isfinite(number) else ""


def line_of(
    case: str, place: str, entry: Entry, element: float = math.nan, program: str = ""
) -> OutputRow:
    """element: size of the run's cells or grains [m]."""
    return {
        "case": case,
        "place": place,
        "quantity": entry.quantity.key,
        "source": entry.source,
        "kind": entry.kind,
        "element": known(element),
        "value": known(entry.value),
        **{f"error_{name}": known(entry.parts.part(name)) for name in Budget.NUMERICAL},
        "cpu_time": known(entry.cpu_time),
        "program": program,
    }


def number_line(case: str, place: str, quantity: str, value: float) -> OutputRow:
    """A number on the case that is of no one ground."""
    nothing = dict.fromkeys(
        ("source", "element", *(f"error_{name}" for name in Budget.NUMERICAL), "cpu_time"), ""
    )
    own = {"case": case, "place": place, "quantity": quantity, "kind": "difference"}
    return {**own, **nothing, "value": known(value), "program": ""}


def entry_of(line: Mapping[str, str]) -> Entry:
    parts = [number(line[f"error_{name}"]) for name in Budget.NUMERICAL]
    quantity = quantity_of(line["quantity"])
    value = number(line["value"])
    return Entry(quantity, line["source"], value, Budget(*parts), line["kind"])


def number(text: str) -> float:
    return float(text) if text else math.nan


def quantity_of(key: str) -> Quantity:
    if key.startswith(PRESSURE):
        return pressure_at(float(key.removeprefix(PRESSURE)))
    return next(quantity for quantity in QUANTITIES if quantity.key == key)


def is_value(line: Mapping[str, str]) -> bool:
    """True if the line has a place in the table."""
    return line["kind"] in (RUN, BEST, FORMULA, MEASURED) and not is_point(line)


def is_point(line: Mapping[str, str]) -> bool:
    """True if the line is of a series."""
    return "=" in line["place"]


def series_value(line: Mapping[str, str], name: str) -> float | None:
    """Value of this condition at a point of a series; None for lines without a series."""
    own, _, value = line["place"].partition("=")
    return float(value) if own == name else None


def table(lines: Iterable[Mapping[str, str]]) -> list[str]:
    """A row for each quantity of a case: of each ground the best estimate, else the value at the run's size."""
    groups: dict[tuple[str, str, str], list[Mapping[str, str]]] = {}
    for line in lines:
        if is_value(line):
            key = (line["case"], line["place"], line["quantity"])
            groups.setdefault(key, []).append(line)
    rows = []
    for (case, place, _), group in groups.items():
        name = case.replace("_", " ") + ("" if place == "base" else f", {place}")
        own = {**entries(group, RUN), **entries(group, BEST)}
        if own:
            quantity = next(iter(own.values())).quantity
            cells = [name, quantity.name + in_unit(quantity.unit)]
            cells += [own[ground].text() if ground in own else "" for ground in GROUNDS]
            cells.append("; ".join(entry.text() for entry in entries(group, MEASURED).values()))
            rows.append([*cells, "; ".join(answers(own))])
    return markdown(TABLE_HEAD, rows)


def entries(group: Iterable[Mapping[str, str]], kind: str) -> dict[str, Entry]:
    """Entries of the cross-check by source."""
    return {line["source"]: entry_of(line) for line in group if line["kind"] == kind}


def answers(own: Mapping[str, Entry]) -> list[str]:
    """Sentences on how far the other grounds are from the continuum, whether they agree, what their
    uncertainty allows, and which parts of it are not known."""
    if GROUNDS[0] not in own:
        return []
    first, others = own[GROUNDS[0]], [own[name] for name in GROUNDS[1:] if name in own]
    found = []
    for other in others:
        allowed = COVERAGE * math.hypot(first.uncertainty, other.uncertainty) / abs(first.value)
        limit = f" ({100 * allowed:.0f} %)" if math.isfinite(allowed) else ""
        name = f"{other.source}: " if len(others) > 1 else ""
        verdict = verdict_between(first, other)
        lacking = f", unknown: {', '.join(verdict.unknown)}" if verdict.unknown else ""
        difference = percent(other.value / first.value - 1)
        found.append(f"{name}{ANSWERS[verdict.agreement]}, {difference}{limit}{lacking}")
    return found
