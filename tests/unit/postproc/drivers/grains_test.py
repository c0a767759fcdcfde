# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/grains: means over packings, the error of a difference, limits; densities of a
track."""

import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest.mock import patch

import numpy as np

from furrow_post.csv_table import read_rows
from support.command import SOURCE
from support.evaluation import VALIDATION, evaluation

sys.path.insert(0, str(SOURCE / "inputs" / "validation" / "grains"))

import track_density

from furrow_post.analyse.density import GroundPoints
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError

grains = evaluation("grains")
FAMILY = "sand_triaxial"  # two angles


def outcomes(**values: list[float]) -> list[dict[str, object]]:
    """Rows of changes with these angles, one packing each."""
    return [
        {"change": change.replace("_", " "), "value_1": angle, "value_2": angle - 1}
        for change, angles in values.items()
        for angle in angles
    ]


class PackingsTest(unittest.TestCase):
    found = grains.by_change(outcomes(base=[28.0, 30.0], half_the_step=[30.0]))

    def test_means_and_scatter(self) -> None:
        base, half = self.found["base"], self.found["half the step"]
        self.assertEqual((base.count, base.means[0]), (2, 29.0))
        self.assertAlmostEqual(base.scatter[0], math.sqrt(2))
        self.assertTrue(np.isnan(half.scatter).all())

    def test_error_of_a_difference_is_that_of_the_packings(self) -> None:
        base, _, half, _ = grains.change_rows(FAMILY, self.found)
        self.assertEqual((base["mean"], base["scatter"], base["difference"]), ("29", "1.41", ""))
        error = math.sqrt(2) * math.sqrt(1 + 1 / 2)
        self.assertEqual((half["difference"], half["difference_error"]), ("1", f"{error:.3g}"))

    def test_limits(self) -> None:
        self.assertEqual(list(grains.missed_limits(FAMILY, self.found)), [])
        soft = grains.by_change(outcomes(base=[20.0, 22.0]))
        missed = list(grains.missed_limits(FAMILY, soft))
        self.assertEqual(
            missed, ["sand_triaxial: friction_angle_end 20.000 is not in [25.0, 30.0]"]
        )
        (alone,) = grains.missed_limits(FAMILY, {})
        self.assertIn("fewer than two packings of the base", alone)

    def test_the_stored_changes_are_those_of_the_stored_runs(self) -> None:
        rows = read_rows(VALIDATION / "grains" / "results.csv")
        made = []
        for family in grains.FAMILIES:
            found = grains.by_change([row for row in rows if row["family"] == family])
            made += [{k: str(v) for k, v in row.items()} for row in grains.change_rows(family, found)]
        self.assertEqual(read_rows(VALIDATION / "grains" / "changes.csv"), made)


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
        points = GroundPoints(
            x, BULK * SIZE**3 * clusters, np.pi / 6 * SIZE**3 * clusters, SIZE * clusters, True
        )
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

    def test_mass_over_volume(self) -> None:
        middle, beside, ahead = self.report().splitlines()
        density, height, left = (float(middle.split()[k]) for k in (5, 7, 10))
        self.assertAlmostEqual(density, 2 * BULK, delta=0.1 * BULK)
        self.assertAlmostEqual(height, 0.5e3 * DEPTH, delta=0.5e3 * SIZE / 2)
        self.assertAlmostEqual(left, 1.0, delta=0.05)
        self.assertIn(" 200 kg/m3, 200 mm high, 1.00 of the mass before", beside)
        self.assertRegex(ahead, "ahead +[+-]0 mm risen")

    def test_refuses_what_has_no_density_of_clusters(self) -> None:
        with self.assertRaisesRegex(ResultsError, "its ground is no grains"):
            self.report("continuum")
        with self.assertRaisesRegex(ResultsError, "did not measure its density"):
            self.report(bulk=math.nan)


if __name__ == "__main__":
    unittest.main()
