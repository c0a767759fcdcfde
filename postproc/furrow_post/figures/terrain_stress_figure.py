# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress in continuum terrain at the end of a run, along and across, under the wheel.

As in [Shoop2001] Figs 65 and 69: deviatoric stress with the arc that it has ahead of the wheel, the
principal stresses as crosses, and plastic strain. And displacements, across and along.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from ..analyse.stress import Arc, arc_ahead, in_plane
from ..arrays import Floats
from ..read.terrain import Outline, Terrain, TerrainStress
from .style import (
    CENTIMETRE,
    GROUND_COLOURS,
    KILOPASCAL,
    annotate_panel,
    round_up,
    save,
    use_style,
)
from .terrain_figure import draw_frame, draw_section, draw_tracers

COMPRESSION_COLOUR, TENSION_COLOUR = "#1f3a5f", "#c0281c"
ARC_COLOUR = "#12a5a0"
PERCENTILE = 99.0  # of the stresses in view that a scale reaches to


def draw_stress(folder: Path, title: str, target: Path, dpi: float = 150) -> Arc:
    """Draws the stress at the end of the run in folder, and returns the arc ahead of the wheel.

    @raises ResultsError when the run kept no principal stresses
    """
    use_style()
    terrain, stress = Terrain.read(folder), TerrainStress.read(folder)
    body = Outline(folder, terrain)
    middle = float(body.centre[1] + 0.5 * terrain.spacing)
    axle = float(body.centre[0])
    arc = arc_ahead(terrain, stress, body)

    plastic = stress.plastic_strain
    rows = 4 if plastic is None else 5
    figure = plt.figure(figsize=(11, 2.4 * rows), layout="constrained")
    grid = figure.add_gridspec(rows, 2)
    along, crosses = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :])
    across, beside = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])
    tracks, aside = figure.add_subplot(grid[3, 0]), figure.add_subplot(grid[3, 1])
    q = KILOPASCAL * stress.mises
    _draw_field(figure, along, terrain, q, "q [kPa]", body, 1, middle)
    along.plot(CENTIMETRE * arc.x, CENTIMETRE * arc.z, "--", color=ARC_COLOUR, lw=1.4)
    _draw_crosses(crosses, terrain, stress, body, 1, middle)
    _draw_field(figure, across, terrain, q, "q [kPa]", body, 0, axle)
    _draw_crosses(beside, terrain, stress, body, 0, axle)
    draw_tracers(tracks, terrain, body.surface, 1, middle)
    draw_tracers(aside, terrain, body.surface, 0, axle)
    annotate_panel(
        along, "a", f"deviatoric stress q lengthwise; dashed: where it is greatest, {arc.text()}"
    )
    annotate_panel(crosses, "b", "principal stresses in the plane: dark compression, red tension")
    annotate_panel(across, "c", "q across, under the axle")
    annotate_panel(beside, "d", "principal stresses across")
    annotate_panel(tracks, "e", "tracers lengthwise; grey: from where they stood")
    annotate_panel(aside, "f", "tracers that stood under the axle, across")
    if plastic is not None:
        for column, axis, place in ((0, 1, middle), (1, 0, axle)):
            panel = figure.add_subplot(grid[4, column])
            _draw_field(figure, panel, terrain, plastic, "plastic strain", body, axis, place)
            way = "lengthwise" if axis == 1 else "across, under the axle"
            annotate_panel(panel, "gh"[column], f"equivalent plastic strain {way}")
    figure.suptitle(title)
    save(figure, target, dpi)
    return arc


def _draw_field(
    figure: Figure,
    axes: Axes,
    terrain: Terrain,
    values: Floats,
    label: str,
    body: Outline,
    axis: int,
    position: float,
) -> None:
    """A number of each particle on the plane x[axis] = position [m], with its scale from 0."""
    near = terrain.near_plane(axis, position)
    norm = Normalize(0.0, round_up(float(np.percentile(values[near], PERCENTILE))))
    draw_section(axes, terrain, values, body.surface, norm, axis, position)
    scale = ScalarMappable(norm, GROUND_COLOURS)
    bar = figure.colorbar(scale, ax=axes, shrink=0.7, extend="max", panchor=False)
    bar.set_label(label)


def _draw_crosses(
    axes: Axes,
    terrain: Terrain,
    stress: TerrainStress,
    body: Outline,
    axis: int,
    position: float,
) -> None:
    """Principal stresses of the plane x[axis] = position [m], a cross for each particle.

    Arms are as long as the square root of the stress, the longest as long as a particle is wide.
    """
    along = 1 - axis
    near = np.flatnonzero(terrain.near_plane(axis, position))
    values, directions = in_plane(stress.tensor(near), along)
    greatest = float(np.percentile(np.abs(values), PERCENTILE)) or 1.0
    place = terrain.x[near][:, [along, 2]]
    for k in range(2):
        size = np.sqrt(np.clip(np.abs(values[:, k]) / greatest, 0.0, 1.0))
        arm = 0.6 * terrain.spacing * size[:, None] * directions[:, :, k]
        segments = CENTIMETRE * np.stack([place - arm, place + arm], axis=1)
        for colour, chosen in (
            (COMPRESSION_COLOUR, values[:, k] <= 0),
            (TENSION_COLOUR, values[:, k] > 0),
        ):
            axes.add_collection(LineCollection(list(segments[chosen]), colors=colour, lw=0.7))
    axes.text(
        0.99,
        0.9,
        f"longest arm: {KILOPASCAL * greatest:.3g} kPa",
        transform=axes.transAxes,
        ha="right",
        fontsize=8,
    )
    draw_frame(axes, terrain, body.surface, axis, position)
