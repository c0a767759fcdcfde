# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/one_sand: keys of tests, verdicts, labels, compression."""

import math
import unittest
from types import SimpleNamespace
from unittest import mock

import numpy as np

from support.evaluation import evaluation

study = evaluation("one_sand")


class MatrixTest(unittest.TestCase):
    def test_key_has_packing_and_pressure_of_the_test_or_the_level_of_the_quantity(self) -> None:
        plane = SimpleNamespace(name="plane_strain_dense_20000/norsand")
        self.assertEqual(study.element_key(plane, "x"), ("plane strain", "dense, 20 kPa", "x"))
        oedometer = SimpleNamespace(name="oedometer_loose/cap")
        self.assertEqual(study.element_key(oedometer, "K0, 10 kPa"), ("oedometer", "loose, 10 kPa", "K0"))

    def test_error_above_the_goal_neither_meets_nor_misses_it(self) -> None:
        self.assertEqual(study.verdict(0.05, 0.02, 0.1), "met")
        self.assertEqual(study.verdict(0.05, 0.2, 0.1), "inconclusive")
        self.assertEqual(study.verdict(-0.2, 0.06, 0.1), "inconclusive")
        self.assertEqual(study.verdict(-0.23, 0.06, 0.1), "missed")

    def test_each_law_is_labelled_by_its_own_fit(self) -> None:
        key = ("extension", "medium, 20 kPa", "sin phi at peak")
        laws = {"norsand": {key: 0.55}, "cap": {key: 0.5}}
        row = study.matrix(laws, {"norsand": {}, "cap": {}}, {key: (0.5, 0.01)})[0]
        self.assertEqual((row["norsand_label"], row["cap_label"]), ("known", "fitted"))
        self.assertAlmostEqual(row["norsand_off"], 0.1)

    def test_compression_is_the_logarithm_of_the_growth_of_density(self) -> None:
        axial = np.array([0.0, 10e3, 100e3])
        found = study.compression(axial, 0.4 * axial, np.array([1500.0, 1515.0, 1560.0]))
        self.assertAlmostEqual(found["axial strain, 100 kPa"], math.log(1.04))
        self.assertAlmostEqual(found["K0, 10 kPa"], 0.4)

    def test_heightmap_is_a_cylinder_in_the_middle(self) -> None:
        lines = study.heightmap(0.42, 0.08).splitlines()
        heights = np.array([[float(cell) for cell in line.split()] for line in lines[5:]])
        self.assertEqual(heights.shape, (85, 85))
        self.assertEqual(lines[2], "xllcenter -0.21")
        np.testing.assert_array_equal(heights, heights[::-1, ::-1])
        # a circle of 16 steps, counted in squares
        self.assertAlmostEqual(heights.sum() / 0.08 / (math.pi * 16**2), 1.0, delta=0.02)

    def test_deposit_ends_where_it_is_thin(self) -> None:
        """A cone of 0.08 m height and 0.16 m radius on the layer: 5 mm thick at 0.15 m."""
        step = 0.002
        places = np.arange(-0.2, 0.2, step) + step / 2
        x, y = (part.ravel() for part in np.meshgrid(places, places))
        thickness = study.LAYER + np.maximum(0.08 - np.hypot(x, y) / 2, 0.0)
        terrain = SimpleNamespace(x=np.column_stack([x, y, thickness]), volume=thickness * step**2)
        with mock.patch.object(study.Terrain, "read", return_value=terrain):
            found = study.deposit_of_law(SimpleNamespace(name="collapse_1/norsand_0.01", folder=None))
        self.assertAlmostEqual(found["run-out over height"], (0.15 - 0.08) / 0.08, delta=0.03)
        self.assertAlmostEqual(found["height over radius"], (0.08 - 0.02 / 3) / 0.08, delta=0.01)
        self.assertAlmostEqual(found["slope"], math.degrees(math.atan(0.5)), delta=0.3)


if __name__ == "__main__":
    unittest.main()
