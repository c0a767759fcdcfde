# SPDX-License-Identifier: GPL-2.0-or-later
"""The figures of furrow-tyre --modes: the first natural modes of each state of a tyre."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from ..arrays import Floats, Integers
from ..errors import ResultsError
from ..read.hdf5 import opened
from ..read.results import decoded
from .style import head_figure, save, use_style

DRAWN = 12  # modes at most
COLUMNS = 4
AMPLITUDE = 0.15  # of the radius, for the largest component of a shape
COLOURS = "YlOrBr"


class Mode(NamedTuple):
    """A natural mode: its frequency [Hz], waves around the tread, displacement (nodes, 3) whose
    largest component is 1, and the largest of the shares of its motion in words."""

    frequency: float
    waves: int
    shape: Floats
    direction: str


class TyreModes(NamedTuple):
    """Modes of a tyre at rest: nodes (n, 3) [m] and triangles (m, 3) of its tread."""

    heading: str
    x: Floats
    triangles: Integers
    modes: Sequence[Mode]


def read_modes(path: Path) -> TyreModes:
    """Reads a file <state>_modes.h5. @raises ResultsError"""
    with opened(path) as file:
        names = sorted(name for name in file if name.startswith("mode_"))
        modes = []
        for name in names:
            given = file[name].attrs
            direction = max(("radial", "circumferential", "axial"), key=lambda d: float(given[d]))
            modes.append(Mode(float(given["frequency"]), int(given["waves"]), file[name][...], direction))
        load = float(file.attrs["load"])
        heading = (
            f"{decoded(file.attrs['title'])} at {float(file.attrs['pressure']) / 1e3:.4g} kPa, "
            + (f"standing under {load:.4g} N" if load > 0 else "free")
        )
        return TyreModes(heading, file["x"][...], file["triangles"][...], modes)


def draw_modes(folder: Path) -> list[Path]:
    """Draws every *_modes.h5 of a results folder, and returns the figures' paths.

    @raises ResultsError when there is none
    """
    use_style()
    files = sorted(folder.glob("*_modes.h5"))
    if not files:
        raise ResultsError(f"{folder}: has no natural modes (*_modes.h5); make them by furrow-tyre --modes")
    return [_draw_state(read_modes(path), path.with_suffix(".png")) for path in files]


def _draw_state(tyre: TyreModes, target: Path) -> Path:
    drawn = tyre.modes[:DRAWN]
    columns = min(COLUMNS, len(drawn))
    rows = -(-len(drawn) // columns)
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(2.6 * columns, 2.7 * rows + 0.4),
        subplot_kw={"projection": "3d"},
        layout="constrained",
        squeeze=False,
    )
    for panel, mode in zip(axes.flat, drawn):
        _draw_mode(panel, tyre, mode)
    for panel in axes.flat[len(drawn) :]:
        panel.remove()
    head_figure(figure, tyre.heading)
    save(figure, target)
    return target


def _draw_mode(axes: Axes3D, tyre: TyreModes, mode: Mode) -> None:
    """The tread as the mode moves it, coloured by how far."""
    middle = 0.5 * (tyre.x.min(axis=0) + tyre.x.max(axis=0))
    radius = 0.5 * np.ptp(tyre.x[:, 2])
    moved = tyre.x - middle + AMPLITUDE * radius * mode.shape
    amount = np.linalg.norm(mode.shape, axis=1)[tyre.triangles].mean(axis=1)
    faces = Poly3DCollection(
        moved[tyre.triangles],
        facecolors=plt.get_cmap(COLOURS)(amount / amount.max()),
        edgecolors="0.35",
        linewidths=0.1,
    )
    axes.add_collection3d(faces)
    reach = 0.8 * radius
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach))
    axes.set_box_aspect((1, 1, 1), zoom=1.3)
    axes.view_init(elev=18, azim=-62)
    axes.set_axis_off()
    wave = "wave" if mode.waves == 1 else "waves"
    axes.set_title(f"{mode.frequency:.1f} Hz\n{mode.waves} {wave}, mostly {mode.direction}", fontsize=9)
