# SPDX-License-Identifier: GPL-2.0-or-later
"""Parts of the resistance: stacked bars, one for each run, pass or point."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from ..run.summary import ResistanceParts
from .style import annotate_panel, panel_letters, save, use_style

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
    largest = max(abs(parts.whole) for panel in panels for _, parts in panel.bars)
    first: Axes | None = None
    for k, (panel, letter) in enumerate(zip(panels, panel_letters())):
        axes = figure.add_subplot(grid[k // columns, k % columns], sharey=first)
        first = first or axes
        _draw_panel(axes, panel, VISIBLE * largest, entries)
        annotate_panel(axes, letter, panel.title)
        if k % columns == 0:
            axes.set_ylabel("energy over travel [N]")
    ordered = [name for name in (*COLOURS, *entries) if name in entries]
    names = list(dict.fromkeys(ordered))[::-1]  # as they are stacked
    handles = [entries[name] for name in names]
    legend = figure.add_subplot(grid[:, columns])
    legend.set_axis_off()
    legend.legend(handles, names, loc="center left", fontsize=8)
    save(figure, target)


def _draw_panel(axes: Axes, panel: Panel, visible: float, entries: dict[str, Artist]) -> None:
    """entries: name -> artist, of all parts that can be seen in a panel"""
    for k, (_, parts) in enumerate(panel.bars):
        above = below = 0.0
        forces = {**parts.forces, "not accounted for": parts.unexplained}
        for name in dict.fromkeys([*(n for n in COLOURS if n in forces), *forces]):
            force = forces[name]
            start = above if force > 0 else below
            (bar,) = axes.bar(k, force, WIDTH, start, color=COLOURS.get(name, OTHER))
            above, below = above + max(force, 0.0), below + min(force, 0.0)
            if abs(force) >= visible:
                entries.setdefault(name, bar)
        axes.plot([k - 0.5 * WIDTH, k + 0.5 * WIDTH], [parts.whole] * 2, color="black", lw=1.4)
    axes.axhline(0, color="0.5", lw=0.6)
    axes.set_xticks(range(len(panel.bars)), [name for name, _ in panel.bars])
    axes.set_xlim(-0.6, max(len(panel.bars), 2) - 0.4)
    axes.set_xlabel(panel.x_label)
