# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post ground: density sections and tracers of continuum ground, the densities of the rut, a picture without a display.

Sections as S. A. Shoop (ERDC/CRREL TR-01-16, 2001, Fig 65-67) shows them: across the track and along it, coloured by density, and the
displacement of tracers that stood in straight lines before the wheel came.
"""

from dataclasses import dataclass

import h5py
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from scipy.spatial import cKDTree

from . import render
from .picture import COLOURS, WHEEL, cut
from .results import ResultsError
from .style import CENTIMETRE, annotate_panel, save, use_style

UNDER = 0.04     # m along the track to both sides of the axle that count as under the wheel
SHOULDER = 0.05  # m outwards of the wheel's side that count as its shoulder
BEHIND = 0.6     # of the length of ground behind the axle: where the finished rut is cut


@dataclass
class Ground:
    """Particles of ground.h5 at the end of a run: x, home (n, 3) [m], density (n) [kg/m3], volume (n) [m3]; half models are mirrored."""

    x: np.ndarray
    home: np.ndarray
    density: np.ndarray
    volume: np.ndarray
    level: float        # m, z of the undisturbed surface
    undisturbed: float  # kg/m3

    @classmethod
    def read(cls, folder):
        path = folder / "ground.h5"
        try:
            with h5py.File(path, "r") as content:
                group = content["ground"]
                x, home, density, volume = (group[name][()] for name in ("x", "home", "density", "volume"))
        except (OSError, KeyError) as error:
            raise ResultsError(f"{path}: has no ground at the end of a run ({error}); give the folder of a run with fix terrain/history "
                               "that came to its end") from error
        spacing = [cls._spacing(home[:, axis]) for axis in range(3)]
        level = home[:, 2].max() + 0.5 * spacing[2]
        fine = np.abs(home[:, 1]) < np.abs(home[:, 1]).min() + 0.1 * spacing[1]
        undisturbed = float(np.median((density * volume)[fine]) / np.prod(spacing))
        ground = cls(x, home, density, volume, level, undisturbed)
        return ground.mirrored() if home[:, 1].min() > 0 else ground

    @staticmethod
    def _spacing(coordinates):
        """Of the lattice on which particles stood, in its fine part [m]."""
        places = np.unique(np.round(coordinates, 9))
        if len(places) < 2:
            raise ResultsError("ground.h5: a ground of a single layer of particles has no sections")
        return float(np.diff(places).min())

    def mirrored(self):
        flip = np.array([1.0, -1.0, 1.0])
        return Ground(np.vstack([self.x, self.x * flip]), np.vstack([self.home, self.home * flip]), np.tile(self.density, 2),
                      np.tile(self.volume, 2), self.level, self.undisturbed)

    @property
    def spacing(self):
        """Of the particles before the wheel came, in the fine part [m]."""
        return float(np.percentile(self.volume * self.density / self.undisturbed, 5) ** (1 / 3))

    def mean_density(self, inside):
        """Mass over volume of the particles inside (n booleans) [kg/m3]; NaN where there is none."""
        volume = self.volume[inside].sum()
        return float((self.density[inside] * self.volume[inside]).sum() / volume) if volume > 0 else np.nan


class Body:
    """Wheel, tyre or plate at the end, from history.h5 beside it; without one the sections are in the middle."""

    def __init__(self, folder, ground):
        self.surface = None
        try:
            with h5py.File(folder / "history.h5", "r") as content:
                self.surface = (content["surface/triangles"][()], content["surface/x"][()])
        except (OSError, KeyError):
            pass
        low, high = (self.surface[1].min(axis=0), self.surface[1].max(axis=0)) if self.surface else (ground.x.min(axis=0), ground.x.max(axis=0))
        self.centre, self.half_width = 0.5 * (low + high), 0.5 * (high - low)[1] if self.surface else np.nan


def densities(ground, body):
    """dict: density under the wheel (greatest particle and mean over the middle half of the width), in the rut and at its shoulder behind it."""
    x, y = ground.x[:, 0] - body.centre[0], np.abs(ground.x[:, 1] - body.centre[1])
    behind = np.abs(x - rut_place(ground, body)) < UNDER
    middle, shoulder = y < 0.5 * body.half_width, (y > body.half_width) & (y < body.half_width + SHOULDER)
    under = (np.abs(x) < UNDER) & middle
    return {"undisturbed": ground.undisturbed, "under the wheel": ground.mean_density(under),
            "greatest under the wheel": float(ground.density[under].max()) if under.any() else np.nan,
            "in the rut behind": ground.mean_density(behind & middle), "at the shoulder": ground.mean_density(behind & shoulder)}


def rut_place(ground, body):
    """x of the section through the finished rut, from the axle [m]: negative."""
    return BEHIND * (ground.x[:, 0].min() - body.centre[0])


def text(values):
    """The densities of the rut, one a line."""
    lines = [f"{name:26} {value:6.0f} kg/m3" if np.isfinite(value) else f"{name:26}    not known" for name, value in values.items()]
    return "\n".join(["Density", *("  " + line for line in lines),
                      f"  under: {CENTIMETRE * UNDER:.0f} cm to both sides of the axle, middle half of the width, all depths; "
                      f"shoulder: {CENTIMETRE * SHOULDER:.0f} cm beside the wheel"])


def _nearest(ground, axis, position, pixel=0.002):
    """Densities on a plane x[axis] = position, of the particle that is nearest in the plane; NaN outside of the ground. And its extent [m]."""
    along = 1 - axis
    slab = np.abs(ground.x[:, axis] - position) < 0.75 * ground.spacing
    flat = ground.x[slab][:, [along, 2]]
    if len(flat) == 0:
        raise ResultsError(f"there is no ground at {'xy'[axis]} = {position:.3f} m")
    low = flat.min(axis=0) - 0.5 * ground.spacing
    high = flat.max(axis=0) + 0.5 * ground.spacing
    low[1] = min(low[1], 0.0)
    columns, rows = np.ceil((high - low) / pixel).astype(int)
    grid = np.stack(np.meshgrid(low[0] + pixel * (np.arange(columns) + 0.5), low[1] + pixel * (np.arange(rows) + 0.5)), axis=-1)
    # Compacted ground is flattened: heights count by how much, so that a particle fills the height that it has.
    distance, nearest = cKDTree(flat).query(grid.reshape(-1, 2), k=4)
    squeeze = np.clip(ground.undisturbed / ground.density[slab], 0.2, 1.5)
    offset = np.abs(grid.reshape(-1, 1, 2) - flat[nearest])
    covered = ((offset[..., 0] < 0.75 * ground.spacing) & (offset[..., 1] < 0.75 * ground.spacing * squeeze[nearest] + 0.25 * pixel)).any(axis=1)
    covered |= distance[:, 0] < 0.35 * ground.spacing
    image = np.where(covered, ground.density[slab][nearest[:, 0]], np.nan).reshape(rows, columns)
    return image, (low[0], low[0] + columns * pixel, low[1], low[1] + rows * pixel)


def _section(axes, ground, body, norm, axis, position):
    image, extent = _nearest(ground, axis, position)
    axes.imshow(image, origin="lower", extent=[CENTIMETRE * e for e in extent], cmap=COLOURS, norm=norm, interpolation="nearest")
    _frame(axes, ground, body.surface, axis, position)


def _frame(axes, ground, surface, axis, position):
    """Level of the ground before, outline of the wheel, limits and names of the axes."""
    along = 1 - axis
    axes.axhline(CENTIMETRE * ground.level, color="0.15", lw=0.9, ls=(0, (6, 4)))
    if surface:
        segments = CENTIMETRE * cut(surface, axis, position)[:, :, [along, 2]]
        axes.add_collection(LineCollection(segments, colors=WHEEL, lw=1.6, capstyle="round"))
    axes.set_xlim(CENTIMETRE * ground.x[:, along].min(), CENTIMETRE * ground.x[:, along].max())
    axes.set_ylim(CENTIMETRE * min(ground.x[:, 2].min(), 0.0), CENTIMETRE * (ground.level + 0.10))
    axes.set_aspect("equal")
    axes.set_xlabel(f"{'xy'[along]} [cm]")
    axes.set_ylabel("z [cm]")


def _tracers(axes, ground, body, axis, position):
    """Where tracers are now that stood in the plane x[axis] = position on vertical lines; thin lines from where they stood."""
    along = 1 - axis
    near = np.abs(ground.home[:, axis] - position)
    chosen = near < near.min() + 0.25 * ground.spacing
    home, x = ground.home[chosen][:, [along, 2]], ground.x[chosen][:, [along, 2]]
    axes.add_collection(LineCollection(CENTIMETRE * np.stack([home, x], axis=1), colors="0.75", lw=0.5))
    for place in np.unique(np.round(home[:, 0], 6))[::2 if along == 0 else 1]:
        line = np.abs(home[:, 0] - place) < 1e-5
        order = np.argsort(home[line, 1])
        axes.plot(*(CENTIMETRE * x[line][order]).T, "-o", ms=2, lw=0.9, color=COLOURS(0.62))
    _frame(axes, ground, body.surface, axis, position)


def density_section(figure, axes, ground, axis, position):
    """A section without a wheel, with its scale: for plates and columns. x[axis] = position [m]."""
    norm = Normalize(0.9 * ground.undisturbed, render.round_up(float(ground.density.max())))
    image, extent = _nearest(ground, axis, position)
    axes.imshow(image, origin="lower", extent=[CENTIMETRE * e for e in extent], cmap=COLOURS, norm=norm, interpolation="nearest")
    _frame(axes, ground, None, axis, position)
    figure.colorbar(ScalarMappable(norm, COLOURS), ax=axes, shrink=0.7, extend="min").set_label("density [kg/m³]")


def draw(folder, title, numbers, target, pixels=1400, dpi=150):
    """Draws the ground at the end of the run in folder. @return densities; @raises ResultsError when it kept no ground"""
    use_style()
    ground = Ground.read(folder)
    body = Body(folder, ground)
    values = densities(ground, body)
    norm = Normalize(0.9 * ground.undisturbed, render.round_up(float(np.percentile(ground.density, 99.5))))
    axle, behind = body.centre[0], body.centre[0] + rut_place(ground, body)

    figure = plt.figure(figsize=(11, 12.6), layout="constrained")
    grid = figure.add_gridspec(4, 2, height_ratios=[1.75, 1, 1, 1])
    view = render.View.of_angles(-112.0, 30.0)
    oblique = figure.add_subplot(grid[0, :])
    radius = 0.62 * np.cbrt(ground.volume * ground.density / ground.undisturbed)
    width = np.abs(view.right) @ np.ptp(ground.x, axis=0)
    picture, extent = render.shaded_picture(ground.x, radius, COLOURS(norm(ground.density))[:, :3], body.surface, view, width / pixels)
    oblique.imshow(picture, extent=[CENTIMETRE * e for e in extent], interpolation="antialiased")
    oblique.set_axis_off()
    bar = figure.colorbar(ScalarMappable(norm, COLOURS), ax=oblique, extend="both", fraction=0.03, pad=0.01, shrink=0.8, panchor=False)
    bar.set_label("density [kg/m³]")
    annotate_panel(oblique, "a", "from behind; particles")

    lengthwise, tracks = figure.add_subplot(grid[1, :]), figure.add_subplot(grid[2, :])
    under, rut = figure.add_subplot(grid[3, 0]), figure.add_subplot(grid[3, 1])
    middle = body.centre[1] + 0.5 * ground.spacing
    _section(lengthwise, ground, body, norm, 1, middle)
    annotate_panel(lengthwise, "b", "lengthwise through the middle; dashed: surface before")
    _tracers(tracks, ground, body, 1, middle)
    annotate_panel(tracks, "c", "tracers of the same plane that stood on vertical lines; grey: from where they stood")
    _section(under, ground, body, norm, 0, axle)
    annotate_panel(under, "d", f"across, under the axle: {values['under the wheel']:.0f} kg/m³ in the middle")
    _section(rut, ground, body, norm, 0, behind)
    annotate_panel(rut, "e", f"across, {CENTIMETRE * (axle - behind):.0f} cm behind: shoulder {values['at the shoulder']:.0f} kg/m³")
    figure.suptitle("\n".join(line for line in (title, f"{len(ground.x)} particles (mirrored), {ground.undisturbed:.0f} kg/m³ before", numbers) if line))
    save(figure, target, dpi)
    return values
