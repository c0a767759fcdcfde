# SPDX-License-Identifier: GPL-2.0-or-later
"""Continuum terrain at the end of a run: density sections, tracers, a picture without a display.

Sections as in [Shoop2001] Figs 65-67: across the track and along it, coloured by density, and the
displacement of tracers that stood in straight lines before the wheel passed.
"""

import textwrap
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from scipy.spatial import cKDTree

from ..analyse.rut import RutDensities, rut_densities, rut_place
from ..arrays import Floats
from ..read.results import Surface
from ..read.terrain import Outline, Terrain
from .canvas import View
from .cut import cut
from .render import shaded_picture
from .style import (
    CENTIMETRE,
    GROUND_COLOURS,
    WHEEL_COLOUR,
    annotate_panel,
    round_up,
    save,
    use_style,
)

Extent = tuple[float, float, float, float]  # left, right, bottom, top [m]


def draw_terrain(
    folder: Path, title: str, numbers: str, target: Path, pixels: int = 1000, dpi: float = 150
) -> RutDensities:
    """Draws the terrain at the end of the run in folder, and returns the densities of its rut.

    numbers: a line of results for the title, or ""; pixels: width of the oblique view. @raises
    ResultsError when the run kept no terrain
    """
    use_style()
    terrain = Terrain.read(folder)
    body = Outline(folder, terrain)
    densities = rut_densities(terrain, body)
    densest = round_up(float(np.percentile(terrain.density, 99.5)))
    norm = Normalize(0.9 * terrain.undisturbed, densest)
    axle = float(body.centre[0])
    behind = axle + rut_place(terrain, body)

    figure = plt.figure(figsize=(11, 12.6), layout="constrained")
    grid = figure.add_gridspec(4, 2, height_ratios=[1.75, 1, 1, 1])
    oblique = figure.add_subplot(grid[0, :])
    _draw_oblique(oblique, terrain, body, norm, pixels)
    bar = figure.colorbar(
        ScalarMappable(norm, GROUND_COLOURS),
        ax=oblique,
        extend="both",
        fraction=0.03,
        pad=0.01,
        shrink=0.8,
        panchor=False,
    )
    bar.set_label("density [kg/m³]")
    lengthwise, tracks = figure.add_subplot(grid[1, :]), figure.add_subplot(grid[2, :])
    under, rut = figure.add_subplot(grid[3, 0]), figure.add_subplot(grid[3, 1])
    middle = float(body.centre[1] + 0.5 * terrain.spacing)
    draw_section(lengthwise, terrain, terrain.density, body.surface, norm, 1, middle)
    draw_tracers(tracks, terrain, body.surface, 1, middle)
    draw_section(under, terrain, terrain.density, body.surface, norm, 0, axle)
    draw_section(rut, terrain, terrain.density, body.surface, norm, 0, behind)
    tracers = "tracers of the same plane that stood on vertical lines; grey: from where they stood"
    distance = CENTIMETRE * (axle - behind)
    annotate_panel(oblique, "a", "from behind; particles")
    annotate_panel(lengthwise, "b", "lengthwise through the middle; dashed: surface before")
    annotate_panel(tracks, "c", tracers)
    annotate_panel(under, "d", f"across, under the axle: {densities.under:.0f} kg/m³ in the middle")
    annotate_panel(
        rut, "e", f"across, {distance:.0f} cm behind: shoulder {densities.shoulder:.0f} kg/m³"
    )
    size = f"{len(terrain.x)} particles (mirrored), {terrain.undisturbed:.0f} kg/m³ before"
    figure.suptitle("\n".join(line for line in (title, size, *textwrap.wrap(numbers, 100)) if line))
    save(figure, target, dpi)
    return densities


def draw_density_section(
    figure: Figure, axes: Axes, terrain: Terrain, axis: int, position: float
) -> None:
    """The section x[axis] = position [m] without a body, with its scale: for plates, columns."""
    densest = round_up(float(terrain.density.max()))
    norm = Normalize(0.9 * terrain.undisturbed, densest)
    draw_section(axes, terrain, terrain.density, None, norm, axis, position)
    scale = ScalarMappable(norm, GROUND_COLOURS)
    figure.colorbar(scale, ax=axes, shrink=0.7, extend="min").set_label("density [kg/m³]")


def _draw_oblique(
    axes: Axes, terrain: Terrain, body: Outline, norm: Normalize, pixels: int
) -> None:
    view = View.of_angles(-112.0, 30.0)
    radius = 0.62 * np.cbrt(terrain.volume * terrain.density / terrain.undisturbed)
    width = np.abs(view.right) @ np.ptp(terrain.x, axis=0)
    colours = GROUND_COLOURS(norm(terrain.density))[:, :3]
    picture, extent = shaded_picture(
        terrain.x, radius, colours, body.surface, view, width / pixels
    )
    axes.imshow(picture, extent=[CENTIMETRE * e for e in extent], interpolation="antialiased")
    axes.set_axis_off()


