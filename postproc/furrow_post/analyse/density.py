# SPDX-License-Identifier: GPL-2.0-or-later
"""Density of the ground around a wheel, on a regular grid, from grains or from the particles of continuum ground.

Coordinates are those of the wheel: x from the axle along the travel, y from its middle plane, z from the undisturbed ground. Grains: the
volume of spheres per cell, smoothed over a grain (a Gaussian of half a diameter, cut at two), times the density of the grains' substance; so
the surface is blurred over about a grain. Continuum: mean of the particles in a cell, weighted by volume.
"""

from dataclasses import dataclass

import h5py
import numpy as np


@dataclass
class Section:
    """density (rows up, columns along) [kg/m3], NaN where there is no ground; edges [m] of its cells."""

    density: np.ndarray
    across_edges: np.ndarray
    z_edges: np.ndarray

    @property
    def extent(self):
        return (self.across_edges[0], self.across_edges[-1], self.z_edges[0], self.z_edges[-1])


@dataclass
class Ground:
    """Points that stand for ground: x (n, 3) in the wheel's coordinates [m], mass [kg], volume [m3], size [m] of each."""

    x: np.ndarray
    mass: np.ndarray
    volume: np.ndarray
    size: np.ndarray
    grains: bool


# directions of equal-volume shells: points that stand for a sphere's volume
_SHELLS = [((2 * k + 1) / 8) ** (1 / 3) for k in range(4)]
_GOLDEN = np.pi * (3 - np.sqrt(5))
_DIRECTIONS = np.array([(np.sqrt(1 - u * u) * np.cos(k * _GOLDEN), np.sqrt(1 - u * u) * np.sin(k * _GOLDEN), u)
                        for k, u in enumerate((np.arange(12) + 0.5) / 6 - 1)])
_IN_SPHERE = np.concatenate([s * _DIRECTIONS for s in _SHELLS])  # (48, 3), unit sphere


def ground_of(run):
    """Ground at the end of a WheelRun."""
    columns = run.results.columns
    origin = np.array([columns["x"][-1], columns["y"][-1], run.ground_level])
    if run.ground == "continuum":
        with h5py.File(run.folder / "ground.h5", "r") as content:
            x, density, volume = (content[f"ground/{name}"][()] for name in ("x", "density", "volume"))
        if run.half:  # mirrored at the plane of symmetry
            x = np.concatenate([x, x * [1, -1, 1]])
            density, volume = np.tile(density, 2), np.tile(volume, 2)
        return Ground(x - origin, density * volume, volume, np.cbrt(volume), False)
    grains = run.results.grains("final")
    volume = 4 / 3 * np.pi * grains.radius**3
    reference = run.results.grains("reference")
    bulk = run.conditions.get("density")
    solid = np.sum(4 / 3 * np.pi * reference.radius**3)
    low, high = (reference.x - reference.radius[:, None]).min(axis=0), (reference.x + reference.radius[:, None]).max(axis=0)
    space = (high - low)[0] * (high - low)[1] * run.conditions["depth"].value
    substance = bulk.value * space / solid if bulk else space / solid  # without it: density over that at the start
    return Ground(grains.x - origin, substance * volume, volume, 2 * grains.radius, True)


def _blur(image, reach):
    """Gaussian of reach cells along both axes, nothing beyond the edges."""
    n = int(np.ceil(4 * reach))
    kernel = np.exp(-0.5 * (np.arange(-n, n + 1) / max(reach, 1e-9)) ** 2)
    kernel /= kernel.sum()
    for axis in (0, 1):
        image = np.apply_along_axis(lambda line: np.convolve(line, kernel, "same") if len(line) >= len(kernel) else
                                    np.convolve(line, kernel, "full")[n:n + len(line)], axis, image)
    return image


