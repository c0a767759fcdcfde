# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of a run with their whole errors over the nearest measured tests."""

import textwrap

import numpy as np
from matplotlib.axes import Axes

from ..uncertainty.verdict import COVERAGE
from ..uncertainty.whole_error import OverTests

COLOURS = {"known": "#1f5a8a", "held out": "#4d8a4a", "blind": "#7a4b8c"}  # labels of tests
RUN_COLOUR = "C3"
MARGIN = 0.06  # of the axes around points and bars
TITLE = 76  # characters of a line


def draw_over_tests(axes: Axes, one: OverTests) -> None:
    """Measured against computed values of tests; the run with one (thick) and two standard errors where they agree."""
    for label, colour in COLOURS.items():
        own = [test for test in one.tests if test.label == label]
        if own:
            points = np.array([(test.computed, test.measured, test.error_of_value) for test in own]).T
            axes.errorbar(
                one.sign * points[0], one.sign * points[1], yerr=COVERAGE * points[2], fmt="o", ms=4, lw=0.7, color=colour, alpha=0.8,
                label=f"{label} tests",
            )  # fmt: skip
    if np.isfinite(one.error):
        axes.errorbar(one.value, one.value, yerr=one.error, color=RUN_COLOUR, lw=5, alpha=0.5, zorder=4)
    axes.errorbar(
        one.value, one.value, yerr=COVERAGE * one.error if np.isfinite(one.error) else None, fmt="D", ms=7, capsize=5, lw=1.6, color=RUN_COLOUR,
        zorder=5, label="this run, 1 and 2 standard errors",
    )  # fmt: skip
    axes.margins(MARGIN)
    low, high = axes.get_xlim()
    middle, half = 0.5 * (low + high), max(0.5 * (high - low), 0.2 * np.ptp(axes.get_ylim()))
    ends = (middle - half, middle + half)
    axes.plot(ends, ends, color="0.6", lw=0.8, ls="--", zorder=1, label="measured as computed")
    axes.set(xlim=ends, xlabel=f"computed {one.name}", ylabel=f"measured {one.name}")
    axes.set_title("\n".join(textwrap.wrap(one.title, TITLE)), fontsize=8, color="0.15")
    axes.legend(fontsize=7, loc="best", frameon=True, framealpha=0.8, edgecolor="none")
