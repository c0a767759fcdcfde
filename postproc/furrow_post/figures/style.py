# SPDX-License-Identifier: GPL-2.0-or-later
"""Common style of all figures."""

import string
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure

CENTIMETRE = 100.0  # per metre
MILLIMETRE = 1000.0  # per metre
KILOPASCAL = 1e-3  # per pascal

# Colours of runs that are laid over each other
RUN_COLOURS = ("#1f5a8a", "#c8672b", "#4d8a4a", "#7a4b8c", "#8a6d1f", "#3f3f3f")
WHEEL_COLOUR = "#39424e"
# Colours of ground by displacement or density; at rest: sand
GROUND_COLOURS = LinearSegmentedColormap.from_list("sand", ["#e6d8b4", "#f0b55e", "#dd6a3c", "#a3264f", "#46125c"])


def use_style() -> None:
    """Sets the look of all figures that are made from here on."""
    plt.rcParams.update(
        {
            "font.family": "DejaVu Sans",
            "font.size": 9,
            "axes.titlesize": 10,
            "axes.titlelocation": "left",
            "axes.spines.top": False,
            "axes.spines.right": False,
            "axes.linewidth": 0.8,
            "legend.frameon": False,
            "figure.facecolor": "white",
            "svg.fonttype": "none",
        }
    )


def panel_letters() -> Iterator[str]:
    """a, b, c, ... z, aa, ab, ..."""
    yield from string.ascii_lowercase
    for first in string.ascii_lowercase:
        for second in string.ascii_lowercase:
            yield first + second


def annotate_panel(axes: Axes, letter: str, text: str) -> None:
    axes.set_title(f"$\\mathbf{{{letter}}}$  {text}", color="0.15")


def label_panels(panels: Iterable[Axes], *titles: str) -> None:
    """Gives panels the letters a, b, c, ... and these titles."""
    for axes, letter, title in zip(panels, panel_letters(), titles):
        annotate_panel(axes, letter, title)


def head_figure(figure: Figure, text: str) -> None:
    """A bold title at the left."""
    figure.suptitle(text, x=0.01, ha="left", fontsize=11, fontweight="bold")


def add_scale(axes: Axes, norm: Normalize, label: str, **look: Any) -> None:
    """The scale of GROUND_COLOURS beside axes; look: of matplotlib's colorbar"""
    axes.figure.colorbar(ScalarMappable(norm, GROUND_COLOURS), ax=axes, **look).set_label(label)


def save(figure: Figure, target: Path, dpi: float = 150) -> None:
    """Writes and closes a figure; the ending of target says the format."""
    if engine := figure.get_layout_engine():
        # with an engine savefig draws twice, the first time for the layout alone
        figure.dpi = dpi
        engine.execute(figure)
        figure.set_layout_engine(None)
    figure.savefig(target, dpi=dpi)
    plt.close(figure)


def round_up(value: float) -> float:
    """The end of a scale: to 1, 1.5, 2, 3, 5, 7 times a power of ten."""
    if not value > 0:
        return 1e-3
    power = float(10.0 ** np.floor(np.log10(value)))
    steps = (1, 1.5, 2, 3, 5, 7, 10)
    return power * min(step for step in steps if step * power >= value * (1 - 1e-9))
