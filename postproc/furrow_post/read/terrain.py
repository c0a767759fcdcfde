# SPDX-License-Identifier: GPL-2.0-or-later
"""Reading terrain.h5: the continuum at the end of a run, particle by particle, and its history."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Booleans, Fields, Floats, Integers
from ..errors import ResultsError
from .hdf5 import opened
from .results import HISTORY, MIRROR, Surface, read_surface, require_layout, require_same_run

FILE = "terrain.h5"
OLD_FILE = "ground.h5"  # its name in an older Furrow
ON_SYMMETRY = 1e-6  # of a body's width: as far beyond y = 0 its half may reach


def is_half(x: Floats) -> bool:
    """True where particles (n, 3) stand on one side of y = 0 alone."""
    return bool(x[:, 1].min() > 0)


def terrain_file(folder: Path) -> Path:
    """terrain.h5 of a results folder, which may not be there.

    @raises ResultsError where only the file of an older Furrow is
    """
    path = folder / FILE
    if not path.is_file() and (folder / OLD_FILE).is_file():
        with opened(folder / OLD_FILE) as content:
            require_layout(content, folder / OLD_FILE)
    return path


def read_terrain_fields(folder: Path) -> Fields:
    """Field of /terrain -> its values, the first axis over the particles, at the end of a run.

    Fields: x, initial_position (n, 3) [m], density [kg/m3], volume [m3], compaction
    (ln(rho/rho_0)), pressure, mises, vertical_stress [Pa], plastic_strain. @raises ResultsError
    """
    return _group(folder, "terrain", "has no terrain at the end of a run")


def read_terrain_history(folder: Path) -> Fields:
    """Channel of /history in terrain.h5 -> its values (energies [J] over time [s])."""
    return _group(folder, "history", "has no history")


def _group(folder: Path, name: str, lacking: str) -> Fields:
    """Datasets of a group of terrain.h5. @raises ResultsError"""
    path = terrain_file(folder)
    remedy = "give the folder of a run with fix terrain/history that came to its end"
    if not path.is_file():
        raise ResultsError(f"{path}: {lacking} (no such file); {remedy}")
    require_same_run(path, folder / HISTORY)
    with opened(path) as content:
        require_layout(content, path)
        if name not in content:
            raise ResultsError(f"{path}: {lacking}; {remedy}")
        return Fields(path, {key: data[()] for key, data in content[name].items()}, remedy)


@dataclass
class Terrain:
    """Particles of the continuum at the end of a run; half models are mirrored."""

    x: Floats  # (n, 3) [m]
    initial_position: Floats  # (n, 3) [m]
    density: Floats  # (n) [kg/m3]
    volume: Floats  # (n) [m3]
    level: float  # z of the undisturbed surface [m]
    undisturbed: float  # its density [kg/m3]

    @classmethod
    def read(cls, folder: Path) -> "Terrain":
        """@raises ResultsError when the run kept no terrain"""
        fields = read_terrain_fields(folder)
        names = ("x", "initial_position", "density", "volume")
        fields.require_finite(*names)
        if fields.require_rows() == 0:
            raise ResultsError(f"{fields.file}: has no particles; {fields.remedy}")
        x, initial, density, volume = (fields[name] for name in names)
        mass = density * volume
        fine = mass < 1.1 * mass.min()  # cells that are fine along all three axes
        # Particles of two lengths along x may have stood in one place (fix terrain/continuum, fine_length).
        spacing = [_lattice_spacing(initial[fine, 0]), *(_lattice_spacing(initial[:, axis]) for axis in (1, 2))]
        level = float(initial[:, 2].max() + 0.5 * spacing[2])
        undisturbed = float(np.median(mass[fine]) / np.prod(spacing))
        terrain = cls(x, initial, density, volume, level, undisturbed)
        return terrain.mirrored() if is_half(initial) else terrain

    def mirrored(self) -> "Terrain":
        """Both halves of a half model, whose plane of symmetry is y = 0."""
        return Terrain(
            np.vstack([self.x, self.x * MIRROR]),
            np.vstack([self.initial_position, self.initial_position * MIRROR]),
            np.tile(self.density, 2),
            np.tile(self.volume, 2),
            self.level,
            self.undisturbed,
        )

    @property
    def spacing(self) -> float:
        """Spacing of the particles before the wheel passed, in the fine part [m]."""
        undeformed = self.volume * self.density / self.undisturbed
        return float(np.percentile(undeformed, 5) ** (1 / 3))

    def levels(self, chosen: Booleans) -> Floats:
        """Heights at which layers of the chosen particles (n) stood, from below [m]."""
        heights: Floats = np.unique(np.round(self.initial_position[chosen, 2], 6))
        return heights

    def at_level(self, level: float) -> Booleans:
        """Particles (n) of the layer that stood at a height [m]."""
        same: Booleans = np.abs(self.initial_position[:, 2] - level) < 1e-5
        return same

    def near_plane(self, axis: int, position: float) -> Booleans:
        """Particles (n) whose width the plane x[axis] = position [m] cuts, and a little more.

        @raises ResultsError where there is none
        """
        near: Booleans = np.abs(self.x[:, axis] - position) < 0.75 * self.spacing
        if not near.any():
            raise ResultsError(f"there is no terrain at {'xy'[axis]} = {position:.3f} m")
        return near

    def mean_density(self, inside: Booleans) -> float:
        """Mass over volume of the particles inside (n) [kg/m3]; NaN where there is none."""
        volume = self.volume[inside].sum()
        mass = (self.density[inside] * self.volume[inside]).sum()
        return float(mass / volume) if volume > 0 else np.nan


@dataclass
class TerrainStress:
    """Stress of the particles of a Terrain, in its order; half models are mirrored."""

    mises: Floats  # (n) q [Pa]
    principal: Floats  # (n, 3) the largest first, tension positive [Pa]
    tension_axis: Floats  # (n, 3) direction of the first
    compression_axis: Floats  # (n, 3) of the last
    plastic_strain: Floats | None = None  # (n) equivalent; None in files of an older Furrow

    @classmethod
    def read(cls, folder: Path) -> "TerrainStress":
        """@raises ResultsError when the run kept no principal stresses"""
        fields = read_terrain_fields(folder)
        names = ("mises", "principal_stress", "tension_axis", "compression_axis")
        fields.require_finite(*names)
        mises, principal, tension, compression = (fields[name] for name in names)
        plastic = fields.get("plastic_strain")
        if plastic is not None:
            fields.require_finite("plastic_strain")
        if is_half(fields["initial_position"]):
            mises, principal = np.tile(mises, 2), np.tile(principal, (2, 1))
            tension, compression = (np.vstack([a, a * MIRROR]) for a in (tension, compression))
            plastic = None if plastic is None else np.tile(plastic, 2)
        return cls(mises, principal, tension, compression, plastic)

    def tensor(self, particles: Integers) -> Floats:
        """(n, 3, 3) of some particles [Pa]."""
        first, last = self.tension_axis[particles], self.compression_axis[particles]
        axes = np.stack([first, np.cross(last, first), last], axis=2)
        stress: Floats = np.einsum("nik,nk,njk->nij", axes, self.principal[particles], axes)
        return stress


def _lattice_spacing(coordinates: Floats) -> float:
    """Spacing of the lattice on which the particles stood, in its fine part [m]."""
    places = np.unique(np.round(coordinates, 9))
    if len(places) < 2:
        raise ResultsError(f"{FILE}: terrain of a single layer of particles has no sections")
    return float(np.diff(places).min())


class Outline:
    """Place of a wheel, tyre or plate at the end, or the middle of the terrain without a body.

    surface: Surface or None, of both halves of a half model; centre (3) [m]; half_width [m], NaN
    without a body.
    """

    def __init__(self, folder: Path, terrain: Terrain) -> None:
        surface = read_surface(folder / "history.h5")
        if surface is not None and surface.x[:, 1].min() > -ON_SYMMETRY * np.ptp(surface.x[:, 1]):
            surface = Surface.together([surface, surface.mirrored()])
        self.surface: Surface | None = surface
        x = terrain.x if surface is None else surface.x
        low, high = x.min(axis=0), x.max(axis=0)
        self.centre: Floats = 0.5 * (low + high)
        self.half_width = float(np.nan if surface is None else 0.5 * (high - low)[1])
