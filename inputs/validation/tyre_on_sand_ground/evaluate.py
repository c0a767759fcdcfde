# SPDX-License-Identifier: GPL-2.0-or-later
"""Figure of the vertical and the Mises stress in the middle plane, a row per run."""

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.figures.style import save
from furrow_post.study.runs import Runs
from furrow_post.tables.ground_measures import TyreGround


def draw_stress(runs: Runs, tables: Any, target: Path, names: list[str]) -> None:
    shown = runs.done(*names)
    figure, panels = plt.subplots(len(shown), 2, figsize=(10, 2.5 * len(shown)), constrained_layout=True, squeeze=False)
    for line, run in zip(panels, shown):
        ground = TyreGround(run.folder)
        slab = (ground.y < np.unique(np.round(ground.y, 6))[1] + 1e-4) & (np.abs(ground.x) < 0.32) & (ground.depth < 0.25)
        for axes, field, label, levels in (
            (line[0], ground.stress, "vertical stress", np.arange(0, 301, 25)),
            (line[1], ground.mises, "Mises stress q", np.arange(0, 401, 40)),
        ):
            shading = axes.tricontourf(ground.x[slab], -ground.depth[slab], field[slab] / 1e3, levels=levels, extend="both")
            axes.axvline(0, color="w", lw=0.8, ls="--")
            axes.set(aspect="equal", title=f"{run.what}: {label}", ylabel="z [m]")
            figure.colorbar(shading, ax=axes, label="kPa", shrink=0.9)
            axes.set_xlabel("x from the axle [m], travel to the right" if run is shown[-1] else "")
    save(figure, target, dpi=80)
