# SPDX-License-Identifier: GPL-2.0-or-later
"""The verdict on a run: the last line on the screen."""

from pathlib import Path

from ..run.summary import Summary

QUICK = "quick run, too short for steady values"


def verdict_line(folder: Path, quick: bool) -> str:
    """ "Verdict: steady, net traction coefficient 0.126 ± 0.007, hub drop 101.1 ± 0.2 mm"."""
    return f"Verdict: {QUICK if quick else Summary(folder).verdict}"
