# SPDX-License-Identifier: GPL-2.0-or-later
"""Densities and depth of the rut that a wheel leaves in continuum terrain."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Booleans, Floats
from ..read.terrain import Outline, Terrain

UNDER = 0.04  # m along the track to both sides of the axle that count as under the wheel
SHOULDER = 0.05  # m outwards of the wheel's side that count as its shoulder
TRACK = 0.12  # m along the track to both sides of the finished rut's section
BEHIND = 0.6  # of the length of terrain behind the axle: where the finished rut is cut


@dataclass(frozen=True)
class RutDensities:
    """Mean densities [kg/m3], NaN where there are no particles.

    under, in_rut: in the middle half of the width, all depths; shoulder: beside the wheel's side;
    both behind are taken at the place of the finished rut.
    """

    undisturbed: float
    under: float  # under the wheel
    greatest_under: float  # of one particle
    in_rut: float
    shoulder: float

    def named(self) -> dict[str, float]:
        """With the names that people read."""
        return {
            "undisturbed": self.undisturbed,
            "under the wheel": self.under,
            "greatest under the wheel": self.greatest_under,
            "in the rut behind": self.in_rut,
            "at the shoulder": self.shoulder,
        }

    def report(self) -> str:
        """One line per density, and how they are meant."""
        lines = [
            f"  {name:26} {value:6.0f} kg/m3" if np.isfinite(value) else f"  {name:26}    not known"
            for name, value in self.named().items()
        ]
        return "\n".join(
            [
                "Density",
                *lines,
                f"  under: {100 * UNDER:.0f} cm to both sides of the axle, middle half of the "
                f"width, all depths; shoulder: {100 * SHOULDER:.0f} cm beside the wheel",
            ]
        )


def rut_place(terrain: Terrain, body: Outline) -> float:
    """x of the section through the finished rut, from the axle [m]: negative."""
    return float(BEHIND * (terrain.x[:, 0].min() - body.centre[0]))


def rut_densities(terrain: Terrain, body: Outline) -> RutDensities:
    x = terrain.x[:, 0] - body.centre[0]
    y = np.abs(terrain.x[:, 1] - body.centre[1])
    behind = _at(x - rut_place(terrain, body))
    middle = y < 0.5 * body.half_width
    shoulder = (y > body.half_width) & (y < body.half_width + SHOULDER)
    under = (np.abs(x) < UNDER) & middle
    return RutDensities(
        terrain.undisturbed,
        terrain.mean_density(under),
        float(terrain.density[under].max()) if under.any() else np.nan,
        terrain.mean_density(behind & middle),
        terrain.mean_density(behind & shoulder),
    )


def rut_depth(terrain: Terrain, body: Outline) -> float:
    """From the surface before to the highest particles of the finished rut [m].

    In the middle half of the wheel's width.
    """
    x = terrain.x[:, 0] - body.centre[0] - rut_place(terrain, body)
    inside = _at(x) & (np.abs(terrain.x[:, 1]) < 0.5 * body.half_width)
    return float(terrain.level - _tops(terrain, inside).max())


def _at(distance: Floats) -> Booleans:
    """Particles (n) at a section across the track, with long cells those that are nearest."""
    near: Booleans = np.abs(distance) < max(UNDER, 1.2 * float(np.abs(distance).min()))
    return near


def bow_wave(terrain: Terrain, body: Outline) -> float:
    """Height to which the surface ahead of the axle has risen [m]."""
    ahead = terrain.x[:, 0] > body.centre[0]
    return max(float(_tops(terrain, ahead).max() - terrain.level), 0.0) if ahead.any() else 0.0


def share_left(terrain: Terrain, body: Outline) -> float:
    """Mass in the finished rut over what was there before: what has not been pushed aside.

    Weights fall from the middle of the section to none at TRACK along the track, and from half of
    the wheel's half width to none at its side, so that single particles do not count.
    """
    place, half = body.centre[0] + rut_place(terrain, body), body.half_width
    mass = terrain.density * terrain.volume

    def weighed(position: Floats) -> float:
        along = 1 - np.abs(position[:, 0] - place) / TRACK
        across = 2 - 2 * np.abs(position[:, 1] - body.centre[1]) / half
        return float((mass * np.clip(along, 0, None) * np.clip(across, 0, 1)).sum())

    before = weighed(terrain.initial_position)
    return weighed(terrain.x) / before if before > 0 else float(np.nan)


def _tops(terrain: Terrain, inside: Booleans) -> Floats:
    """z of the upper sides of particles [m]."""
    squeeze = terrain.undisturbed / terrain.density[inside]
    tops: Floats = terrain.x[inside, 2] + 0.5 * terrain.spacing * squeeze
    return tops
