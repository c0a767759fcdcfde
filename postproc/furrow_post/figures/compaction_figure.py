# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress and density over depth below the track, runs with the formulas of their contacts."""

from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from ..analyse.compaction import Compaction
from ..laws.half_space import ELASTIC, SOEHNE
from .style import CENTIMETRE, KILOPASCAL, RUN_COLOURS, label_panels, save, use_style


def draw_compaction(runs: Sequence[Compaction], target: Path) -> None:
    use_style()
    figure = Figure((10, 4.2), layout="constrained")
    vertical, mean, density = figure.subplots(1, 3, sharey=True)
    for number, run in enumerate(runs):
        colour = RUN_COLOURS[number % len(RUN_COLOURS)]
        layers = run.layers
        depth = CENTIMETRE * layers.depth
        points = {"fmt": "o", "ms": 3, "lw": 1, "color": colour, "label": run.title}
        stress, error = KILOPASCAL * layers.vertical_stress, KILOPASCAL * layers.vertical_stress_error
        vertical.errorbar(stress, depth, xerr=error, **points)
        elastic, low, high = (
            KILOPASCAL * run.contact.ellipse(layers.distance.to_numpy(), factor)
            for factor in (ELASTIC, SOEHNE[0], SOEHNE[-1])
        )
        vertical.plot(elastic, depth, "--", color=colour, lw=1)
        vertical.fill_betweenx(depth, low, high, color=colour, alpha=0.15, lw=0)
        mean.errorbar(KILOPASCAL * layers.mean_stress, depth, xerr=KILOPASCAL * layers.mean_stress_error, **points)
        ratio = layers.density / layers.density_before
        density.errorbar(ratio, depth, xerr=layers.density_error / layers.density_before, **points)
    label_panels((vertical, mean, density), "largest vertical stress", "largest mean stress", "density")
    deepest = max(float(run.layers.depth.max()) for run in runs)
    vertical.set(xlabel="kPa", ylabel="depth [cm]", xlim=(0, None), ylim=(CENTIMETRE * deepest, 0))
    mean.set(xlabel="kPa", xlim=(0, None))
    density.set(xlabel="over the density before")
    vertical.plot([], [], "k--", lw=1, label="Boussinesq, ellipse")
    vertical.fill_betweenx([], [], [], color="k", alpha=0.15, lw=0, label="Söhne, factor 4 to 6")
    vertical.errorbar([], [], xerr=[], color="k", lw=1, label="bars: one standard error")
    vertical.legend(fontsize=7, loc="lower right")
    save(figure, target)
