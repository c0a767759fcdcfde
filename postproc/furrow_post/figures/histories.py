# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of a run over the nearest tests; depths, forces, torque and slip against time or the place of the axle."""

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from ..uncertainty.budget import Budget
from ..uncertainty.verdict import COVERAGE
from ..analyse.wheel_histories import Stage
from ..uncertainty.whole_error import OverTests, budgets_of, headline, over_tests
from ..arrays import Floats
from ..errors import ResultsError
from ..formatting import with_error
from ..read.results import Results
from ..read.wheel_run import read_wheel_run
from ..run.summary import Summary
from .style import MILLIMETRE, save, use_style


@dataclass(frozen=True)
class Panel:
    """One panel of the figure."""

    title: str
    unit: str
    scale: float  # from SI
    channels: Mapping[str, str]  # of the history, with their legend; the mean of the first is marked

    @property
    def quantity(self) -> str:
        return next(iter(self.channels))


DEPTHS = {"hub_drop": "hub drop", "tyre_deflection": "tyre deflection", "rut_depth": "rut depth"}
FORCES = {"force_z": "vertical", "force_x": "along the travel", "force_y": "lateral"}
PANELS = (
    Panel("depth", "mm", MILLIMETRE, DEPTHS),
    Panel("forces of the ground", "N", 1.0, FORCES),
    Panel("drawbar pull", "N", 1.0, {"drawbar_pull": "drawbar pull"}),
    Panel("axle torque", "N m", 1.0, {"drive_torque": "axle torque"}),
    Panel("slip", "%", 100.0, {"slip": "slip"}),
)
OF_TYRES = ("tyre_deflection", "rut_depth")  # channels that are 0 and the hub drop for a rigid wheel
TOP = 4.0  # height of the values over tests [inch]
LINE_STYLES = ("-", "--", ":")
NAMED_BAND = 0.05  # of the axis: a narrower band has no name
# Values over tests: colours by the label of a test
TEST_COLOURS = {"known": "#1f5a8a", "held out": "#4d8a4a", "blind": "#7a4b8c"}
RUN_COLOUR = "C3"
MARGIN = 0.06  # of the axes around points and bars
TITLE = 76  # characters of a line
STAGE_COLOURS = {Stage.SETTLE: "0.93", Stage.ACCELERATE: "0.97", Stage.CRUISE: "1.0"}


def draw_histories(results: Results, target: Path, against: str = "time") -> None:
    """Draws the histories of a run.

    @param against  "time", or "x" for the place of the axle along the travel
    @raises ResultsError where it is not one of a wheel on a rig
    """
    use_style()
    summary, errors = Summary(results.folder), budgets_of(results.folder)
    wanted = ["time", against, *(name for panel in PANELS for name in panel.channels), "stage"]
    missing = [name for name in wanted if name not in (*results.columns, *OF_TYRES)]
    if missing:
        lacks = f"has no channel {', '.join(missing)}"
        raise ResultsError(f"{results.file}: {lacks}; plot needs the history of a wheel on a rig")
    time, stage = results.columns["time"], results.columns["stage"]
    abscissa = results.columns[against]
    if len(time) == 0:
        raise ResultsError(f"{results.file}: the history has no rows yet")
    rigid = not np.any(results.columns.get("tyre_deflection", 0.0))
    absent = OF_TYRES if rigid else ()
    over = _over_tests(results.folder) if summary.window else []
    whole = plt.figure(figsize=(10, 12 + TOP * bool(over)), layout="constrained")
    figures = whole.subfigures(2, 1, height_ratios=(TOP, 12)) if over else [whole]
    for axes, one in zip(np.atleast_1d(figures[0].subplots(1, len(over))) if over else [], over):
        _draw_over_tests(axes, one)
    all_axes = figures[-1].subplots(len(PANELS), 1, sharex=True)
    for axes, panel in zip(all_axes, PANELS):
        _shade_stages(axes, abscissa, stage, named=axes is all_axes[0])
        drawn = [(results.columns[c], legend) for c, legend in panel.channels.items() if c not in absent]
        columns = [column for column, _ in drawn]
        for (column, legend), style in zip(drawn, LINE_STYLES):
            axes.plot(abscissa, panel.scale * column, style, lw=1.0, alpha=0.85, label=legend)
        if summary.window and panel.quantity in errors:
            _mark_steady(axes, summary, panel, np.interp(summary.window, time, abscissa), errors[panel.quantity])
        axes.set_ylabel(f"{panel.title} [{panel.unit}]")
        _limit_to_cruise(axes, panel.scale, columns, stage)
        axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5), frameon=False)
        axes.margins(x=0)
    all_axes[-1].set_xlabel("time [s]" if against == "time" else "x of the axle [m]")
    line = "\n".join(textwrap.wrap(headline(results.folder, errors), 110))
    whole.suptitle(f"{results.title}\n{line}" if line else results.title, fontsize=10)
    save(whole, target)


