# SPDX-License-Identifier: GPL-2.0-or-later
"""Vertical stress below a load on a half-space by point loads with a concentration factor.

    sigma_z = nu Q cos^(nu+2)(theta) / (2 pi z^2)

Q: vertical point load [N], z: depth [m], theta: angle from the vertical. nu = 3 is the elastic
solution [Boussinesq1885]. Larger factors concentrate the stress below the load, as O. K. Froehlich
proposed and [Soehne1953] applied to tyres: 4 for hard, 5 for medium and 6 for soft soil.
"""

import numpy as np

from ..arrays import Floats

ELASTIC = 3.0  # concentration factor of Boussinesq's solution
SOEHNE = (4.0, 5.0, 6.0)
ANGLES = 256  # of the midpoint rule over a quarter of the ellipse: exact to rounding down to 1:20


def below_point_loads(
    depth: float, x: Floats, y: Floats, load: Floats, concentration: float
) -> float:
    """Stresses below loads (n) [N] at horizontal distances x, y (n) [m], at a depth [m]; in Pa."""
    power = 0.5 * concentration + 1.0
    squares = x * x + y * y + depth * depth
    terms = load * depth**concentration / squares**power
    return float(concentration * terms.sum() / (2 * np.pi))


def below_ellipse(depth: Floats, semi_axes: tuple[float, float], concentration: float) -> Floats:
    """Below the centre of an ellipse under uniform pressure, over this pressure.

    A sector of radius r carries 1 - (z/sqrt(z^2 + r^2))^nu of the pressure to the depth z.
    """
    a, b = semi_axes
    angle = (np.arange(ANGLES) + 0.5) * 0.5 * np.pi / ANGLES
    radius = a * b / np.hypot(b * np.cos(angle), a * np.sin(angle))
    z = np.asarray(depth, float)[..., None]
    share: Floats = np.mean(1.0 - (z / np.hypot(z, radius)) ** concentration, axis=-1)
    return share