def _section_image(
    terrain: Terrain, values: Floats, axis: int, position: float, pixel: float = 0.002
) -> tuple[Floats, Extent]:
    """Values (n) on the plane x[axis] = position, of the particle that is nearest in the plane.

    NaN outside of the terrain; and the extent. position, pixel [m]
    """
    along = 1 - axis
    slab = terrain.near_plane(axis, position)
    flat = terrain.x[slab][:, [along, 2]]
    low = flat.min(axis=0) - 0.5 * terrain.spacing
    high = flat.max(axis=0) + 0.5 * terrain.spacing
    low[1] = min(low[1], 0.0)
    columns, rows = (int(count) for count in np.ceil((high - low) / pixel))
    across, up = (low[k] + pixel * (np.arange(n) + 0.5) for k, n in enumerate((columns, rows)))
    grid = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
    # Compacted ground is flattened: a particle fills the height that it has
    distance, nearest = cKDTree(flat).query(grid, k=range(1, min(4, len(flat)) + 1))
    squeeze = np.clip(terrain.undisturbed / terrain.density[slab], 0.2, 1.5)
    offset = np.abs(grid[:, None, :] - flat[nearest])
    reach = 0.75 * terrain.spacing * _coarseness(terrain)[slab][nearest]
    beside = offset[..., 0] < reach
    above = offset[..., 1] < reach * squeeze[nearest] + 0.25 * pixel
    covered = (beside & above).any(axis=1) | (distance[:, 0] < 0.35 * terrain.spacing)
    image = np.where(covered, values[slab][nearest[:, 0]], np.nan)
    right, top = low[0] + columns * pixel, low[1] + rows * pixel
    return image.reshape(rows, columns), (float(low[0]), float(right), float(low[1]), float(top))


def _coarseness(terrain: Terrain) -> Floats:
    """How much longer than the spacing the particles (n) of graded cells may be, at most."""
    mass = terrain.volume * terrain.density
    return np.asarray(np.clip(mass / mass.min(), 1.0, 4.0))


def draw_section(
    axes: Axes,
    terrain: Terrain,
    values: Floats,
    surface: Surface | None,
    norm: Normalize,
    axis: int,
    position: float,
) -> None:
    """Values of the particles on the plane x[axis] = position [m]; surface: of the body, or
    None."""
    image, extent = _section_image(terrain, values, axis, position)
    axes.imshow(
        image,
        origin="lower",
        extent=[CENTIMETRE * e for e in extent],
        cmap=GROUND_COLOURS,
        norm=norm,
        interpolation="nearest",
    )
    draw_frame(axes, terrain, surface, axis, position)


def draw_frame(
    axes: Axes, terrain: Terrain, surface: Surface | None, axis: int, position: float
) -> None:
    """Level of the ground before, outline of the body, limits and names of the axes."""
    along = 1 - axis
    axes.axhline(CENTIMETRE * terrain.level, color="0.15", lw=0.9, ls=(0, (6, 4)))
    if surface is not None:
        segments = CENTIMETRE * cut(surface, axis, position)[:, :, [along, 2]]
        outline = LineCollection(segments, colors=WHEEL_COLOUR, lw=1.6, capstyle="round")
        axes.add_collection(outline)
    x, z = terrain.x[:, along], terrain.x[:, 2]
    axes.set_xlim(CENTIMETRE * x.min(), CENTIMETRE * x.max())
    axes.set_ylim(CENTIMETRE * min(z.min(), 0.0), CENTIMETRE * (terrain.level + 0.10))
    axes.set_aspect("equal", anchor="W")
    axes.set_xlabel(f"{'xy'[along]} [cm]")
    axes.set_ylabel("z [cm]")


def draw_tracers(
    axes: Axes, terrain: Terrain, surface: Surface | None, axis: int, position: float
) -> None:
    """Where tracers are now that stood in the plane x[axis] = position on vertical lines.

    Thin lines from where they stood.
    """
    along = 1 - axis
    near = np.abs(terrain.initial_position[:, axis] - position)
    chosen = near < near.min() + 0.25 * terrain.spacing
    before = terrain.initial_position[chosen][:, [along, 2]]
    now = terrain.x[chosen][:, [along, 2]]
    paths = CENTIMETRE * np.stack([before, now], axis=1)
    axes.add_collection(LineCollection(paths, colors="0.75", lw=0.5))
    for place in np.unique(np.round(before[:, 0], 6))[:: 2 if along == 0 else 1]:
        line = np.abs(before[:, 0] - place) < 1e-5
        order = np.argsort(before[line, 1])
        x, z = CENTIMETRE * now[line][order].T
        axes.plot(x, z, "-o", ms=2, lw=0.9, color=GROUND_COLOURS(0.62))
    draw_frame(axes, terrain, surface, axis, position)
