# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of a run for the screen: values with whole errors, quantities that are not steady, and the verdict as the last line."""

from pathlib import Path

from ..uncertainty.whole_error import budgets_of, report, value_text, write_budget
from ..run.summary import Summary

QUICK = "quick run, too short for steady values"


def result_lines(folder: Path, quick: bool) -> list[str]:
    """The result for the screen; writes budget.json. @raises ResultsError"""
    summary = Summary(folder)
    lines = [f"WARNING: {warning}" for warning in summary.content.get("warnings", [])]
    if summary.headline:
        write_budget(folder)
        lines += [*report(folder).splitlines(), *(f"Not steady: {reason}" for reason in summary.content["reasons"])]
    return [*lines, f"Summary: {folder}/summary.txt", verdict_line(folder, quick)]


def verdict_line(folder: Path, quick: bool) -> str:
    """ "Verdict: steady, net traction coefficient 0.06 ± 0.12, hub drop 94 ± 12 mm"."""
    summary = Summary(folder)
    if quick:
        return f"Verdict: {QUICK}"
    if not summary.headline:
        return f"Verdict: {summary.verdict}"
    known = budgets_of(folder)
    texts = []
    for name in (_answer(summary), "hub_drop"):
        value = summary.quantity(name)
        if value:
            texts.append(f"{name.replace('_', ' ')} {value_text(name, value, known[name])}")
    return f"Verdict: {summary.verdict.partition(',')[0]}, {', '.join(texts)}"


def _answer(summary: Summary) -> str:
    """Quantity that the run was made for: its coefficient, or the slip where that is imposed."""
    name = next((name for name in summary.headline if name.endswith("coefficient")), "slip")
    value = summary.quantity(name)
    return "slip" if value and value.imposed else name
