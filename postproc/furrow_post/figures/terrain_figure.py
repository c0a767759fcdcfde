# SPDX-License-Identifier: GPL-2.0-or-later
"""Continuum terrain at the end of a run: density, tracers and stress in sections, a picture without a display.

Sections as in [Shoop2001] Figs 65-69: across the track and along it, coloured by density or by the deviatoric stress
with the arc that it has ahead of the wheel; principal stresses as crosses; plastic strain; and the displacement of
tracers that stood in straight lines before the wheel passed.
"""

import textwrap
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from scipy.spatial import cKDTree

from ..analyse.rut import RutDensities, rut_densities, rut_place
from ..analyse.stress import Arc, arc_ahead, in_plane
from ..arrays import Floats
from ..read.results import Surface
from ..read.terrain import Outline, Terrain, TerrainStress
from .render import OBLIQUE, cut, shaded_picture
from .style import (
    CENTIMETRE,
    GROUND_COLOURS,
    KILOPASCAL,
    WHEEL_COLOUR,
    add_scale,
    label_panels,
    round_up,
    save,
    use_style,
)

Extent = tuple[float, float, float, float]  # left, right, bottom, top [m]
COMPRESSION_COLOUR, TENSION_COLOUR = "#1f3a5f", "#c0281c"
ARC_COLOUR = "#12a5a0"
PIXEL = 0.002  # of sections [m]
PERCENTILE = 99.0  # of the stresses in view that a scale reaches to


