# SPDX-License-Identifier: GPL-2.0-or-later
"""Error against cost: changes of one choice, and the best estimate of all sizes of cells."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt

import cases
from one_run import Found, Row

from furrow_post.analyse.grid_convergence import Convergence, grid_convergence
from furrow_post.figures.style import save

Limits = dict[str, Convergence]  # of a quantity


def error_table(found: Found) -> tuple[list[Row], Limits]:
    """Each change of one choice beside the base; and what the sizes of cells come to."""
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
            sizes, values = [r["cell_m"] for r in grids], [r[what] for r in grids]
            limits[what] = grid_convergence(sizes, values)
    return table, limits


def grid_series(table: Sequence[Row]) -> list[Row]:
    """Rows that differ in the cells alone: the base, and other sizes."""
    sound = [r for r in table if not r["error"]]
    return [r for r in sound if r["cell_m"] != 0.04 or r is table[0]]


def draw_errors(table: Sequence[Row], limits: Limits, path: Path) -> None:
    """Distance from the best estimate over cost, one point per size of cell."""
    grids = sorted(grid_series(table), key=lambda r: -float(r["cell_m"]))
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for axes, what, label in (
        (panels[0], "sinkage_m", "sinkage"),
        (panels[1], "resistance", "resistance coefficient"),
    ):
        limit, uncertain = limits[what].value, limits[what].error
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
            title=f"{label}: {limit:.3f} ± {uncertain:.3f}, best estimate",
            ylim=(0, None),
        )
        axes.grid(alpha=0.3, which="both")
    save(figure, path, dpi=90)
