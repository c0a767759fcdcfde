# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress in continuum terrain around a wheel: principal stresses of a plane, the arc ahead."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats
from ..read.terrain import Outline, Terrain, TerrainStress

LEVELS = 12  # of the arc, from the wheel's lowest point to the base
SHARE = 0.1  # of the greatest q: an arc of less is none


@dataclass(frozen=True)
class Arc:
    """Places of the greatest deviatoric stress q ahead of the axle, level by level.

    x, z: places [m]; q: greatest on the arc [Pa]; ahead: x of that place from the axle [m].
    """

    x: Floats
    z: Floats
    q: float
    ahead: float

    def text(self) -> str:
        if len(self.x) == 0:
            return "no arc: there is no ground below and ahead of the wheel"
        return f"{self.q / 1e3:.3g} kPa {100 * self.ahead:.1f} cm ahead of the axle"


def in_plane(tensor: Floats, along: int) -> tuple[Floats, Floats]:
    """Principal values (n, 2) [Pa], and directions (n, 2, 2) as columns, of stresses (n, 3, 3).

    Both are those of the part in the upright plane along an axis, 0 or 1.
    """
    plane = tensor[:, [along, 2]][:, :, [along, 2]]
    values, directions = np.linalg.eigh(plane)
    return values, directions


def arc_ahead(terrain: Terrain, stress: TerrainStress, body: Outline) -> Arc:
    """Arc in the middle plane of the body, from its lowest point down to the base."""
    x = terrain.x[:, 0] - body.centre[0]
    near = np.abs(terrain.x[:, 1] - body.centre[1]) < terrain.spacing
    ahead = near & (x > 0)
    lowest = terrain.level if body.surface is None else float(body.surface.x[:, 2].min())
    below = ahead & (terrain.x[:, 2] < lowest)
    if not below.any():
        return Arc(np.empty(0), np.empty(0), 0.0, np.nan)
    edges = np.linspace(float(terrain.x[below, 2].min()), lowest, LEVELS + 1)
    level = np.digitize(terrain.x[:, 2], edges)
    layers = (np.flatnonzero(below & (level == number)) for number in range(1, LEVELS + 1))
    places = [layer[stress.mises[layer].argmax()] for layer in layers if len(layer)]
    places = [at for at in places if stress.mises[at] > SHARE * stress.mises[near].max()]
    if not places:
        return Arc(np.empty(0), np.empty(0), 0.0, np.nan)
    top = places[int(stress.mises[places].argmax())]
    return Arc(terrain.x[places, 0], terrain.x[places, 2], float(stress.mises[top]), float(x[top]))