@dataclass(frozen=True)
class Section:
    """The plane x[axis] = position [m] of terrain, with the surface of the body on it, if there is one."""

    terrain: Terrain
    surface: Surface | None
    axis: int
    position: float

    @property
    def plane(self) -> list[int]:
        """Indices of the axes in the plane of the figure."""
        return [1 - self.axis, 2]

    def draw_values(self, axes: Axes, values: Floats, norm: Normalize) -> None:
        """Values (n) of the particles."""
        image, extent = self._image(values)
        axes.imshow(
            image,
            origin="lower",
            extent=[CENTIMETRE * e for e in extent],
            cmap=GROUND_COLOURS,
            norm=norm,
            interpolation="nearest",
        )
        self._draw_frame(axes)

    def draw_field(self, axes: Axes, values: Floats, label: str) -> None:
        """Values (n) of the particles, with their scale from 0."""
        near = self.terrain.near_plane(self.axis, self.position)
        norm = Normalize(0.0, round_up(float(np.percentile(values[near], PERCENTILE))))
        self.draw_values(axes, values, norm)
        add_scale(axes, norm, label, shrink=0.7, extend="max", panchor=False)

    def draw_crosses(self, axes: Axes, stress: TerrainStress) -> None:
        """Principal stresses in the plane, a cross for each particle.

        Arms are as long as the square root of the stress, the longest as long as a particle is wide.
        """
        near = np.flatnonzero(self.terrain.near_plane(self.axis, self.position))
        values, directions = in_plane(stress.tensor(near), self.plane[0])
        greatest = float(np.percentile(np.abs(values), PERCENTILE)) or 1.0
        place = self.terrain.x[near][:, self.plane]
        for k in range(2):
            size = np.sqrt(np.clip(np.abs(values[:, k]) / greatest, 0.0, 1.0))
            arm = 0.6 * self.terrain.spacing * size[:, None] * directions[:, :, k]
            segments = CENTIMETRE * np.stack([place - arm, place + arm], axis=1)
            tension = values[:, k] > 0
            for colour, chosen in ((COMPRESSION_COLOUR, ~tension), (TENSION_COLOUR, tension)):
                axes.add_collection(LineCollection(list(segments[chosen]), colors=colour, lw=0.7))
        text = f"longest arm: {KILOPASCAL * greatest:.3g} kPa"
        axes.text(0.99, 0.9, text, transform=axes.transAxes, ha="right", fontsize=8)
        self._draw_frame(axes)

    def draw_tracers(self, axes: Axes) -> None:
        """Draws tracers that stood on vertical lines in the plane, with thin lines from their first places."""
        terrain = self.terrain
        near = np.abs(terrain.initial_position[:, self.axis] - self.position)
        chosen = near < near.min() + 0.25 * terrain.spacing
        before, now = (x[chosen][:, self.plane] for x in (terrain.initial_position, terrain.x))
        paths = CENTIMETRE * np.stack([before, now], axis=1)
        axes.add_collection(LineCollection(paths, colors="0.75", lw=0.5))
        for place in np.unique(np.round(before[:, 0], 6))[:: 1 + self.axis]:
            line = np.abs(before[:, 0] - place) < 1e-5
            order = np.argsort(before[line, 1])
            x, z = CENTIMETRE * now[line][order].T
            axes.plot(x, z, "-o", ms=2, lw=0.9, color=GROUND_COLOURS(0.62))
        self._draw_frame(axes)

    def _draw_frame(self, axes: Axes) -> None:
        """Level of the ground before, outline of the body, limits and names of the axes."""
        axes.axhline(CENTIMETRE * self.terrain.level, color="0.15", lw=0.9, ls=(0, (6, 4)))
        if self.surface is not None:
            segments = CENTIMETRE * cut(self.surface, self.axis, self.position)[:, :, self.plane]
            axes.add_collection(LineCollection(segments, colors=WHEEL_COLOUR, lw=1.6, capstyle="round"))
        x, z = self.terrain.x[:, self.plane].T
        axes.set_xlim(CENTIMETRE * x.min(), CENTIMETRE * x.max())
        axes.set_ylim(CENTIMETRE * min(z.min(), 0.0), CENTIMETRE * (self.terrain.level + 0.10))
        axes.set_aspect("equal", anchor="W")
        axes.set(xlabel=f"{'xy'[self.plane[0]]} [cm]", ylabel="z [cm]")

    def _image(self, values: Floats) -> tuple[Floats, Extent]:
        """Values (n) on the plane, of the particle that is nearest in the plane, NaN outside of the terrain; extent."""
        terrain = self.terrain
        slab = terrain.near_plane(self.axis, self.position)
        flat = terrain.x[slab][:, self.plane]
        low = flat.min(axis=0) - 0.5 * terrain.spacing
        high = flat.max(axis=0) + 0.5 * terrain.spacing
        low[1] = min(low[1], 0.0)
        columns, rows = (int(count) for count in np.ceil((high - low) / PIXEL))
        across, up = (low[k] + PIXEL * (np.arange(n) + 0.5) for k, n in enumerate((columns, rows)))
        grid = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
        # Compacted ground is flattened: a particle fills the height that it has
        distance, nearest = cKDTree(flat).query(grid, k=range(1, min(4, len(flat)) + 1))
        squeeze = np.clip(terrain.undisturbed / terrain.density[slab], 0.2, 1.5)
        offset = np.abs(grid[:, None, :] - flat[nearest])
        # Particles of graded cells may be longer than the spacing
        mass = terrain.volume * terrain.density
        reach = 0.75 * terrain.spacing * np.clip(mass / mass.min(), 1.0, 4.0)[slab][nearest]
        beside = offset[..., 0] < reach
        above = offset[..., 1] < reach * squeeze[nearest] + 0.25 * PIXEL
        covered = (beside & above).any(axis=1) | (distance[:, 0] < 0.35 * terrain.spacing)
        image = np.where(covered, values[slab][nearest[:, 0]], np.nan)
        right, top = low[0] + columns * PIXEL, low[1] + rows * PIXEL
        return image.reshape(rows, columns), (float(low[0]), float(right), float(low[1]), float(top))


def _sections(terrain: Terrain, body: Outline) -> tuple[Section, Section]:
    """Lengthwise through the middle of the body, and across under its axle."""
    middle = float(body.centre[1] + 0.5 * terrain.spacing)
    return Section(terrain, body.surface, 1, middle), Section(terrain, body.surface, 0, float(body.centre[0]))


