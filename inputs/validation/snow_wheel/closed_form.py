# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid wheel on the field's snow where that is only compressed, by integrals along its rim.

A column of snow under the rim at depth z has the density rho_0 h/(h - z) (h: depth of the snow),
and presses with the axial stress p of the compaction curve. With the front half alone, from the
first touch to the lowest point, and width b,
    W = b int p dx,   c = b int p dz / W:
the work of compaction in a metre of track, over the load.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import snow
from scipy.integrate import trapezoid
from scipy.optimize import brentq

from furrow_post.arrays import Floats

POINTS = 4000  # along the rim


class Rigid(NamedTuple):
    sinkage: float  # [m]
    resistance: float  # coefficient c


def axial_stress(density: Floats) -> Floats:
    """[Pa] of the field's snow in confined compression; straight in ln p between its points."""
    densities = [*snow.IDENTIFIED_DENSITIES, *snow.FINAL_DENSITIES]
    logs = np.log([*snow.FIELD_SNOW, *snow.FINAL_DENSITIES.values()])
    start, first = snow.START
    stress: Floats = np.exp(np.interp(density, [start, *densities], [np.log(first), *logs]))
    return stress


def rigid(
    diameter: float,
    width: float,
    depth: float,
    density: float,
    load: float,
    stress: Callable[[Floats], Floats] = axial_stress,
) -> Rigid:
    """Lengths [m], density [kg/m3] at the start, load [N]; stress [Pa] over density."""
    radius = 0.5 * diameter

    def bearing(sinkage: float) -> tuple[float, float]:
        """Load [N], and work in a metre of track [N]."""
        z = np.linspace(0.0, sinkage, POINTS)
        x = -np.sqrt(np.maximum(radius**2 - (radius - sinkage + z) ** 2, 0.0))
        pressure = stress(density * depth / (depth - z))
        return width * trapezoid(pressure, x), width * trapezoid(pressure, z)

    deepest = depth * (1 - density / max(snow.FINAL_DENSITIES))
    sinkage = brentq(lambda z: bearing(z)[0] - load, 0.05 * depth, deepest)
    found, work = bearing(sinkage)
    return Rigid(float(sinkage), float(work / found))