def section(ground, along, slab_axis, slab, across, z, cell):
    """Density over the plane (along, z), mean over the slab of the third axis.

    along, slab_axis: 0 or 1; slab, across, z: (low, high) [m]; cell [m]
    """
    edges = [np.arange(low, high + 0.5 * cell, cell) for low, high in (across, z)]
    area = cell * cell * (slab[1] - slab[0])
    inside = (ground.x[:, slab_axis] > slab[0] - ground.size) & (ground.x[:, slab_axis] < slab[1] + ground.size)
    x, mass, volume, size = ground.x[inside], ground.mass[inside], ground.volume[inside], ground.size[inside]
    if ground.grains:
        points = (x[:, None, :] + 0.5 * size[:, None, None] * _IN_SPHERE).reshape(-1, 3)
        share = len(_IN_SPHERE)
    else:  # a cube of 3 x 3 x 3 points for a particle
        offsets = np.stack(np.meshgrid(*[[-1 / 3, 0, 1 / 3]] * 3), axis=-1).reshape(-1, 3)
        points = (x[:, None, :] + size[:, None, None] * offsets).reshape(-1, 3)
        share = len(offsets)
    kept = (points[:, slab_axis] > slab[0]) & (points[:, slab_axis] < slab[1])
    sums = [np.histogram2d(points[kept, 2], points[kept, along], (edges[1], edges[0]), weights=np.repeat(w / share, share)[kept])[0]
            for w in (mass, volume)]
    if ground.grains:
        reach = 0.5 * float(np.mean(size)) / cell
        room = _blur(np.ones_like(sums[0]), reach)  # what the edges of the picture (and the floor) cut off
        smooth, solid = _blur(sums[0], reach) / room / area, _blur(sums[1], reach) / room / area
        typical = np.median(solid[solid > 0.05]) if (solid > 0.05).any() else 1.0
        return Section(np.where(solid > 0.45 * typical, smooth, np.nan), *edges)
    # A little smoothing: the particles' cubes overlap and leave gaps where the ground is sheared.
    mass_in, volume_in = (_blur(total, 0.35 * float(np.mean(size)) / cell) for total in sums)
    with np.errstate(invalid="ignore", divide="ignore"):
        return Section(np.where(volume_in > 0.45 * area, mass_in / volume_in, np.nan), *edges)


def sections(run, cell=0.01):
    """(lengthwise in the wheel's middle plane, across in the track behind the wheel) of a WheelRun, same window for every run of a wheel."""
    ground = ground_of(run)
    radius, width = run.radius, run.conditions["wheel_width"].value
    depth = run.conditions["depth"].value
    z = (-depth, 0.4 * depth)
    lengthwise = section(ground, 0, 1, (-0.25 * width, 0.25 * width), (-1.7 * radius, 1.4 * radius), z, cell)
    across = section(ground, 1, 0, (-1.3 * radius, -0.6 * radius), (-1.4 * width, 1.4 * width), z, cell)
    return lengthwise, across


def height_left(run):
    """Of ground under the wheel [m]. A tyre's sinkage counts to its unloaded tread: there the tread's lowest point at the end is taken."""
    depth = run.conditions["depth"].value
    if run.wheel == "tyre":
        return float(run.results.surface()[1][:, 2].min()) - (run.ground_level - depth)
    return depth - run.values["sinkage"].mean


def track_density(run):
    """Mass on the middle half of the track behind the wheel over the height left under the wheel [kg/m3], and the standard error of
    four stretches of the track: the same definition for grains and continuum, without any smoothing."""
    ground = ground_of(run)
    radius, width = run.radius, run.conditions["wheel_width"].value
    left = height_left(run)
    parts = []
    stations = np.linspace(-1.3 * radius, -0.6 * radius, 5)
    for low, high in zip(stations[:-1], stations[1:]):
        beside = ground.x[:, 0] > high + ground.size, ground.x[:, 0] < low - ground.size
        near = np.flatnonzero(~(beside[0] | beside[1]) & (np.abs(ground.x[:, 1]) < 0.25 * width + ground.size))
        points = (ground.x[near, None, :] + 0.5 * ground.size[near, None, None] * _IN_SPHERE).reshape(-1, 3)
        mass = np.repeat(ground.mass[near] / len(_IN_SPHERE), len(_IN_SPHERE))
        inside = (points[:, 0] > low) & (points[:, 0] < high) & (np.abs(points[:, 1]) < 0.25 * width)
        parts.append(mass[inside].sum() / ((high - low) * 0.5 * width * left))
    return float(np.mean(parts)), float(np.std(parts, ddof=1) / np.sqrt(len(parts)))
