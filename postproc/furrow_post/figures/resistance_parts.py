# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of the resistance: stacked bars, one for each run, pass or point."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ..run.summary import ResistanceParts
from .style import label_panels, save, use_style

CAPTION = (
    "What the resistance is made of: energy over travel in the steady window, bar by bar; below "
    "zero what was given back. Mark: the whole that axle and load put in."
)
# Colours of the parts, in the order of the bars
COLOURS = {
    "compaction": "#8a6d4a",
    "bulldozing": "#c9a26b",
    "continuum, shared with others": "#a98758",
    "grains, below the track": "#8a7a4a",
    "grains, ahead and aside": "#c9b96b",
    "grains, walls of the bed": "#8fa37a",
    "grains, their motion": "#b5cfa5",
    "grains, pressed down": "#d8c48f",
    "grains, pushed along": "#efe3bf",
    "friction of wheel and ground": "#c8672b",
    "wheel or tyre": "#39424e",
    "damping of the rig": "#7a8794",
    "inertia of the wheel": "#4d8a4a",
    "inertia of the ground": "#9cc29a",
    "radiation": "#7a4b8c",
    "grid": "#1f5a8a",
    "contact springs and damping": "#6fa3cc",
    "not accounted for": "#d0021b",
}
RANKS = {name: k for k, name in enumerate(COLOURS)}
OTHER = "0.6"
VISIBLE = 5e-3  # of the largest bar: a part that is smaller everywhere has no entry in the legend
COLUMNS = 2  # of panels
PANEL_WIDTH, LEGEND_WIDTH = 4.0, 2.4  # [inch]
WIDTH = 0.7  # of a bar


@dataclass(frozen=True)
class Panel:
    """Bars side by side, each with its name below."""

    title: str
    bars: Sequence[tuple[str, ResistanceParts]]
    x_label: str = ""


def draw_parts(panels: Sequence[Panel], target: Path) -> None:
    """All panels on the same scale, with one legend."""
    use_style()
    columns = min(COLUMNS, len(panels))
    widths = [*[PANEL_WIDTH] * columns, LEGEND_WIDTH]
    rows = -(-len(panels) // columns)
    figure = plt.figure(figsize=(sum(widths), 3.4 * rows), layout="constrained")
    grid = figure.add_gridspec(rows, len(widths), width_ratios=widths)
    entries: dict[str, Artist] = {}
    visible = VISIBLE * max(abs(parts.whole) for panel in panels for _, parts in panel.bars)
    first: Axes | None = None
    for k, panel in enumerate(panels):
        axes = figure.add_subplot(grid[k // columns, k % columns], sharey=first)
        first = first or axes
        _draw_panel(axes, panel, visible)
        if k % columns == 0:
            axes.set_ylabel("energy over travel [N]")
        entries |= {name: bars for bars, name in zip(*axes.get_legend_handles_labels())}
    label_panels(figure.axes, *(panel.title for panel in panels))
    names = _ordered(entries)[::-1]  # in the order of the stack
    legend = figure.add_subplot(grid[:, columns])
    legend.set_axis_off()
    legend.legend([entries[name] for name in names], names, loc="center left", fontsize=8)
    save(figure, target)


def _ordered(names: Iterable[str]) -> list[str]:
    """Names of parts as bars are stacked; those that COLOURS does not list come last."""
    return sorted(names, key=lambda name: RANKS.get(name, len(RANKS)))


def _draw_panel(axes: Axes, panel: Panel, visible: float) -> None:
    """Parts that reach visible [N] in a bar have a label."""
    forces = pandas.DataFrame([{**parts.forces, "not accounted for": parts.unexplained} for _, parts in panel.bars])
    place = np.arange(len(forces))
    above, below = np.zeros(len(forces)), np.zeros(len(forces))
    for name in _ordered(forces):
        known, force = forces[name].notna(), forces[name].fillna(0.0).to_numpy()
        label = name if (np.abs(force) >= visible).any() else None
        start = np.where(force > 0, above, below)
        axes.bar(place[known], force[known], WIDTH, start[known], color=COLOURS.get(name, OTHER), label=label)
        above, below = above + force.clip(min=0), below + force.clip(max=0)
    for k, (_, parts) in enumerate(panel.bars):
        axes.plot([k - 0.5 * WIDTH, k + 0.5 * WIDTH], [parts.whole] * 2, color="black", lw=1.4)
    axes.axhline(0, color="0.5", lw=0.6)
    axes.set_xticks(place, [name for name, _ in panel.bars])
    axes.set_xlim(-0.6, max(len(forces), 2) - 0.4)
    axes.set_xlabel(panel.x_label)
