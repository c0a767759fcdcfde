# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against cost: changes of one choice, and the limit of size zero."""

import math
from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import cases
from one_run import Found, Row

from furrow_post.arrays import Floats
from furrow_post.figures.style import save

Limits = dict[str, tuple[float, float]]  # quantity -> value at size zero, its uncertainty


def extrapolated(sizes: Sequence[float], values: Floats) -> tuple[float, float]:
    """Value at size zero, mean of the straight lines in h and in h^2, and its uncertainty.

    Half their difference plus the scatter about both.
    """
    guesses, scatter = [], 0.0
    for order in (1, 2):
        powers = np.array(sizes) ** order
        fit = np.polyfit(powers, values, 1)
        guesses.append(float(fit[1]))
        left = values - np.polyval(fit, powers)
        scatter = max(scatter, math.sqrt((left**2).sum() / max(len(sizes) - 2, 1)))
    return float(np.mean(guesses)), 0.5 * abs(guesses[1] - guesses[0]) + scatter


def error_table(found: Found) -> tuple[list[Row], Limits]:
    """Each change of one choice beside the base; and size zero."""
    base = found(cases.ERROR_BASE)
    if not base or base["error"]:
        return [], {}
    lines = [("base: cells of 4 cm, tyre of 4 x 36 elements", cases.ERROR_BASE)]
    lines += [(case.what, case.name) for case in cases.errors()]
    table = []
    for what, name in lines:
        if computed := found(name):
            cell = float(str(found.cases[name].variables["cell"]))
            table.append({"change": what, "cell_m": round(cell, 4), **computed})
    grids = grid_series(table)
    limits = {}
    if len(grids) >= 3:
        for what in ("sinkage_m", "resistance"):
            sizes, values = [r["cell_m"] for r in grids], np.array([r[what] for r in grids])
            limits[what] = extrapolated(sizes, values)
    return table, limits


def grid_series(table: Sequence[Row]) -> list[Row]:
    """Rows that differ in the cells alone: the base, and other sizes."""
    sound = [r for r in table if not r["error"]]
    return [r for r in sound if r["cell_m"] != 0.04 or r is table[0]]


def draw_errors(table: Sequence[Row], limits: Limits, path: Path) -> None:
    """Distance from size zero over cost, one point per size of cell."""
    grids = sorted(grid_series(table), key=lambda r: -float(r["cell_m"]))
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for axes, what, label in (
        (panels[0], "sinkage_m", "sinkage"),
        (panels[1], "resistance", "resistance coefficient"),
    ):
        limit, uncertain = limits[what]
        places = [(r["user_s"], abs(r[what] - limit) / limit) for r in grids]
        cost, error = zip(*places)
        axes.errorbar(cost, error, uncertain / limit, fmt="o-", capsize=3)
        for r, place in zip(grids, places):
            text = f"{100 * r['cell_m']:.3g} cm"
            axes.annotate(text, place, textcoords="offset points", xytext=(6, 6))
        axes.set(
            xscale="log",
            xlabel="cost [core seconds]",
            ylabel=f"error of {label}, relative",
            title=f"{label}: {limit:.3f} ± {uncertain:.3f} at size zero",
            ylim=(0, None),
        )
        axes.grid(alpha=0.3, which="both")
    save(figure, path, dpi=90)
