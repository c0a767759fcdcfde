# SPDX-License-Identifier: GPL-2.0-or-later
"""The picture of a sweep: its curves with error bars, formulas and measurements beside them."""

import math
from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ..uncertainty.verdict import BARS, COVERAGE
from ..figures.resistance_parts import Panel, draw_parts
from ..figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from .cone_band import ConeBand
from .sweep_curves import Curve, Figure, Line
from .sweep_formulas import FormulaLine
from .sweep_measured import MeasuredPoints

LEGEND = f"{BARS} (thick: time average alone; thin: all known parts); open: not steady"
CAPTION = f"{LEGEND[0].upper()}{LEGEND[1:]}. Dotted and shaded, where shown: mean and band of the formulas for the cone index."
MARKERS = "osD^vP"
DASHES = ((6, 2), (2, 2), (6, 2, 1, 2), (1, 2))
MEASURED_MARKERS = "sD^v"
COLUMNS = 2  # of panels


def draw_sweep(
    figure: Figure,
    formulas: Sequence[FormulaLine],
    measured: Sequence[MeasuredPoints],
    target: Path,
    bands: Sequence[ConeBand] = (),
) -> None:
    use_style()
    rows = math.ceil(len(figure.curves) / COLUMNS)
    whole = plt.figure(figsize=(10, 3.4 * rows + 0.6), layout="constrained")
    grid = whole.add_gridspec(rows + 1, COLUMNS, height_ratios=[*[3.4] * rows, 0.4])
    entries: dict[str, Artist] = {}
    for k, (curve, letter) in enumerate(zip(figure.curves, panel_letters())):
        axes = whole.add_subplot(grid[k // COLUMNS, k % COLUMNS])
        _draw_curve(axes, figure, curve, formulas, measured, bands)
        annotate_panel(axes, letter, curve.name)
        handles, labels = axes.get_legend_handles_labels()
        entries.update(zip(labels, handles))
    legend = whole.add_subplot(grid[rows, :])
    legend.set_axis_off()
    legend.legend(
        list(entries.values()),
        list(entries),
        loc="center",
        ncols=4,
        fontsize=8,
        title=LEGEND,
        title_fontsize=8,
    )
    save(whole, target)


def draw_parts_of_sweep(figure: Figure, target: Path) -> bool:
    """Draws the parts of the resistance, a panel for each line. @return True where any point knows them"""
    panels = []
    for line in figure.lines:
        points = [
            (_place(figure, x), parts)
            for x, parts in zip(line.x, (point.parts for point in line.points))
            if parts is not None
        ]
        if points:
            panels.append(Panel(line.label, points, figure.x.label))
    if panels:
        draw_parts(panels, target)
    return bool(panels)


def _place(figure: Figure, x: float) -> str:
    return figure.categories[int(x)] if figure.categories else f"{figure.x.scale * x:.3g}"


def _draw_curve(
    axes: Axes,
    figure: Figure,
    curve: Curve,
    formulas: Sequence[FormulaLine],
    measured: Sequence[MeasuredPoints],
    bands: Sequence[ConeBand],
) -> None:
    for k, line in enumerate(figure.lines):
        _draw_line(axes, figure, curve, line, _colour(k), MARKERS[k % len(MARKERS)])
    shown = [axes.get_ylim()] if figure.lines else []
    x_scale, y_scale = figure.x.scale, curve.y.scale
    for test, marker in zip(measured, MEASURED_MARKERS * len(measured)):
        points = test.values(curve.y)
        if points:
            x, y, error = (np.array(column) for column in zip(*points))
            bars = COVERAGE * y_scale * np.nan_to_num(error)
            look = {"color": "black", "fmt": marker, "ms": 5, "capsize": 2, "lw": 1}
            axes.errorbar(x_scale * x, y_scale * y, bars, label=test.label, **look)
            shown.append(axes.get_ylim())
    colours = {line.label: _colour(k) for k, line in enumerate(figure.lines)}
    methods = list(dict.fromkeys(one.formula for one in formulas))
    for one in formulas:
        values = one.values(curve.y)
        if values:
            x, y = (np.array(column) for column in zip(*values))
            dashes = DASHES[methods.index(one.formula) % len(DASHES)]
            look = {"color": colours.get(one.line, "0.45"), "lw": 1.1, "dashes": dashes}
            axes.plot(x_scale * x, y_scale * y, label=one.label, **look)
    for band in bands:
        bounds = band.values(curve.y)
        if bounds:
            x, mean, least, greatest = (np.array(column) for column in zip(*bounds))
            colour = colours[band.line.label]
            axes.fill_between(x_scale * x, y_scale * least, y_scale * greatest, color=colour, alpha=0.12, lw=0)
            axes.plot(x_scale * x, y_scale * mean, color=colour, lw=1.1, ls=":", marker="_", label=band.label)
    if shown:  # a formula may lie far away: the runs keep their room
        low, high = min(low for low, _ in shown), max(high for _, high in shown)
        now = axes.get_ylim()
        room = high - low
        axes.set_ylim(max(now[0], low - room), min(now[1], high + room))
    axes.axhline(0, color="0.7", lw=0.6, zorder=0)
    axes.set(xlabel=figure.x.label, ylabel=curve.y.label)
    if figure.categories:
        axes.set_xticks(range(len(figure.categories)), figure.categories)


def _colour(line: int) -> str:
    return RUN_COLOURS[line % len(RUN_COLOURS)]


def _draw_line(
    axes: Axes, figure: Figure, curve: Curve, line: Line, colour: str, marker: str
) -> None:
    values = line.values(curve.y)
    if not values:
        return
    scale = curve.y.scale
    x = [figure.x.scale * place for place, _, _ in values]
    y = [scale * value.mean for _, _, value in values]
    whole = [COVERAGE * scale * np.nan_to_num(value.uncertainty) for _, _, value in values]
    time = [COVERAGE * scale * np.nan_to_num(value.parts.time) for _, _, value in values]
    joined = {"lw": 0 if figure.categories else 0.9, "color": colour}
    axes.plot(x, y, **joined, zorder=1)
    axes.errorbar(x, y, time, fmt="none", ecolor=colour, elinewidth=2.6, alpha=0.45)
    axes.errorbar(x, y, whole, fmt="none", ecolor=colour, elinewidth=1, capsize=3)
    for steady in (True, False):
        chosen = [k for k, (_, _, value) in enumerate(values) if value.steady is steady]
        fill = colour if steady else "white"
        look = {"ls": "", "marker": marker, "ms": 5, "color": colour, "mfc": fill}
        axes.plot([x[k] for k in chosen], [y[k] for k in chosen], **look)
    axes.plot([], [], color=colour, marker=marker, lw=0.9, label=line.label)
