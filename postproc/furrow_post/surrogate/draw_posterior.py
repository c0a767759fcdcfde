# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of a posterior: each parameter alone and in pairs, over the range of the prior."""

from pathlib import Path

import matplotlib.pyplot as plt

from ..figures.style import RUN_COLOURS, save, use_style
from .model import Surrogate
from .posterior import Posterior

DOTS = 1500


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
                axes.set_xlabel(
                    f"{of_column.name} [{of_column.unit}]" if of_column.unit else of_column.name
                )
            if j == 0 and i > 0:
                axes.set_ylabel(of_row.name)
    save(figure, target)
