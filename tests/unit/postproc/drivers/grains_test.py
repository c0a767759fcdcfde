# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/grains: densities of a track."""

import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np

from support.command import SOURCE

sys.path.insert(0, str(SOURCE / "inputs" / "validation" / "grains"))

import track_density

from furrow_post.analyse.density import GroundPoints
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError

SIZE, DEPTH, BULK, SIDE = 0.02, 0.20, 200.0, 0.12  # a lattice of clusters; half a wheel's width


def rolled_over(x: Floats) -> Floats:
    """Pressed to half of its height where the wheel was."""
    behind = (x[:, 0] < 0) & (abs(x[:, 1]) < SIDE)
    return np.column_stack([x[:, 0], x[:, 1], np.where(behind, 0.5 * x[:, 2], x[:, 2])])


class TrackTest(unittest.TestCase):
    """A bed on a frozen layer, of which a wheel leaves half of the height."""

    def report(self, ground: str = "grains", bulk: float = BULK) -> str:
        axes = [np.arange(low + SIZE / 2, high, SIZE) for low, high in ((-1, 1), (-0.3, 0.3))]
        heights = np.arange(-SIZE / 2, DEPTH, SIZE)  # the lowest: frozen to the ground
        x = np.stack(np.meshgrid(*axes, heights, indexing="ij"), axis=-1).reshape(-1, 3)
        before = SimpleNamespace(x=x, radius=np.full(len(x), SIZE / 2))
        x = rolled_over(x) - [0, 0, DEPTH]
        clusters = np.ones(len(x))
        points = GroundPoints(x, BULK * SIZE**3 * clusters, np.pi / 6 * SIZE**3 * clusters, SIZE * clusters, True)
        numbers = {"density": bulk, "depth": DEPTH, "wheel_width": 2 * SIDE}
        run = SimpleNamespace(
            ground=ground,
            floor=0.0,
            ground_level=DEPTH,
            radius=0.4,
            number=numbers.__getitem__,
            results=SimpleNamespace(grains=lambda time: before),
        )
        with (
            patch.object(track_density, "read_wheel_run", return_value=run),
            patch.object(track_density, "ground_points", return_value=points),
        ):
            return track_density.report(Path("rolled"))

    def test_density_is_mass_over_volume(self) -> None:
        middle, beside, ahead = self.report().splitlines()
        density, height, left = (float(middle.split()[k]) for k in (5, 7, 10))
        self.assertAlmostEqual(density, 2 * BULK, delta=0.1 * BULK)
        self.assertAlmostEqual(height, 0.5e3 * DEPTH, delta=0.5e3 * SIZE / 2)
        self.assertAlmostEqual(left, 1.0, delta=0.05)
        self.assertIn(" 200 kg/m3, 200 mm high, 1.00 of the mass before", beside)
        self.assertRegex(ahead, "ahead +[+-]0 mm risen")

    def test_ground_without_clusters_is_refused(self) -> None:
        self.assertRaisesRegex(ResultsError, "its ground is no grains", self.report, "continuum")
        self.assertRaisesRegex(ResultsError, "did not measure its density", self.report, bulk=math.nan)


if __name__ == "__main__":
    unittest.main()
