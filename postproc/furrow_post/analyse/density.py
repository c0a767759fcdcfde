# SPDX-License-Identifier: GPL-2.0-or-later
"""Density of the ground around a wheel on a regular grid, from grains or continuum particles.

Coordinates are those of the wheel: x from the axle along the travel, y from its middle plane, z
from the undisturbed ground. Grains: the volume of spheres per cell, smoothed over a grain (a
Gaussian of half a diameter, cut at two), times the density of the grains' substance; so the surface
is blurred over about a grain. Continuum: mean of the particles in a cell, weighted by volume.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter

from ..arrays import Floats
from ..read.terrain import read_terrain_fields
from ..read.wheel_run import WheelRun

CELL = 0.01  # [m] of a section
Interval = tuple[float, float]  # low, high [m]


@dataclass
class Section:
    """Density (rows up, columns along) [kg/m3], NaN where no ground is; edges of its cells [m]."""

    density: Floats
    across_edges: Floats
    z_edges: Floats

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom, top [m]."""
        across, z = self.across_edges, self.z_edges
        return float(across[0]), float(across[-1]), float(z[0]), float(z[-1])


@dataclass
class GroundPoints:
    """Points that stand for the ground, grains or particles."""

    x: Floats  # (n, 3) in the wheel's coordinates [m]
    mass: Floats  # (n) [kg]
    volume: Floats  # (n) [m3]
    size: Floats  # (n) diameter or edge [m]
    grains: bool


def _points_in_sphere() -> Floats:
    """(48, 3) points that stand for the volume of the unit sphere: directions on four shells."""
    shells = [((2 * k + 1) / 8) ** (1 / 3) for k in range(4)]  # of equal volume
    golden = np.pi * (3 - np.sqrt(5))
    heights = (np.arange(12) + 0.5) / 6 - 1
    turns, across = golden * np.arange(12), np.sqrt(1 - heights**2)
    directions = np.column_stack([across * np.cos(turns), across * np.sin(turns), heights])
    return np.concatenate([shell * directions for shell in shells])


_IN_SPHERE = _points_in_sphere()
_THIRDS = [-1 / 3, 0.0, 1 / 3]
_IN_CUBE = np.stack(np.meshgrid(_THIRDS, _THIRDS, _THIRDS), axis=-1).reshape(-1, 3)


def ground_points(run: WheelRun) -> GroundPoints:
    """The ground at the end of a run. @raises ResultsError where it was not kept"""
    columns = run.results.columns
    origin = np.array([columns["x"][-1], columns["y"][-1], run.ground_level])
    if run.ground == "continuum":
        fields = read_terrain_fields(run.folder)
        x, density, volume = (fields[name] for name in ("x", "density", "volume"))
        if run.half:  # mirrored at the plane of symmetry
            x = np.concatenate([x, x * [1, -1, 1]])
            density, volume = np.tile(density, 2), np.tile(volume, 2)
        return GroundPoints(x - origin, density * volume, volume, np.cbrt(volume), False)
    grains, reference = run.results.grains("final"), run.results.grains("reference")
    volume = 4 / 3 * np.pi * grains.radius**3
    solid = np.sum(reference.volume_above(run.floor))
    low, high = reference.corners
    space = (high - low)[0] * (high - low)[1] * (run.number("depth") - run.below)
    # without a bulk density: density over that at the start
    substance = (run.number("density") if "density" in run.conditions else 1.0) * space / solid
    x = grains.nearest_image(grains.x - origin)
    return GroundPoints(x, substance * volume, volume, 2 * grains.radius, True)


def _blurred(image: Floats, reach: float) -> Floats:
    """Gaussian of reach cells along both axes, nothing beyond the edges."""
    blurred: Floats = gaussian_filter(image, max(reach, 1e-9), mode="constant")
    return blurred


