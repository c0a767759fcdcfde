# SPDX-License-Identifier: GPL-2.0-or-later
"""Where triangles cross a plane."""

import numpy as np

from ..arrays import Floats
from ..read.results import Surface


def cut(surface: Surface, axis: int, position: float) -> Floats:
    """Segments (k, 2, 3) in which triangles cross the plane x[axis] = position [m]."""
    corners = surface.x[surface.triangles]
    side = corners[:, :, axis] - position
    crossed = np.flatnonzero((side.min(axis=1) < 0) & (side.max(axis=1) >= 0))
    segments = np.empty((len(crossed), 2, 3))
    for i, t in enumerate(crossed):
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            if (side[t, a] < 0) != (side[t, b] < 0):
                share = side[t, a] / (side[t, a] - side[t, b])
                ends.append(corners[t, a] + share * (corners[t, b] - corners[t, a]))
        segments[i] = ends
    return segments
