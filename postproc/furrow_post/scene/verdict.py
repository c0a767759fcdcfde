# SPDX-License-Identifier: GPL-2.0-or-later
"""The summary of a run for the screen: its verdict in one line, good news first."""

import re
from pathlib import Path

from ..analyse.verdict import joined
from ..run.summary import Summary

VERDICT = re.compile(r"^Verdict: .*$", re.MULTILINE)
QUICK = "quick run: too short for steady values"
DRIVEN, TOWED = "net_traction_coefficient", "resistance_coefficient"


def summary_text(folder: Path, quick: bool) -> str:
    """summary.txt; the verdict of a quick run, or of one whose main values are steady, is short."""
    text = (folder / "summary.txt").read_text(encoding="utf-8")
    short = QUICK if quick else good_news(Summary(folder))
    return VERDICT.sub(lambda found: f"Verdict: {short}" if short else found[0], text, count=1)


def good_news(summary: Summary) -> str:
    """Of a run whose hub drop and coefficient are steady; empty for another."""
    torque = summary.quantity("drive_torque")
    coefficient = DRIVEN if torque and torque.mean else TOWED
    main = ("hub_drop", coefficient)
    values = [summary.quantity(name) for name in main]
    if not all(value and value.steady for value in values):
        return ""
    moving = [_title(name) for name, value in summary.quantities.items() if not value.get("steady")]
    if not moving:
        return "good: all values are steady"
    return f"good: {joined(map(_title, main))} are steady; not steady: {', '.join(moving)}"


def _title(name: str) -> str:
    return name.replace("_", " ")