def section(ground: GroundPoints, along: int, slab: Interval, across: Interval, z: Interval, cell: float) -> Section:
    """Density over the plane (along, z), mean over the slab of the third axis.

    along: 0 or 1; cell: edge of the picture's cells [m].
    """
    across_edges, z_edges = (np.arange(low, high + 0.5 * cell, cell) for low, high in (across, z))
    area = cell * cell * (slab[1] - slab[0])
    place = ground.x[:, 1 - along]
    inside = (place > slab[0] - ground.size) & (place < slab[1] + ground.size)
    size = ground.size[inside]
    offsets = 0.5 * _IN_SPHERE if ground.grains else _IN_CUBE
    points = (ground.x[inside, None, :] + size[:, None, None] * offsets).reshape(-1, 3)
    kept = (points[:, 1 - along] > slab[0]) & (points[:, 1 - along] < slab[1])
    edges: Any = (z_edges, across_edges)  # numpy's type hints know no edges of each axis

    def blurred(weight: Floats, reach: float) -> Floats:
        """Sums of what the points carry in each cell, smoothed over so many cells."""
        weights = np.repeat(weight[inside] / len(offsets), len(offsets))[kept]
        return _blurred(np.histogram2d(points[kept, 2], points[kept, along], edges, weights=weights)[0], reach)

    if ground.grains:
        reach = 0.5 * float(np.mean(size)) / cell
        smooth, solid = (blurred(weight, reach) for weight in (ground.mass, ground.volume))
        room = _blurred(np.ones_like(solid), reach) * area  # area inside the picture and above the floor
        solid = solid / room
        typical = np.median(solid[solid > 0.05]) if (solid > 0.05).any() else 1.0
        return Section(np.where(solid > 0.45 * typical, smooth / room, np.nan), across_edges, z_edges)
    # A little smoothing: the particles' cubes overlap and leave gaps where the ground is sheared.
    reach = 0.35 * float(np.mean(size)) / cell
    mass, volume = (blurred(weight, reach) for weight in (ground.mass, ground.volume))
    with np.errstate(invalid="ignore", divide="ignore"):
        return Section(np.where(volume > 0.45 * area, mass / volume, np.nan), across_edges, z_edges)


def sections(run: WheelRun) -> tuple[Section, Section]:
    """Lengthwise in the wheel's middle plane, and across in the track behind the wheel.

    The window is the same for every run of a wheel.
    """
    ground = ground_points(run)
    radius, width, depth = run.radius, run.number("wheel_width"), run.number("depth")
    z = (-depth, 0.4 * depth)
    middle = (-0.25 * width, 0.25 * width)
    lengthwise = section(ground, 0, middle, (-1.7 * radius, 1.4 * radius), z, CELL)
    behind = (-1.3 * radius, -0.6 * radius)
    across = section(ground, 1, behind, (-1.4 * width, 1.4 * width), z, CELL)
    return lengthwise, across


def height_left(run: WheelRun) -> float:
    """Height of the ground left under the wheel [m].

    A tyre's hub drop counts to its unloaded tread: there the lowest point of the tread at the end is
    taken.
    """
    depth = run.number("depth")
    surface = run.results.surface() if run.deformable else None
    if surface is not None:
        return float(surface.x[:, 2].min()) - (run.ground_level - depth)
    return depth - run.values["hub_drop"].mean


def track_density(run: WheelRun) -> tuple[float, float]:
    """Density under the track behind the wheel [kg/m3], and the standard error of four stretches.

    Mass on the middle half of the track over the height left under the wheel: the same definition
    for grains and continuum, without any smoothing.
    """
    ground = ground_points(run)
    radius, width = run.radius, run.number("wheel_width")
    left, bottom = height_left(run), run.floor - run.ground_level
    stations = np.linspace(-1.3 * radius, -0.6 * radius, 5)
    x, y, size = ground.x[:, 0], ground.x[:, 1], ground.size
    beside = np.abs(y) < 0.25 * width + size
    near = np.flatnonzero((x > stations[0] - size) & (x < stations[-1] + size) & beside)
    reach = 0.5 * size[near, None, None] * _IN_SPHERE
    along, across, z = (ground.x[near, None, :] + reach).reshape(-1, 3).T
    mass = np.repeat(ground.mass[near] / len(_IN_SPHERE), len(_IN_SPHERE))
    inside = (np.abs(across) < 0.25 * width) & (z > bottom)
    sums, _ = np.histogram(along[inside], stations, weights=mass[inside])
    parts = sums / (np.diff(stations) * 0.5 * width * left)
    return float(np.mean(parts)), float(np.std(parts, ddof=1) / np.sqrt(len(parts)))
