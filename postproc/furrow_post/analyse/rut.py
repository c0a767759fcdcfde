# SPDX-License-Identifier: GPL-2.0-or-later
"""Densities and depth of the rut that a wheel leaves in continuum terrain."""

from dataclasses import dataclass

import numpy as np

from ..read.terrain import Outline, Terrain

UNDER = 0.04  # m along the track to both sides of the axle that count as under the wheel
SHOULDER = 0.05  # m outwards of the wheel's side that count as its shoulder
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
    behind = np.abs(x - rut_place(terrain, body)) < UNDER
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
    inside = (np.abs(x) < UNDER) & (np.abs(terrain.x[:, 1]) < 0.5 * body.half_width)
    squeeze = terrain.undisturbed / terrain.density[inside]
    tops = terrain.x[inside, 2] + 0.5 * terrain.spacing * squeeze
    return float(terrain.level - tops.max())
