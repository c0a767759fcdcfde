# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid wheel on snow that is only compressed: what the columns of snow below its rim carry.

A column of snow of height h below a cylinder of radius r that has sunk by z is compressed by
  w(x) = z - (r - sqrt(r^2 - x^2)),  eps = -ln(1 - w/h),
and presses back with the oedometer's axial stress sigma(eps). The wheel carries b times the integral of sigma over its
contact: a rolling one over the front half, since the snow stays compressed behind it, a standing one over both. The
work in a metre of track is b times the integral of sigma dw from 0 to z.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from ..arrays import Floats

POINTS = 2001  # along half of the contact


@dataclass(frozen=True)
class CompressedSnow:
    """A wheel and its snow, lengths in m. stress: axial stress [Pa] over the strain in confined compression."""

    radius: float
    width: float
    depth: float
    stress: Callable[[Floats], Floats]

    def contact(self, sinkage: float) -> float:
        """Half of the length of the contact [m]."""
        return float(np.sqrt(2 * self.radius * sinkage - sinkage**2))

    def carried(self, sinkage: float, sides: int = 1) -> float:
        """Load [N] over one side of the axle, rolling, or both, standing."""
        x = np.linspace(0, self.contact(sinkage), POINTS)
        w = sinkage - (self.radius - np.sqrt(self.radius**2 - x**2))
        stress = self.stress(-np.log1p(-np.maximum(w, 0.0) / self.depth))
        return float(sides * self.width * np.trapz(stress, x))

    def work(self, sinkage: float) -> float:
        """[N] of compression in a metre of track."""
        w = np.linspace(0, sinkage, POINTS)
        return float(self.width * np.trapz(self.stress(-np.log1p(-w / self.depth)), w))

    def sinkage(self, load: float, sides: int = 1, shear: float = 0.0) -> float:
        """[m] that carries a load [N]. shear: further stress [Pa] over the area of the contact."""

        def excess(z: float) -> float:
            return self.carried(z, sides) + sides * self.width * self.contact(z) * shear - load

        return float(brentq(excess, 1e-4, 0.78 * self.depth))


def cam_clay_confined(slope: float, tension_ratio: float) -> tuple[float, float]:
    """K0, and p0 over the axial stress, of cohesive Cam clay with slope M in confined compression: closed form of
    src/material/models/cohesive_cam_clay."""
    ratio = slope / np.sqrt(1 + 2 * tension_ratio)
    root = np.sqrt(9 + 4 * ratio**2)
    centre, half = (1 - tension_ratio) / 2, (1 + tension_ratio) / 2  # of the ellipse, over p0
    p, q = centre + 3 * half / root, 2 * ratio**2 * half / root
    axial = p + 2 * q / 3
    return float((p - q / 3) / axial), round(float(1 / axial), 3)


def cam_clay_material(
    title: str, density: float, slope: float, tension_ratio: float, curve: Sequence[tuple[float, float]], elasticity: str
) -> str:
    """A material file of cohesive Cam clay that follows a curve: densities [kg/m3] and axial stresses [Pa] in confined
    compression. The first pair is taken as it is: its stress is p."""
    share = cam_clay_confined(slope, tension_ratio)[1]
    rows = [curve[0], *((rho, share * stress) for rho, stress in curve[1:])]
    columns = {"rho": [f"{rho:g}" for rho, _ in rows], "p": [f"{p:.6g}" for _, p in rows]}
    law = f"law: {{type: cohesive_cam_clay, density: {density:g}, M: {slope:g}, tension_ratio: {tension_ratio:g}}}"
    lines = [f"title: {title}", law, f"elasticity: {elasticity}", "hardening:", "  type: by_density"]
    lines += [f"  {name}: [{', '.join(cells)}]" for name, cells in columns.items()]
    return "\n".join([*lines, "  interpolation: log", "  beyond: extrapolate", ""])