def _over_tests(folder: Path) -> list[OverTests]:
    """Errors of a run over tests; empty for an incomplete run."""
    try:
        return over_tests(read_wheel_run(folder))
    except ResultsError:
        return []


def _draw_over_tests(axes: Axes, one: OverTests) -> None:
    """Measured against computed values of tests; the run with one (thick) and two standard errors where they agree."""
    for label, colour in TEST_COLOURS.items():
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


def _shade_stages(axes: Axes, abscissa: Floats, stage: Floats, named: bool) -> None:
    """Light bands for the rig's stages, with their names on top."""
    for number, colour in STAGE_COLOURS.items():
        rows = np.flatnonzero(stage == number)
        if len(rows) == 0:
            continue
        bands = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)  # one in each pass
        for band in bands:
            axes.axvspan(abscissa[band[0]], abscissa[band[-1]], color=colour, lw=0, zorder=0)
        begin, end = abscissa[bands[0][0]], abscissa[bands[0][-1]]
        if named and end - begin > NAMED_BAND * np.ptp(abscissa):
            look = {"transform": axes.get_xaxis_transform(), "ha": "center", "va": "bottom", "color": "0.4"}
            axes.text(0.5 * (begin + end), 1.03, number.name.lower(), **look)


def _mark_steady(axes: Axes, summary: Summary, panel: Panel, window: Floats, budget: Budget) -> None:
    """The mean over the steady window with its whole error and what is not in it; dashed where it was not steady."""
    value = summary.quantity(panel.quantity)
    if value is None:
        return
    mean, error = panel.scale * value.mean, panel.scale * budget.total
    states = ["imposed"] if value.imposed else [budget.missing_text(), "" if value.steady else "not steady"]
    state = textwrap.fill(", ".join(filter(None, states)) or "whole error", 30)
    axes.fill_between(window, mean - error, mean + error, color="C3", alpha=0.25, lw=0, zorder=3)
    label = f"mean {with_error(mean, error, short=True)}\n({state})"
    axes.plot(window, (mean, mean), color="C3", lw=1.6, ls="-" if value.steady else "--", zorder=4, label=label)


def _limit_to_cruise(axes: Axes, scale: float, columns: Sequence[Floats], stage: Floats) -> None:
    """Limits the axis where a short swing before the cruise (slip at the first motion) rules it."""
    cruise = np.concatenate([column[stage == Stage.CRUISE] for column in columns]) * scale
    if len(cruise) == 0:
        return
    low, high = min(cruise.min(), 0.0), max(cruise.max(), 0.0)
    room = 1.5 * (high - low)
    bottom, top = axes.get_ylim()
    if room > 0 and (bottom < low - room or top > high + room):
        axes.set_ylim(max(bottom, low - 0.4 * room), min(top, high + 0.4 * room))
        text = "swings before the cruise go beyond this axis"
        axes.text(0.005, 0.03, text, transform=axes.transAxes, fontsize=7, color="0.4")
