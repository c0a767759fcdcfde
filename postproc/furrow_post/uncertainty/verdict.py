# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that are compared, each with its whole error; whether two agree, and several verdicts in one line.

Two values agree when they differ by no more than COVERAGE times the root of the sum of the squares of their
uncertainties. A verdict is inconclusive while a part of an uncertainty is unknown, and where the uncertainty is so
large that agreement has no meaning.
"""

import enum
import math
from collections.abc import Sequence
from dataclasses import dataclass

from ..formatting import in_unit, value_text
from .budget import Budget

COVERAGE = 2.0  # standard errors within which two values agree
VAGUE = 0.25  # of the value: agreement within more has no meaning
BARS = f"bars: {COVERAGE:g} standard errors"  # for the legends of figures

# Kinds of entries; BEST: estimate for a run from the sizes of its family (grid_convergence.py)
RUN, BEST, FORMULA, MEASURED = "run", "best estimate", "formula", "measured"
# part of an uncertainty -> its name, and the run that finds it
PARTS = {
    "time": ("time average", "a longer run"),
    "size": ("size of cells or grains", "two runs with other sizes, such as -v cell or -v diameter"),
    "domain": ("size of the ground", "a run on wider ground, such as -v width"),
    "packing": ("packing of grains", "two runs with other packings, such as -v seed"),
}
TABLE_OF_RUNS = "'furrow-post cost RUNS... --write errors.csv', then this command with '--errors errors.csv'"


class Agreement(enum.Enum):
    """Judgement of the difference of two values by their uncertainty."""

    AGREE = "agree"  # within their uncertainty
    DIFFER = "differ"  # by more than their uncertainty
    INCONCLUSIVE = "inconclusive"  # a part of their uncertainty is unknown, or it is too large


@dataclass(frozen=True)
class Quantity:
    """Quantity that is compared; scale: from SI to the unit that people read."""

    key: str
    name: str
    unit: str
    scale: float

    @property
    def label(self) -> str:
        """ "hub drop [mm]"."""
        return self.name + in_unit(self.unit)


# key: the column of inputs/costs/*.csv
HUB_DROP = Quantity("sinkage", "hub drop", "mm", 1e3)
COEFFICIENT = Quantity("coefficient", "resistance coefficient", "", 1.0)
QUANTITIES = (HUB_DROP, COEFFICIENT)
TRACK_DENSITY = Quantity("track_density", "density under the track", "kg/m3", 1.0)  # without a verdict


@dataclass(frozen=True)
class Entry:
    """One value of one quantity in the comparison, SI."""

    quantity: Quantity
    source: str  # label of a run, name of a formula, "measured"
    value: float
    parts: Budget
    kind: str  # RUN, BEST, FORMULA, MEASURED
    note: str = ""
    cpu_time: float = math.nan
    steady: bool = True  # false if the error of the time average is unknown

    @property
    def label(self) -> str:
        """The source, "grains, best estimate" of one."""
        return f"{self.source}, {BEST}" if self.kind == BEST else self.source

    @property
    def of_run(self) -> bool:
        """True where the uncertainty of the entry has the parts of a run's."""
        return self.kind in (RUN, BEST)

    @property
    def uncertainty(self) -> float:
        """Standard uncertainty; NaN if no part is known."""
        return self.parts.total

    @property
    def unknown(self) -> list[str]:
        """Parts of its numerical uncertainty that are not known; of a value without any: the uncertainty."""
        if not math.isfinite(self.uncertainty):
            return ["uncertainty"]
        lacking = {*self.parts.unknown, *(() if self.steady else ("time",))} if self.of_run else set()
        return [name for name in self.parts.NUMERICAL if name in lacking]

    def text(self) -> str:
        """The value with its uncertainty in the unit of the quantity."""
        scale = self.quantity.scale
        return value_text(scale * self.value, scale * self.uncertainty)


