# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of a surrogate, predictions of held-out runs against the runs, and of a posterior: each
parameter alone and in pairs, over the range of the prior."""

from collections.abc import Mapping
from pathlib import Path

import matplotlib.pyplot as plt

from ..arrays import Floats
from ..figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from ..formatting import in_unit
from .gaussian_process import Z_95, HeldOut
from .model import Surrogate
from .posterior import Posterior

DOTS = 1500  # of a panel


def draw_held_out(
    runs: Mapping[str, Floats], held_out: Mapping[str, HeldOut], target: Path
) -> None:
    """Draws predictions over held-out runs; bars show the 95 % band."""
    use_style()
    figure, panels = plt.subplots(2, 2, figsize=(9, 8), layout="constrained")
    for axes, letter, (name, held) in zip(panels.flat, panel_letters(), held_out.items()):
        y = runs[name]
        inside = abs(y - held.predicted) <= Z_95 * held.deviation
        for some, colour in ((inside, RUN_COLOURS[0]), (~inside, RUN_COLOURS[1])):
            axes.errorbar(
                y[some],
                held.predicted[some],
                Z_95 * held.deviation[some],
                fmt="o",
                ms=3,
                lw=0.7,
                color=colour,
                alpha=0.8,
            )
        axes.plot([y.min(), y.max()], [y.min(), y.max()], color="0.4", lw=0.8)
        annotate_panel(
            axes, letter, f"{name.replace('_', ' ')}: {100 * held.coverage:.1f} % inside"
        )
        axes.set_xlabel("run")
        axes.set_ylabel("predicted without it, bars: 95 % band")
    save(figure, target)


def draw_posterior(posterior: Posterior, surrogate: Surrogate, target: Path) -> None:
    use_style()
    count = len(posterior.names)
    inputs = [surrogate.inputs[surrogate.names.index(name)] for name in posterior.names]
    figure, panels = plt.subplots(
        count, count, figsize=(2.6 * count + 1,) * 2, squeeze=False, layout="constrained"
    )
    dots = posterior.samples[:: max(1, len(posterior.samples) // DOTS)]
    for i, of_row in enumerate(inputs):
        for j, of_column in enumerate(inputs):
            axes = panels[i][j]
            if j > i:
                axes.set_axis_off()
                continue
            axes.set_xlim(of_column.low, of_column.high)
            if i == j:
                axes.hist(
                    posterior.samples[:, i], bins=40, density=True, color=RUN_COLOURS[0], alpha=0.8
                )
                if not of_row.logarithmic:
                    axes.axhline(1 / (of_row.high - of_row.low), color=RUN_COLOURS[1], lw=1)
                axes.set_yticks([])
            else:
                axes.plot(dots[:, j], dots[:, i], ".", ms=2, color=RUN_COLOURS[0], alpha=0.4)
                axes.set_ylim(of_row.low, of_row.high)
            if i == count - 1:
                axes.set_xlabel(of_column.name + in_unit(of_column.unit))
            if j == 0 and i > 0:
                axes.set_ylabel(of_row.name)
    save(figure, target)
