# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of a comparison of curves."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt

from ..analyse.curves import CurveComparison, CurveKind
from ..uncertainty.verdict import BARS, COVERAGE
from ..arrays import Floats
from .style import KILOPASCAL, MILLIMETRE, RUN_COLOURS, annotate_panel, save, use_style


@dataclass(frozen=True)
class Line:
    """A formula to lay beside plates: sinkage [m], pressure [Pa]."""

    label: str
    x: Floats
    y: Floats


def draw_curves(result: CurveComparison, target: Path, formulas: Sequence[Line] = ()) -> None:
    """Plates by sinkage, with bands, or oedometers by stress."""
    use_style()
    plate = result.kind is CurveKind.PLATE
    figure, axes = plt.subplots(figsize=(6.4, 4.4), layout="constrained")
    band = BARS.replace("bars", "bands")
    for curve, colour in zip(result.curves, RUN_COLOURS):
        look = {"color": colour, "lw": 1.4, "label": curve.label}
        if plate:
            x, y, noise = MILLIMETRE * curve.x, KILOPASCAL * curve.y, KILOPASCAL * COVERAGE * curve.noise
            axes.plot(x, y, **look)
            axes.fill_between(x, y - noise, y + noise, color=colour, alpha=0.2, lw=0, label=band)
            band = "_"  # name that the legend skips
        else:
            axes.semilogx(KILOPASCAL * curve.x, curve.y, **look)
    for line, dashes in zip(formulas, ((6, 2), (2, 2), (6, 2, 1, 2), (1, 2))):
        x, y = MILLIMETRE * line.x, KILOPASCAL * line.y
        axes.plot(x, y, color="0.45", lw=1.1, dashes=dashes, label=line.label)
    if formulas:  # a formula may lie far above: the runs keep their room
        axes.set_ylim(0, KILOPASCAL * 1.6 * max(curve.y.max() for curve in result.curves))
    axes.set(
        xlabel="sinkage [mm]" if plate else "axial stress [kPa]",
        ylabel="mean pressure [kPa]" if plate else "density over that at the start",
    )
    axes.legend(fontsize=8)
    annotate_panel(axes, "a", "plate sinkage" if plate else "confined compression")
    save(figure, target)
