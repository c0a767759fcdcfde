# SPDX-License-Identifier: GPL-2.0-or-later
"""How far continuum terrain was moved where a wheel has passed: tracers of [Shoop2001] Figs 65 and
66 as numbers."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Booleans, Floats
from ..read.terrain import Outline, Terrain
from .rut import UNDER, rut_place

FAR = 0.10  # [m] from the wheel's side: the second place beside the track


@dataclass(frozen=True)
class Displacements:
    """Mean displacements of particles that stood where the finished rut is [m]; NaN where there is none.

    surface, middle: the upper layer of particles and the one at half of the depth, in the middle
    half of the wheel's width; aside, raised: greatest over the layers, of the particles that stood
    next to the wheel's side; aside_far: of those that stood FAR from it. Outward and upward are
    positive.
    """

    surface_down: float
    surface_forward: float
    middle_down: float
    middle_forward: float
    aside: float
    aside_far: float
    raised: float

    def report(self) -> str:
        """Lines for a person."""
        centimetres = {name: f"{100 * value:.1f}" for name, value in vars(self).items()}
        return "\n".join(
            [
                "Displacement where the finished rut is, cm",
                "  surface of the track        {surface_down} down, {surface_forward} forward",
                "  at half of the depth        {middle_down} down, {middle_forward} forward",
                "  beside the wheel            {aside} outwards, {raised} up at most",
                f"  {100 * FAR:.0f} cm from its side         {{aside_far}} outwards at most",
            ]
        ).format(**centimetres)


def displacements(terrain: Terrain, body: Outline) -> Displacements:
    before = terrain.initial_position
    moved = terrain.x - before
    section = np.abs(before[:, 0] - body.centre[0] - rut_place(terrain, body)) < UNDER
    y = before[:, 1] - body.centre[1]
    track = section & (np.abs(y) < 0.5 * body.half_width)
    levels = terrain.levels(section)
    if len(levels) == 0:
        return Displacements(*[np.nan] * 7)
    half_depth = levels[np.abs(levels - 0.5 * terrain.level).argmin()]
    surface, middle = (track & terrain.at_level(z) for z in (levels[-1], half_depth))
    outward, up = moved[:, 1] * np.sign(y), moved[:, 2]

    def greatest(field: Floats, distance: float) -> float:
        """Greatest displacement of the layers in a column one particle wide, at a distance from the wheel's side [m]."""
        off = np.abs(y) - body.half_width - distance
        column = section & (off > 0) & (off < terrain.spacing)
        means = [_mean(field, column & terrain.at_level(level)) for level in levels]
        known = [value for value in means if np.isfinite(value)]
        return max(known) if known else np.nan

    return Displacements(
        -_mean(up, surface),
        _mean(moved[:, 0], surface),
        -_mean(up, middle),
        _mean(moved[:, 0], middle),
        greatest(outward, 0.0),
        greatest(outward, FAR),
        greatest(up, 0.0),
    )


def _mean(values: Floats, chosen: Booleans) -> float:
    return float(values[chosen].mean()) if chosen.any() else np.nan