def draw_terrain(
    folder: Path, title: str, numbers: str, target: Path, pixels: int = 1000, dpi: float = 150
) -> RutDensities:
    """Draws the terrain at the end of the run in folder, and returns the densities of its rut.

    numbers: a line of results for the title, or ""; pixels: width of the oblique view.
    @raises ResultsError when the run kept no terrain
    """
    use_style()
    terrain = Terrain.read(folder)
    body = Outline(folder, terrain)
    densities = rut_densities(terrain, body)
    densest = round_up(float(np.percentile(terrain.density, 99.5)))
    norm = Normalize(0.9 * terrain.undisturbed, densest)
    behind = rut_place(terrain, body)
    lengthwise, under = _sections(terrain, body)
    rut = Section(terrain, body.surface, 0, under.position + behind)

    figure = plt.figure(figsize=(11, 12.6), layout="constrained")
    panels = figure.subplot_mosaic("aa;bb;cc;de", height_ratios=[1.75, 1, 1, 1])
    _draw_oblique(panels["a"], terrain, body, norm, pixels)
    add_scale(panels["a"], norm, "density [kg/m³]", extend="both", fraction=0.03, pad=0.01, shrink=0.8, panchor=False)
    lengthwise.draw_values(panels["b"], terrain.density, norm)
    lengthwise.draw_tracers(panels["c"])
    under.draw_values(panels["d"], terrain.density, norm)
    rut.draw_values(panels["e"], terrain.density, norm)
    label_panels(
        panels.values(),
        "from behind; particles",
        "lengthwise through the middle; dashed: surface before",
        "tracers of the same plane that stood on vertical lines; grey: from where they stood",
        f"across, under the axle: {densities.under:.0f} kg/m³ in the middle",
        f"across, {-CENTIMETRE * behind:.0f} cm behind: shoulder {densities.shoulder:.0f} kg/m³",
    )
    size = f"{len(terrain.x)} particles (mirrored), {terrain.undisturbed:.0f} kg/m³ before"
    figure.suptitle("\n".join(line for line in (title, size, *textwrap.wrap(numbers, 100)) if line))
    save(figure, target, dpi)
    return densities


def _draw_oblique(axes: Axes, terrain: Terrain, body: Outline, norm: Normalize, pixels: int) -> None:
    radius = 0.62 * np.cbrt(terrain.volume * terrain.density / terrain.undisturbed)
    width = np.abs(OBLIQUE.right) @ np.ptp(terrain.x, axis=0)
    colours = GROUND_COLOURS(norm(terrain.density))[:, :3]
    picture, extent = shaded_picture(terrain.x, radius, colours, body.surface, OBLIQUE, width / pixels)
    axes.imshow(picture, extent=[CENTIMETRE * e for e in extent], interpolation="antialiased")
    axes.set_axis_off()


def draw_density_section(axes: Axes, terrain: Terrain, axis: int, position: float) -> None:
    """The section x[axis] = position [m] without a body, with its scale: for plates, columns."""
    norm = Normalize(0.9 * terrain.undisturbed, round_up(float(terrain.density.max())))
    Section(terrain, None, axis, position).draw_values(axes, terrain.density, norm)
    add_scale(axes, norm, "density [kg/m³]", shrink=0.7, extend="min")


def draw_stress(folder: Path, title: str, target: Path, dpi: float = 150) -> Arc:
    """Draws the stress at the end of the run in folder, and returns the arc ahead of the wheel.

    @raises ResultsError when the run kept no principal stresses
    """
    use_style()
    terrain, stress = Terrain.read(folder), TerrainStress.read(folder)
    body = Outline(folder, terrain)
    lengthwise, across = _sections(terrain, body)
    arc = arc_ahead(terrain, stress, body)
    plastic = stress.plastic_strain
    rows = ["aa", "bb", "cd", "ef", *([] if plastic is None else ["gh"])]
    figure = plt.figure(figsize=(11, 2.4 * len(rows)), layout="constrained")
    panels = figure.subplot_mosaic(";".join(rows))
    q = KILOPASCAL * stress.mises
    lengthwise.draw_field(panels["a"], q, "q [kPa]")
    panels["a"].plot(CENTIMETRE * arc.x, CENTIMETRE * arc.z, "--", color=ARC_COLOUR, lw=1.4)
    lengthwise.draw_crosses(panels["b"], stress)
    across.draw_field(panels["c"], q, "q [kPa]")
    across.draw_crosses(panels["d"], stress)
    lengthwise.draw_tracers(panels["e"])
    across.draw_tracers(panels["f"])
    if plastic is not None:
        lengthwise.draw_field(panels["g"], plastic, "plastic strain")
        across.draw_field(panels["h"], plastic, "plastic strain")
    label_panels(
        panels.values(),
        f"deviatoric stress q lengthwise; dashed: where it is greatest, {arc.text()}",
        "principal stresses in the plane: dark compression, red tension",
        "q across, under the axle",
        "principal stresses across",
        "tracers lengthwise; grey: from where they stood",
        "tracers that stood under the axle, across",
        "equivalent plastic strain lengthwise",
        "equivalent plastic strain across, under the axle",
    )
    figure.suptitle(title)
    save(figure, target, dpi)
    return arc