@dataclass(frozen=True)
class Verdict:
    """The verdict on two values of one quantity."""

    quantity: Quantity
    agreement: Agreement
    sentence: str
    with_measurement: bool = False
    unknown: tuple[str, ...] = ()  # parts of the uncertainty that are not known, "size of a"


def verdict_between(a: Entry, b: Entry) -> Verdict:
    """The verdict on two entries of a quantity."""
    quantity, difference = a.quantity, b.value - a.value
    allowed = COVERAGE * math.hypot(a.uncertainty, b.uncertainty)
    unknown = tuple(sorted({f"{part} of {e.source}" for e in (a, b) for part in e.unknown}))
    if unknown:
        agreement, what = Agreement.INCONCLUSIVE, f"inconclusive, unknown: {', '.join(unknown)}"
    elif abs(difference) > allowed:
        agreement, what = Agreement.DIFFER, f"{a.source} and {b.source} differ"
    elif allowed > VAGUE * abs(a.value):
        _, largest = max((e.parts.part(name), f"{name} of {e.source}") for e in (a, b) for name in e.parts.known)
        agreement, what = Agreement.INCONCLUSIVE, f"inconclusive, too large: {largest}"
    else:
        agreement, what = Agreement.AGREE, f"{a.source} and {b.source} agree"
    name = f"{quantity.name}, {BEST}" if a.kind == BEST else quantity.name
    unit = f" {quantity.unit}" if quantity.unit else ""
    sentence = f"{name}: {what}: {b.source} - {a.source} = {quantity.scale * difference:+.3g}{unit}"
    if a.value:
        sentence += f" ({100 * difference / a.value:+.0f} %)"
    if math.isfinite(allowed):
        sentence += f", {quantity.scale * allowed:.2g} allowed{' by the known parts' if unknown else ''}"
    return Verdict(quantity, agreement, sentence, MEASURED in (a.kind, b.kind), unknown)


def remedies(unknown: Sequence[str]) -> list[str]:
    """Remedies for unknown parts, as "size of a": a line for each, and the command that evaluates the runs."""
    lines = []
    for part, (name, runs) in PARTS.items():
        of_part = [u.partition(" of ")[2] for u in unknown if u.startswith(f"{part} of ")]
        if of_part:
            lines.append(f"{name} ({', '.join(dict.fromkeys(of_part))}): {runs}")
    of_other_runs = any(not part.startswith("time of ") for part in unknown)
    return [*lines, TABLE_OF_RUNS] if lines and of_other_runs else lines


def summed_up(among: Sequence[Verdict], who: str) -> str:
    """Several verdicts in one line; who: kind of the compared entries, for example runs."""
    names = {kind: list(dict.fromkeys(v.quantity.name for v in among if v.agreement is kind)) for kind in Agreement}
    differ, inconclusive = names[Agreement.DIFFER], names[Agreement.INCONCLUSIVE]
    agree = [name for name in names[Agreement.AGREE] if name not in differ + inconclusive]
    sentences = [f"The {who} differ in {' and '.join(differ)}."] if differ else []
    sentences += [f"The {who} agree in {' and '.join(agree)}."] if agree else []
    if inconclusive:
        unknown = dict.fromkeys(part for v in among for part in v.unknown)
        why = f"unknown: {', '.join(unknown)}" if unknown else "the uncertainty is too large"
        sentences.append(f"Inconclusive in {' and '.join(inconclusive)}; {why}.")
    return " ".join(sentences)


def conclusion(verdicts: Sequence[str], findings: Sequence[str], unknown: Sequence[str]) -> list[str]:
    """Lines at the end of a report: verdicts, what was found, and remedies for unknown parts."""
    lines = [f"  {verdict}" for verdict in verdicts if verdict] + [f"  - {finding}" for finding in findings]
    lines = ["Verdict", *(lines or ["  none: there is nothing to compare the run with"])]
    if needed := remedies(unknown):
        lines += ["", "To find what is unknown", *(f"  - {line}" for line in needed)]
    return lines
