# SPDX-License-Identifier: GPL-2.0-or-later
"""Do two values agree? The verdict on them, and several verdicts in one line.

They agree when they differ by no more than COVERAGE times the root of the sum of the squares of
their uncertainties; what is not known of these is named, not taken as zero.
"""

import math
from collections.abc import Sequence

from .entry import BEST, MEASURED, Entry
from .verdict import COVERAGE, Agreement, Verdict, joined, quantities_with

VAGUE = 0.25  # beyond this part of the value, agreement says nothing


def judge(a: Entry, b: Entry) -> Verdict:
    """The verdict on two entries of a quantity."""
    quantity = a.quantity
    name = f"{quantity.name}, {BEST}" if a.kind == BEST else quantity.name
    measured = MEASURED in (a.kind, b.kind)
    difference = b.value - a.value
    relative = f"{100 * difference / a.value:+.0f} %" if a.value else ""
    no_uncertainty = [e.source for e in (a, b) if not math.isfinite(e.uncertainty)]
    if no_uncertainty:
        sentence = (
            f"{name}: {b.source} against {a.source}: {relative}; no verdict, "
            f"{', '.join(no_uncertainty)} has no uncertainty"
        )
        return Verdict(quantity, a.source, b.source, Agreement.UNKNOWN, sentence, measured)
    allowed = COVERAGE * math.hypot(a.uncertainty, b.uncertainty)
    unknown = tuple(sorted({f"{part} of {e.source}" for e in (a, b) for part in e.unknown}))
    agreement, what, share = Agreement.AGREE, "agree", ""
    if abs(difference) > allowed:
        agreement, what = Agreement.DIFFER, "differ"
    elif allowed > VAGUE * abs(a.value):
        agreement, what = Agreement.UNDECIDED, "cannot be told apart"
        share = f", {100 * allowed / abs(a.value):.0f} % of the value"
    unit = f" {quantity.unit}" if quantity.unit else ""
    sentence = (
        f"{name}: {a.source} and {b.source} {what}: "
        f"{quantity.scale * difference:+.3g}{unit} ({relative}), "
        f"{quantity.scale * allowed:.2g} allowed{share}"
    )
    if unknown:
        sentence += f"; not known: {', '.join(unknown)}"
    return Verdict(quantity, a.source, b.source, agreement, sentence, measured, unknown)


def summed_up(among: Sequence[Verdict], who: str) -> str:
    """Several verdicts in one line; who: were judged."""
    differing = quantities_with(among, Agreement.DIFFER)
    undecided = quantities_with(among, Agreement.UNDECIDED)
    unknown = quantities_with(among, Agreement.UNKNOWN)
    agreed = [
        name
        for name in quantities_with(among, Agreement.AGREE)
        if name not in differing + undecided + unknown
    ]
    verdict = ""
    if differing:
        known = " as far as their uncertainty is known" if any(v.unknown for v in among) else ""
        verdict = f"The {who} do not agree in {joined(differing)}{known}."
    elif undecided:
        if agreed:
            verdict = f"The {who} agree in {joined(agreed)} within their uncertainty; "
        verdict += f"in {joined(undecided)} they" if agreed else f"In {joined(undecided)} the {who}"
        verdict += " cannot be told apart: the uncertainty is too large."
    elif not unknown:
        verdict = f"The {who} agree within their uncertainty in hub drop and resistance."
    elif agreed:
        verdict = f"The {who} agree in {joined(agreed)} within their uncertainty."
    if unknown:
        verdict += f" There is no verdict in {joined(unknown)}: an uncertainty is not known."
    return verdict.strip()
