# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that end with a deposit: the collapse of a column, the angle of repose."""

import math

import numpy as np

from ..arrays import Booleans, Floats
from ..read.laboratory import LaboratoryTest
from .quantity import LaboratoryQuantity


def collapse(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Run-out and height of a column, beside G. Lube et al. (2004)."""
    column, deposit = test.grains("column"), test.grains("deposit")
    diameter, r0 = test.number("diameter"), test.number("radius")
    volume = np.sum(4 / 3 * np.pi * column[:, 3] ** 3)
    # The column is uniform, so that its middle lies at half its height.
    h0 = float(2.0 * np.average(column[:, 2], weights=column[:, 3] ** 3))
    fraction = float(volume / (np.pi * r0**2 * h0))
    middle = np.average(deposit[:, :2], axis=0)
    distance = np.hypot(*(deposit[:, :2] - middle).T)
    edges = np.arange(0.0, distance.max() + 2 * diameter, diameter)
    height = thickness_profile(deposit, distance, edges, np.pi * np.diff(edges**2), fraction)
    final, wide, narrow = (
        outer_radius(height, edges, share * diameter) for share in (0.5, 0.25, 1.0)
    )
    slope, slope_error = slope_angle(height, edges)
    near = deposit[distance < 2 * diameter]
    top = float(np.percentile(near[:, 2] + near[:, 3], 95))
    aspect = h0 / r0
    expected = 1.24 * aspect if aspect < 1.7 else 1.6 * math.sqrt(aspect)
    runout, error = final / r0 - 1, 0.5 * (wide - narrow) / r0
    height_error = 0.5 * diameter / r0
    quantity = LaboratoryQuantity
    thick = "(r - r0)/r0; r where the deposit is half a grain thick (error: 1/4 to 1 grain)"
    lube = "1.24 a (a < 1.7), 1.6 sqrt(a): Lube et al. 2004"
    result = [
        quantity("aspect", aspect, 0.0, "", "height over radius of the column"),
        quantity("solid_fraction", fraction, 0.0, "", "of the column"),
        quantity("runout", runout, error, "", thick),
        quantity("runout_over_Lube", runout / expected, error / expected, "", lube),
        quantity("height_over_r0", top / r0, height_error, "", "top of the deposit"),
        quantity("slope", slope, slope_error, "deg", "between 20 and 80 % of the height of the deposit"),
    ]
    if aspect > 1.7:
        ratio = top / r0 / (0.88 * aspect ** (1 / 6))
        result.append(quantity("height_over_Lube", ratio, height_error, "", "0.88 a^(1/6)"))
    return result


def repose(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Slope of the highest grains of a deposit."""
    deposit, diameter = test.grains("deposit"), test.number("diameter")
    length = test.number("length")
    bins = np.arange(0.0, length, 1.5 * diameter)
    x, y = deposit[:, 0], deposit[:, 1]

    def angle(part: Booleans) -> float:
        """Slope angle of some grains [degrees]."""
        where, top = [], []
        for low, high in zip(bins[:-1], bins[1:]):
            inside = part & (x >= low) & (x < high)
            if inside.any():
                where.append(0.5 * (low + high))
                top.append(np.max(deposit[inside, 2] + deposit[inside, 3]))
        middles, tops = np.array(where), np.array(top)
        on_slope = (middles > 0.15 * length) & (middles < 0.9 * length) & (tops > 2 * diameter)
        slope = np.polyfit(middles[on_slope], tops[on_slope], 1)[0]
        return float(-np.degrees(np.arctan(slope)))

    thirds = np.array_split(np.argsort(y), 3)
    parts = [angle(np.isin(np.arange(len(x)), third)) for third in thirds]
    whole, error = angle(np.full(len(x), True)), float(np.std(parts, ddof=1) / np.sqrt(3))
    meaning = "slope of the highest grains; error from three slices"
    return [LaboratoryQuantity("angle_of_repose", whole, error, "deg", meaning)]


def thickness_profile(
    grains: Floats, distance: Floats, edges: Floats, areas: Floats, solid_fraction: float
) -> Floats:
    """Height of a deposit in bins of distance [m]: solid volume over area and solid fraction.

    grains (n, 4): x, y, z, radius; distance (n) [m]; edges (m + 1) [m], areas (m) [m2] of the bins
    """
    solid = 4 / 3 * np.pi * grains[:, 3] ** 3
    volume, _ = np.histogram(distance, bins=edges, weights=solid)
    height: Floats = volume / areas / solid_fraction
    return height


def slope_angle(height: Floats, edges: Floats) -> tuple[float, float]:
    """Slope [degrees] of a profile of heights (m) in rings, between 20 and 80 % of the highest; error: from 10 to 90 %."""
    centre, top = 0.5 * (edges[1:] + edges[:-1]), float(height.max())

    def between(low: float, high: float) -> float:
        first = int(np.flatnonzero(height < high * top)[0])
        last = int(np.flatnonzero(height > low * top)[-1])
        if last <= first:  # the surface drops between two rings
            return 90.0
        part = slice(first, last + 1)
        return -math.degrees(math.atan(np.polyfit(centre[part], height[part], 1)[0]))

    angle = between(0.2, 0.8)
    return angle, abs(angle - between(0.1, 0.9))


def outer_radius(height: Floats, edges: Floats, level: float) -> float:
    """Radius at which a profile of heights (m) in rings of one width last falls below a level [m]."""
    centre = 0.5 * (edges[1:] + edges[:-1])
    last = int(np.flatnonzero(height > level)[-1])
    if last + 1 == len(height):
        return float(edges[-1])
    share = (height[last] - level) / (height[last] - height[last + 1])
    return float(centre[last] + (centre[last + 1] - centre[last]) * share)
