# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of errors against cost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

from ..analyse import cost_table
from ..analyse.cost import Assessed
from ..analyse.cost_table import FamilyKey
from ..analyse.verdict import BARS, COVERAGE, QUANTITIES, Quantity
from .style import MILLIMETRE, RUN_COLOURS, annotate_panel, save, use_style


def draw_cost(assessed: Sequence[Assessed], error: float, target: Path) -> None:
    """Errors against cost with the wanted relative error, and both quantities over the size."""
    use_style()
    families = sorted({a.row.family for a in assessed})
    colours = {key: RUN_COLOURS[k % len(RUN_COLOURS)] for k, key in enumerate(families)}
    figure, panels = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    _draw_errors(panels[0], assessed, error, colours)
    annotate_panel(panels[0], "a", "error against cost")
    for axes, quantity, letter in zip(panels[1:], QUANTITIES, "bc"):
        _draw_convergence(axes, assessed, quantity, colours)
        annotate_panel(axes, letter, f"{quantity.name} over the size")
    panels[1].legend(fontsize=8)
    save(figure, target)


@dataclass(frozen=True)
class Answer:
    """What one run of a ground model gives for a quantity."""

    model: str
    label: str  # next to its mark
    cpu_time: float  # [s]
    value: float
    error: float  # numerical standard error; NaN: not estimated


def draw_models(
    answers: Sequence[Answer], reference: tuple[float, float], quantity: str, target: Path
) -> None:
    """Differences of models from a reference value with its standard error, against cost."""
    use_style()
    value, error = reference
    figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
    axes.axhspan(-100 * error / value, 100 * error / value, color="0.92", label="error of the reference")
    axes.axhline(0.0, color="0.6", lw=0.8)
    for k, model in enumerate(dict.fromkeys(a.model for a in answers)):
        own = [a for a in answers if a.model == model]
        costs = [a.cpu_time for a in own]
        differences = [100 * (a.value / value - 1.0) for a in own]
        known = np.isfinite([a.error for a in own]).any()
        bars = [100 * a.error / value for a in own] if known else None
        axes.errorbar(
            costs,
            differences,
            yerr=bars,
            fmt="o",
            capsize=3,
            elinewidth=1,
            color=RUN_COLOURS[k],
            label=model,
        )
        offset = (6, 4 - 8 * (k % 3))
        for a, cost, difference in zip(own, costs, differences):
            axes.annotate(a.label, (cost, difference), offset, textcoords="offset points", fontsize=8)
    axes.set(xscale="log", xlabel="CPU time of one core [s]", ylabel=f"{quantity}: difference [%]")
    axes.margins(0.1)
    axes.legend(fontsize=8)
    save(figure, target)


def _draw_errors(
    axes: Axes, assessed: Sequence[Assessed], error: float, colours: Mapping[FamilyKey, str]
) -> None:
    axes.set(xlabel="CPU time of one core [s]", ylabel="numerical error [%], worst of both")
    known = [a for a in assessed if np.isfinite(a.error)]
    if not known:
        axes.text(0.5, 0.5, "no error is known", transform=axes.transAxes, ha="center")
        return
    for a in known:
        place, colour = (a.row.cpu_time, 100 * a.error), colours[a.row.family]
        axes.plot(*place, "o", ms=7, color=colour, mfc=colour if a.pareto else "white")
        size = f"{MILLIMETRE * a.row.size:.3g} mm"
        axes.annotate(size, place, (6, 4), textcoords="offset points", fontsize=8, color="0.3")
    front = sorted((a for a in assessed if a.pareto), key=lambda a: a.row.cpu_time)
    times, errors = [a.row.cpu_time for a in front], [100 * a.error for a in front]
    axes.plot(times, errors, color="0.6", lw=1, zorder=0, drawstyle="steps-post")
    axes.axhline(100 * error, color="0.4", lw=0.8, ls=(0, (6, 4)))
    axes.set(xscale="log", yscale="log")
    axes.margins(0.15)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(NullFormatter())
    legend = "filled: nothing is cheaper and better; dashed: wanted"
    axes.text(0.03, 0.03, legend, transform=axes.transAxes, fontsize=7, color="0.4")


def _draw_convergence(
    axes: Axes, assessed: Sequence[Assessed], quantity: Quantity, colours: Mapping[FamilyKey, str]
) -> None:
    """Values against size, with the curve to zero size where there is one, family by family."""
    scale = quantity.scale
    for key, family in cost_table.families([a.row for a in assessed]).items():
        sizes = np.array([row.size for row in family.bases])
        rows = [row.value(quantity.key) for row in family.bases]
        values, errors = (scale * np.array(column) for column in zip(*rows))
        marks = {"color": colours[key], "capsize": 3}
        axes.errorbar(
            MILLIMETRE * sizes,
            values,
            yerr=COVERAGE * errors,
            fmt="o",
            label=", ".join(key),
            **marks,
        )
        series = family.convergence(quantity.key)
        if series:
            shown = 0.0 if series.extrapolated else series.sizes[0]
            curve = np.linspace(shown, sizes.max(), 50)
            values_on_it = scale * np.array([series.at(size) for size in curve])
            axes.plot(MILLIMETRE * curve, values_on_it, color=colours[key], lw=1, ls="--")
            error = COVERAGE * scale * series.error
            place = MILLIMETRE * shown, scale * series.value
            axes.errorbar(*place, yerr=error, fmt="D", mfc="white", **marks)
    axes.set(xlabel="size of cells or grains [mm]", ylabel=f"{quantity.label}, {BARS}")
