#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Density under the track of a wheel on clusters: mass over volume below the rut's surface, behind the wheel.

  track_density.py RESULTS CLUSTER_DENSITY
"""
import pathlib, sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "postproc"))
from furrow_post.results import Results

HALF_WIDTH = 0.09     # m: the middle two thirds of a wheel 0.272 m wide
BEHIND = (-0.50, -0.15)  # m from the axle: rolled over, and away from the start


def main():
    results, density = Results(sys.argv[1]), float(sys.argv[2])
    grains = results.grains("final")
    _, nodes = results.surface()
    axle = nodes[:, 0].mean()
    x, y, z = grains.x.T
    low, high = axle + BEHIND[0], axle + BEHIND[1]
    inside = (abs(y) < HALF_WIDTH) & (x > low) & (x < high)
    volume = 4 / 3 * np.pi * grains.radius**3
    # Surface: mean of the highest cluster's top in squares of two diameters
    size = 4 * np.median(grains.radius)
    cells = {}
    for i in np.flatnonzero(inside):
        key = (int((x[i] - low) / size), int((y[i] + HALF_WIDTH) / size))
        cells[key] = max(cells.get(key, 0.0), z[i] + grains.radius[i])
    height = np.mean(list(cells.values()))
    mass = density * volume[inside].sum()
    value = mass / ((high - low) * 2 * HALF_WIDTH * height)
    print(f"surface of the track {1e3 * height:.0f} mm above the floor (bed level {1e3 * grains.bed_level:.0f} mm)")
    print(f"density under the track {value:.0f} kg/m3; over the bed's level as it was: {mass / ((high - low) * 2 * HALF_WIDTH * grains.bed_level):.0f}")


if __name__ == "__main__":
    main()
