# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of a surrogate: predictions of held-out runs against the runs."""

from collections.abc import Mapping
from pathlib import Path

import matplotlib.pyplot as plt

from ..arrays import Floats
from ..figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from .gaussian_process import Z_95, HeldOut


def draw_held_out(
    runs: Mapping[str, Floats], held_out: Mapping[str, HeldOut], target: Path
) -> None:
    """Bars: 95 % band."""
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
        axes.set_ylabel("predicted without it")
    save(figure, target)
