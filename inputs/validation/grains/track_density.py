#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Density under the track of a wheel on clusters: mass over volume below the rut's surface, behind
the wheel."""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

from furrow_post.arguments import path, positive
from furrow_post.errors import ResultsError
from furrow_post.program import run_program
from furrow_post.read.results import Results

HALF_WIDTH = 0.09  # [m] the middle two thirds of a wheel 0.272 m wide
BEHIND = (-0.50, -0.15)  # [m] from the axle: rolled over, and away from the start


def report(folder: Path, cluster_density: float) -> str:
    """Two lines. cluster_density [kg/m3]; @raises ResultsError without grains or wheel"""
    results = Results(folder)
    grains, surface = results.grains("final"), results.surface()
    if surface is None:
        raise ResultsError(f"{results.file}: has no surface of a wheel")
    axle = surface.x[:, 0].mean()
    x, y, z = grains.x.T
    low, high = axle + BEHIND[0], axle + BEHIND[1]
    # below z = 0 is what a bed froze to its ground
    inside = (abs(y) < HALF_WIDTH) & (x > low) & (x < high) & (z > 0)
    # Surface: mean of the highest cluster's top in squares of two diameters
    size = 4 * np.median(grains.radius)
    tops: dict[tuple[int, int], float] = {}
    for i in np.flatnonzero(inside):
        square = (int((x[i] - low) / size), int((y[i] + HALF_WIDTH) / size))
        tops[square] = max(tops.get(square, 0.0), float(z[i] + grains.radius[i]))
    if not tops:
        raise ResultsError(
            f"{results.file}: has no grains {-BEHIND[1]:g} to {-BEHIND[0]:g} m behind the wheel; "
            "roll farther"
        )
    height = float(np.mean(list(tops.values())))
    mass = cluster_density * (4 / 3 * np.pi * grains.radius**3)[inside].sum()
    area = (high - low) * 2 * HALF_WIDTH
    level = grains.bed_level
    return (
        f"surface of the track {1e3 * height:.0f} mm above the floor "
        f"(bed level {1e3 * level:.0f} mm)\n"
        f"density under the track {mass / (area * height):.0f} kg/m3; "
        f"over the bed's level as it was: {mass / (area * level):.0f}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=path, help="results folder of the run")
    parser.add_argument("density", type=positive, help="of a cluster [kg/m3]")
    parsed = parser.parse_args()
    print(report(parsed.results, parsed.density))


if __name__ == "__main__":
    sys.exit(run_program("track_density.py", main))
