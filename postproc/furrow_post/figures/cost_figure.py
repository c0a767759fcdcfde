# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of errors against cost."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

from ..uncertainty import cost_table
from ..uncertainty.cost_table import FamilyKey, Row
from ..uncertainty.verdict import BARS, COVERAGE, QUANTITIES, Quantity
from .style import MILLIMETRE, RUN_COLOURS, label_panels, save, use_style


def draw_cost(rows: Sequence[Row], target: Path) -> None:
    """Numerical errors against cost, and both quantities over the size."""
    use_style()
    families = sorted({row.family for row in rows})
    colours = {key: RUN_COLOURS[k % len(RUN_COLOURS)] for k, key in enumerate(families)}
    figure, panels = plt.subplots(1, 3, figsize=(12, 4), layout="constrained")
    _draw_errors(panels[0], rows, colours)
    for axes, quantity in zip(panels[1:], QUANTITIES):
        _draw_convergence(axes, rows, quantity, colours)
    label_panels(panels, "error against cost", *(f"{quantity.name} over the size" for quantity in QUANTITIES))
    panels[1].legend(fontsize=8)
    save(figure, target)


def _draw_errors(axes: Axes, rows: Sequence[Row], colours: Mapping[FamilyKey, str]) -> None:
    axes.set(xlabel="CPU time of one core [s]", ylabel="numerical error [%], worst of both")
    known = []
    for row, errors in cost_table.numerical_errors(rows):
        error = max(budget.total / abs(row.value(key)[0]) if row.value(key)[0] else np.nan for key, budget in errors.items())
        if all(np.isfinite(budget.size) for budget in errors.values()) and np.isfinite(error):
            known.append((row, 100 * error))
    if not known:
        axes.text(0.5, 0.5, "no error is known", transform=axes.transAxes, ha="center")
        return
    for row, percent in known:
        axes.plot(row.cpu_time, percent, "o", ms=7, color=colours[row.family])
        size = f"{MILLIMETRE * row.size:.3g} mm"
        axes.annotate(size, (row.cpu_time, percent), (6, 4), textcoords="offset points", fontsize=8, color="0.3")
    axes.set(xscale="log", yscale="log")
    axes.margins(0.15)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter(NullFormatter())


def _draw_convergence(axes: Axes, rows: Sequence[Row], quantity: Quantity, colours: Mapping[FamilyKey, str]) -> None:
    """Values against size, with the curve to zero size where there is one, family by family."""
    scale = quantity.scale
    for key, family in cost_table.families(rows).items():
        sizes = np.array([row.size for row in family.bases])
        pairs = [row.value(quantity.key) for row in family.bases]
        values, errors = (scale * np.array(column) for column in zip(*pairs))
        marks = {"color": colours[key], "capsize": 3}
        axes.errorbar(MILLIMETRE * sizes, values, yerr=COVERAGE * errors, fmt="o", label=", ".join(key), **marks)
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
