# SPDX-License-Identifier: GPL-2.0-or-later
"""Do two values agree, differ, or is that inconclusive? And several verdicts in one line.

They agree when they differ by no more than COVERAGE times the root of the sum of the squares of
their uncertainties. A verdict is inconclusive while a part of an uncertainty is unknown, and where
the uncertainty is so large that agreement has no meaning.
"""

import math
from collections.abc import Sequence

from .verdict import BEST, COVERAGE, MEASURED, Agreement, Entry, Verdict, joined, quantities_with

VAGUE = 0.25  # of the value: agreement within more has no meaning
# part of an uncertainty -> its name, and the run that finds it
PARTS = {
    "time": ("time average", "a longer run"),
    "size": ("size of cells or grains", "two runs with other sizes, such as -v cell or -v diameter"),
    "domain": ("size of the ground", "a run on wider ground, such as -v width"),
    "packing": ("packing of grains", "two runs with other packings, such as -v seed"),
}
TABLE_OF_RUNS = "'furrow-post cost RUNS... --write errors.csv', then this command with '--errors errors.csv'"


def judge(a: Entry, b: Entry) -> Verdict:
    """The verdict on two entries of a quantity."""
    quantity = a.quantity
    name = f"{quantity.name}, {BEST}" if a.kind == BEST else quantity.name
    difference = b.value - a.value
    allowed = COVERAGE * math.hypot(a.uncertainty, b.uncertainty)
    unknown = tuple(sorted({f"{part} of {e.source}" for e in (a, b) for part in missing(e)}))
    vague = allowed > VAGUE * abs(a.value)
    agreement, what = Agreement.AGREE, f"{a.source} and {b.source} agree"
    if unknown:
        agreement, what = Agreement.INCONCLUSIVE, f"inconclusive, unknown: {', '.join(unknown)}"
    elif abs(difference) > allowed:
        agreement, what = Agreement.DIFFER, f"{a.source} and {b.source} differ"
    elif vague:
        agreement, what = Agreement.INCONCLUSIVE, f"inconclusive, too large: {largest_part(a, b)}"
    unit = f" {quantity.unit}" if quantity.unit else ""
    sentence = f"{name}: {what}: {b.source} - {a.source} = {quantity.scale * difference:+.3g}{unit}"
    if a.value:
        sentence += f" ({100 * difference / a.value:+.0f} %)"
    if math.isfinite(allowed):
        sentence += f", {quantity.scale * allowed:.2g} allowed"
        sentence += " by the known parts" if unknown else ""
    measured = MEASURED in (a.kind, b.kind)
    return Verdict(quantity, a.source, b.source, agreement, sentence, measured, unknown)


def missing(e: Entry) -> list[str]:
    """Parts of its uncertainty that are unknown; of a value without any: the uncertainty."""
    return e.unknown if math.isfinite(e.uncertainty) else ["uncertainty"]


def largest_part(*entries: Entry) -> str:
    """ "size of a"."""
    parts = [(e.parts.part(name), f"{name} of {e.source}") for e in entries for name in e.parts.known]
    return max(parts)[1]


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
    """Several verdicts in one line; who: were judged."""
    differ = quantities_with(among, Agreement.DIFFER)
    inconclusive = quantities_with(among, Agreement.INCONCLUSIVE)
    agree = [
        name
        for name in quantities_with(among, Agreement.AGREE)
        if name not in differ + inconclusive
    ]
    sentences = [f"The {who} differ in {joined(differ)}."] if differ else []
    if agree:
        sentences.append(f"The {who} agree in {joined(agree)}.")
    if inconclusive:
        unknown = dict.fromkeys(part for v in among for part in v.unknown)
        why = f"unknown: {', '.join(unknown)}" if unknown else "the uncertainty is too large"
        sentences.append(f"Inconclusive in {joined(inconclusive)}; {why}.")
    return " ".join(sentences)
