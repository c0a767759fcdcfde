# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of furrow-post compare."""

import textwrap

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import Normalize

from . import compare, density
from .style import CENTIMETRE, annotate_panel, save, use_style
from .summary import with_error

COLOURS = ("#1f5a8a", "#c8672b", "#4d8a4a", "#7a4b8c", "#8a6d1f", "#3f3f3f")
KIND_COLOURS = {"formula": "#777777", "measured": "black"}


def _values(axes, result, quantity, colours):
    name, unit, scale = compare.QUANTITIES[quantity]
    entries = result.of(quantity)
    for row, e in enumerate(entries):
        colour = colours.get(e.source, KIND_COLOURS.get(e.kind, "0.4"))
        known = np.isfinite(e.uncertainty)
        axes.errorbar(scale * e.value, row, xerr=scale * compare.COVERAGE * e.uncertainty if known else None, ms=6, color=colour, capsize=4,
                      lw=1.6, fmt="s" if e.kind == "measured" else "o", mfc="white" if e.kind == "formula" else colour)
        label = with_error(scale * e.value, scale * e.uncertainty) if known else f"{scale * e.value:.3g}"
        axes.annotate(label, (scale * e.value, row), (0, 8), textcoords="offset points", ha="center", fontsize=8, color="0.25")
    axes.set_yticks(range(len(entries)), [textwrap.fill(e.source, 16) for e in entries])
    axes.set_ylim(len(entries) - 0.5, -0.7)
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, 0) if low < 0.35 * high else low - 0.08 * (high - low), high + 0.08 * (high - low))
    axes.set_xlabel(f"{name}{f' [{unit}]' if unit else ''}, bars: {compare.COVERAGE:g} standard deviations")
    axes.grid(axis="x", color="0.9", lw=0.6)
    axes.set_axisbelow(True)


def _wheel_circle(axes, run):
    """Outline of the wheel in the lengthwise section."""
    z = run.radius - run.results.columns["sinkage"][-1]
    axes.add_patch(plt.Circle((0, CENTIMETRE * z), CENTIMETRE * run.radius, fill=False, ec="#39424e", lw=1.4))


def draw(result, target):
    use_style()
    runs = result.runs
    grounds = [run for run in runs if run.ground != "none"]
    colours = {run.label: COLOURS[k % len(COLOURS)] for k, run in enumerate(runs)}
    cuts = {run.label: density.sections(run) for run in grounds}

    many = max(len(result.of("sinkage")) - 4, 0)  # entries that need more room than the first panels have
    tall = 5.9 + 1.75 * len(grounds) + 0.4 * many
    figure = plt.figure(figsize=(11, tall), layout="constrained")
    figure.get_layout_engine().set(hspace=0.04)
    grid = figure.add_gridspec(2 + len(grounds), 6, height_ratios=[2.4 + 0.4 * many, 2.4] + [1.75] * len(grounds))
    for k, quantity in enumerate(compare.QUANTITIES):
        axes = figure.add_subplot(grid[0, 3 * k:3 * k + 3])
        _values(axes, result, quantity, colours)
        annotate_panel(axes, "ab"[k], compare.QUANTITIES[quantity][0])

    sink, resist, settle = (figure.add_subplot(grid[1, 2 * k:2 * k + 2]) for k in range(3))
    for run in runs:
        distance, z, c = compare.histories(run)
        sink.plot(distance, CENTIMETRE * z, color=colours[run.label], lw=1.2, label=run.label)
        resist.plot(distance, c, color=colours[run.label], lw=1.2)
        z, p = compare.settling(run)
        settle.plot(CENTIMETRE * z, 1e-3 * p, color=colours[run.label], lw=1.2)
    sink.set(xlabel="travel in cruise [m]", ylabel="sinkage [cm]")
    resist.set(xlabel="travel in cruise [m]", ylabel="resistance coefficient")
    steady = [e.value for e in result.of("coefficient", "run")]
    resist.set_ylim(min(0, 1.5 * min(steady)), max(2.2 * max(steady), 0.05))
    sink.set_ylim(0, None)
    settle.set(xlabel="sinkage [cm]", ylabel="mean pressure [kPa]", ylim=(0, None), xlim=(0, None))
    sink.legend(fontsize=8)
    titles = ((sink, "c", "sinkage"), (resist, "d", "resistance, smoothed"), (settle, "e", "pressure while it is let down"))
    for axes, letter, title in titles:
        annotate_panel(axes, letter, title)

    if grounds:
        low = min(run.conditions["density"].value if "density" in run.conditions else 0.0 for run in grounds)
        high = max(np.nanpercentile(cut.density, 98) for pair in cuts.values() for cut in pair)
        norm = Normalize(0.85 * low, high)
        images = []
        panels = []
        for row, run in enumerate(grounds):
            for column, (cut, what) in enumerate(zip(cuts[run.label], ("along the middle plane", "across the track behind"))):
                axes = figure.add_subplot(grid[2 + row, 0:4] if column == 0 else grid[2 + row, 4:6])
                image = axes.imshow(cut.density, origin="lower", extent=[CENTIMETRE * e for e in cut.extent], cmap="YlGnBu", norm=norm,
                                    interpolation="nearest")
                axes.axhline(0, color="0.3", lw=0.8, ls=(0, (6, 4)))
                if column == 0:
                    _wheel_circle(axes, run)
                    axes.set_ylabel("z [cm]")
                axes.set_ylim(CENTIMETRE * cut.z_edges[0], CENTIMETRE * cut.z_edges[-1])
                if row == len(grounds) - 1:
                    axes.set_xlabel("xy"[column] + " from the axle [cm]" if column == 0 else "y [cm]")
                annotate_panel(axes, "fghijklm"[2 * row + column], f"{run.label}, {what}" if column == 0 else what)
                images.append(image)
                panels.append(axes)
        bar = figure.colorbar(images[0], ax=panels, extend="max", fraction=0.025, pad=0.01, aspect=25)
        bar.set_label("density [kg/m³]")
    title = compare.overall(result) or ", ".join(run.label for run in runs)
    figure.suptitle("\n".join(textwrap.wrap(title, 110)), fontsize=11, fontweight="bold")
    save(figure, target)
