# SPDX-License-Identifier: GPL-2.0-or-later
"""The page of a soil card: curves with their fits, values, ranges."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from ..figures.page import render
from ..figures.style import KILOPASCAL, MILLIMETRE, RUN_COLOURS, annotate_panel, save, use_style
from ..read.soil_card import INDEX_DEPTH, UNITS, Cone, PressureSinkage, Shear, SoilCard
from .fits import ConeCurve, PlateCurve, ShearCurve

FITTED = {"color": "0.25", "lw": 1.0, "ls": "--"}


@dataclass(frozen=True)
class Curves:
    """Curves that the instruments measured; cones: none, one, or one for each packing."""

    plates: Sequence[PlateCurve]
    rings: Sequence[ShearCurve]
    cones: Sequence[ConeCurve]


def draw_card(card: SoilCard, curves: Curves, target: Path) -> None:
    """A panel each of plates, ring and cone; dashed: the card."""
    use_style()
    panels = 3 if curves.cones else 2
    figure, axes = plt.subplots(1, panels, figsize=(3.5 * panels, 3.6), layout="constrained")
    for curve, colour in zip(curves.plates, RUN_COLOURS):
        z = np.linspace(0, curve.sinkage.max(), 100)
        label = f"diameter {2 * MILLIMETRE * curve.radius:.0f} mm"
        axes[0].plot(MILLIMETRE * curve.sinkage, KILOPASCAL * curve.pressure, color=colour, label=label)
        if isinstance(card.pressure_sinkage, PressureSinkage):
            fit = card.pressure_sinkage.at(z, curve.radius)
            axes[0].plot(MILLIMETRE * z, KILOPASCAL * fit, **FITTED)
    axes[0].set(xlabel="sinkage [mm]", ylabel="mean pressure [kPa]", xlim=(0, None), ylim=(0, None))
    if isinstance(card.pressure_sinkage, PressureSinkage):
        axes[0].plot([], [], label="card", **FITTED)
    annotate_panel(axes[0], "a", "plates")
    for ring, colour in zip(curves.rings, RUN_COLOURS):
        label = f"normal stress {KILOPASCAL * ring.normal.mean():.3g} kPa"
        j = MILLIMETRE * ring.displacement
        axes[1].plot(j, KILOPASCAL * ring.shear, color=colour, label=label)
        if isinstance(card.shear, Shear):
            axes[1].plot(j, KILOPASCAL * card.shear.at(ring.displacement, ring.normal), **FITTED)
    if isinstance(card.shear, Shear):
        stress = KILOPASCAL * card.shear.speed_stress.value
        axes[1].plot([], [], label=f"card, without {stress:.2g} kPa of the speed", **FITTED)
    axes[1].set(xlabel="shear displacement [mm]", ylabel="shear stress [kPa]", xlim=(0, None))
    axes[1].set_ylim(0, 1.4 * axes[1].get_ylim()[1])  # room for the legend
    annotate_panel(axes[1], "b", "shear ring")
    for cone, colour in zip(curves.cones, RUN_COLOURS):
        label = f"base {MILLIMETRE * cone.size:.3g} mm"
        axes[2].plot(KILOPASCAL * cone.pressure, MILLIMETRE * cone.depth, color=colour, label=label)
    if curves.cones:
        if isinstance(card.cone, Cone):
            index, spread = KILOPASCAL * card.cone.index.value, KILOPASCAL * card.cone.spread
            depth = 0, MILLIMETRE * card.cone.depth.high
            axes[2].plot((index, index), depth, label=f"index, mean to {depth[1]:.0f} mm", **FITTED)
            low, high = index - spread, index + spread
            axes[2].fill_betweenx(depth, low, high, color="0.6", alpha=0.25, lw=0, label="its spread")
        axes[2].set(
            xlabel="pressure on the base [kPa]",
            ylabel="depth of the base [mm]",
            ylim=(MILLIMETRE * min(curves.cones[0].depth.max(), INDEX_DEPTH), 0),
            xlim=(0, None),
        )
        annotate_panel(axes[2], "c", "cone")
    for panel in axes:
        panel.legend(fontsize=7)
    save(figure, target)


def write_page(card: SoilCard, picture: Path, target: Path) -> None:
    text = render(
        "card.html",
        card.title,
        f"Ground: {card.ground}; {card.condition()}",
        curves=picture,
        parameters=[(name, text, UNITS[name]) for name, text in card.texts().items()],
        ranges=[(meaning, f"{r.low:.3g}", f"{r.high:.3g}", unit) for meaning, r, unit in card.ranges()],
        failures=list(card.failures().items()),
        notes=(*card.index_text(), *card.notes),
    )
    target.write_text(text, encoding="utf-8")
