# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of a comparison of wheel runs."""

import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.image import AxesImage

from ..analyse.comparison import Comparison
from ..analyse.density import Section, sections
from ..uncertainty.verdict import BARS, BEST, COEFFICIENT, COVERAGE, FORMULA, HUB_DROP, MEASURED, QUANTITIES, RUN, Quantity
from ..analyse.wheel_histories import cruise_history, settling_curve
from ..read.wheel_run import WheelRun
from .style import (CENTIMETRE, KILOPASCAL, RUN_COLOURS, WHEEL_COLOUR, label_panels, save, use_style)

KIND_COLOURS = {FORMULA: "#777777", MEASURED: "black"}
SECTION_HEIGHT = 1.75  # of a row of density sections [inch]


def draw_comparison(result: Comparison, target: Path) -> None:
    """Values with their uncertainties, histories, settling curves, and density sections."""
    use_style()
    grounds = [run for run in result.runs if run.ground_kind.has_density]
    colours = {run.label: RUN_COLOURS[k % len(RUN_COLOURS)] for k, run in enumerate(result.runs)}
    many = max(len(result.of(HUB_DROP)) - 4, 0)  # entries that need more room
    tall = 5.9 + SECTION_HEIGHT * len(grounds) + 0.4 * many
    figure = plt.figure(figsize=(11, tall), layout="constrained")
    figure.get_layout_engine().set(hspace=0.04)
    heights = [2.4 + 0.4 * many, 2.4] + [SECTION_HEIGHT] * len(grounds)
    grid = figure.add_gridspec(2 + len(grounds), 6, height_ratios=heights)
    for k, quantity in enumerate(QUANTITIES):
        _draw_values(figure.add_subplot(grid[0, 3 * k : 3 * k + 3]), result, quantity, colours)
    _draw_histories([figure.add_subplot(grid[1, 2 * k : 2 * k + 2]) for k in range(3)], result, colours)
    titles = [quantity.name for quantity in QUANTITIES]
    titles += ["hub drop", "resistance, smoothed", "pressure while it is lowered"]
    if grounds:
        _draw_sections(figure, grid, grounds)
    for run in grounds:
        titles += [f"{run.label}, along the middle plane", "across the track behind"]
    label_panels(figure.axes, *titles)
    title = result.overall() or ", ".join(run.label for run in result.runs)
    figure.suptitle("\n".join(textwrap.wrap(title, 110)), fontsize=11, fontweight="bold")
    save(figure, target)


def _draw_values(axes: Axes, result: Comparison, quantity: Quantity, colours: Mapping[str, str]) -> None:
    entries, scale = result.of(quantity), quantity.scale
    for row, e in enumerate(entries):
        colour = colours.get(e.source, KIND_COLOURS.get(e.kind, "0.4"))
        known = np.isfinite(e.uncertainty)
        axes.errorbar(
            scale * e.value,
            row,
            xerr=scale * COVERAGE * e.uncertainty if known else None,
            ms=6,
            color=colour,
            capsize=4,
            lw=1.6,
            fmt="s" if e.kind == MEASURED else "o",
            mfc="white" if e.kind in (FORMULA, BEST) else colour,
        )
        look = {"textcoords": "offset points", "ha": "center", "fontsize": 8, "color": "0.25"}
        axes.annotate(e.text(), (scale * e.value, row), (0, 8), **look)
    axes.set_yticks(range(len(entries)), [textwrap.fill(e.label, 16) for e in entries])
    axes.set_ylim(len(entries) - 0.5, -0.7)
    low, high = axes.get_xlim()
    margin = 0.08 * (high - low)
    axes.set_xlim(min(low, 0) if low < 0.35 * high else low - margin, high + margin)
    axes.set_xlabel(f"{quantity.label}, {BARS}")
    axes.grid(axis="x", color="0.9", lw=0.6)
    axes.set_axisbelow(True)


def _draw_histories(panels: Sequence[Axes], result: Comparison, colours: Mapping[str, str]) -> None:
    sink, resist, settle = panels
    for run in result.runs:
        look = {"color": colours[run.label], "lw": 1.2}
        history, settling = cruise_history(run), settling_curve(run)
        sink.plot(history.distance, CENTIMETRE * history.hub_drop, label=run.label, **look)
        resist.plot(history.distance, history.coefficient, **look)
        settle.plot(CENTIMETRE * settling.hub_drop, KILOPASCAL * settling.pressure, **look)
    sink.set(xlabel="travel in cruise [m]", ylabel="hub drop [cm]")
    resist.set(xlabel="travel in cruise [m]", ylabel="resistance coefficient")
    steady = [e.value for e in result.of(COEFFICIENT, RUN)]
    resist.set_ylim(min(0, 1.5 * min(steady)), max(2.2 * max(steady), 0.05))
    sink.set_ylim(0, None)
    settle.set(xlabel="hub drop [cm]", ylabel="mean pressure [kPa]", ylim=(0, None), xlim=(0, None))
    sink.legend(fontsize=8)


def _draw_sections(figure: Figure, grid: GridSpec, grounds: Sequence[WheelRun]) -> None:
    """Density along and across the track, one row per run, one scale."""
    cuts = {run.label: sections(run) for run in grounds}
    low = min(run.number("density") if "density" in run.conditions else 0.0 for run in grounds)
    high = max(np.nanpercentile(cut.density, 98) for pair in cuts.values() for cut in pair)
    norm = Normalize(0.85 * low, high)
    panels, images = [], []
    for row, run in enumerate(grounds):
        lengthwise = figure.add_subplot(grid[2 + row, 0:4])
        across = figure.add_subplot(grid[2 + row, 4:6])
        for axes, cut in zip((lengthwise, across), cuts[run.label]):
            images.append(_draw_density(axes, cut, norm))
        centre = (0, CENTIMETRE * (run.radius - run.results.columns["hub_drop"][-1]))
        lengthwise.add_patch(plt.Circle(centre, CENTIMETRE * run.radius, fill=False, ec=WHEEL_COLOUR, lw=1.4))
        lengthwise.set_ylabel("z [cm]")
        if row == len(grounds) - 1:
            lengthwise.set_xlabel("x from the axle [cm]")
            across.set_xlabel("y [cm]")
        panels += [lengthwise, across]
    bar = figure.colorbar(images[0], ax=panels, extend="max", fraction=0.025, pad=0.01, aspect=25)
    bar.set_label("density [kg/m³]")


def _draw_density(axes: Axes, cut: Section, norm: Normalize) -> AxesImage:
    """Returns the image, for a scale."""
    image = axes.imshow(
        cut.density,
        origin="lower",
        extent=[CENTIMETRE * edge for edge in cut.extent],
        cmap="YlGnBu",
        norm=norm,
        interpolation="nearest",
    )
    axes.axhline(0, color="0.3", lw=0.8, ls=(0, (6, 4)))
    axes.set_ylim(CENTIMETRE * cut.z_edges[0], CENTIMETRE * cut.z_edges[-1])
    return image
