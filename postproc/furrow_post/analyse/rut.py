# SPDX-License-Identifier: GPL-2.0-or-later
"""Densities, depth and displacements of the rut that a wheel leaves in continuum terrain.

Displacements are the tracers of [Shoop2001] Figs 65 and 66 as numbers.
"""

from dataclasses import dataclass

import numpy as np

from ..arrays import Booleans, Floats
from ..read.terrain import Outline, Terrain

UNDER = 0.04  # m along the track to both sides of the axle that count as under the wheel
SHOULDER = 0.05  # m outwards of the wheel's side that count as its shoulder
TRACK = 0.12  # m along the track to both sides of the finished rut's section
FAR = 0.10  # m from the wheel's side: the second place beside the track
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

    def report(self) -> str:
        """Report: one line per density, and its definition."""
        names = ("undisturbed", "under the wheel", "greatest under the wheel", "in the rut behind", "at the shoulder")
        texts = (f"{value:6.0f} kg/m3" if np.isfinite(value) else "   not known" for value in vars(self).values())
        meaning = (
            f"  under: {100 * UNDER:.0f} cm to both sides of the axle, middle half of the "
            f"width, all depths; shoulder: {100 * SHOULDER:.0f} cm beside the wheel"
        )
        return "\n".join(["Density", *(f"  {name:26} {text}" for name, text in zip(names, texts)), meaning])


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
    """Depth from the initial surface to the highest particles of the finished rut [m].

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
        """Lines of the printed report."""
        down = "  surface of the track        {surface_down} down, {surface_forward} forward\n"
        half = "  at half of the depth        {middle_down} down, {middle_forward} forward\n"
        beside = "  beside the wheel            {aside} outwards, {raised} up at most\n"
        far = f"  {100 * FAR:.0f} cm from its side         {{aside_far}} outwards at most"
        centimetres = {name: f"{100 * value:.1f}" for name, value in vars(self).items()}
        return "Displacement where the finished rut is, cm\n" + (down + half + beside + far).format(**centimetres)


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
        return max((value for value in means if np.isfinite(value)), default=np.nan)

    track_means = [_mean(field, layer) for layer in (surface, middle) for field in (-up, moved[:, 0])]
    beside = [greatest(outward, 0.0), greatest(outward, FAR), greatest(up, 0.0)]
    return Displacements(*track_means, *beside)


def _mean(values: Floats, chosen: Booleans) -> float:
    return float(values[chosen].mean()) if chosen.any() else np.nan
