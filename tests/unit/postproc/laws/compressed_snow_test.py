# SPDX-License-Identifier: GPL-2.0-or-later
"""A rigid wheel on snow that is only compressed, against closed forms."""

import math
import unittest

import numpy as np

from furrow_post.laws.compressed_snow import CompressedSnow
from furrow_post.arrays import Floats
from support.evaluation import evaluation

RADIUS, WIDTH, DEPTH = 0.37, 0.272, 0.2


class CompressedSnowTest(unittest.TestCase):
    def test_spring_bed_has_the_sinkage_of_bekkers_wheel(self) -> None:
        """p = k w under a circle: the integral of k (sqrt(r^2 - x^2) - (r - z)) in closed form."""
        k, z = 1e6, 0.08

        def linear(strain: Floats) -> Floats:
            return np.asarray(k * DEPTH * (1 - np.exp(-strain)))

        snow = CompressedSnow(RADIUS, WIDTH, DEPTH, linear)
        half = math.sqrt(2 * RADIUS * z - z * z)
        segment = 0.5 * (half * (RADIUS - z) + RADIUS**2 * math.asin(half / RADIUS)) - (RADIUS - z) * half
        self.assertAlmostEqual(snow.carried(z) / (WIDTH * k * segment), 1, places=5)
        self.assertAlmostEqual(snow.work(z) / (WIDTH * k * z * z / 2), 1, places=5)
        for sides in (1, 2):
            sunk = snow.sinkage(6e3, sides)
            self.assertAlmostEqual(snow.carried(sunk, sides) / 6e3, 1, 6)
            self.assertLess(snow.sinkage(6e3, sides, 5e3), sunk)

    def test_steep_pressure_has_the_closed_form_resistance(self) -> None:
        """p = p_m exp(-(z_m - z)/lambda): W = b p_m sqrt(pi r lambda/2), c = sqrt(2 lambda/(pi r))."""
        sinkage, greatest, length = 0.12, 1e6, 5e-4

        def steep(strain: Floats) -> Floats:
            return np.asarray(greatest * np.exp((DEPTH * (1 - np.exp(-strain)) - sinkage) / length))

        snow = CompressedSnow(RADIUS, WIDTH, DEPTH, steep)
        load = WIDTH * greatest * math.sqrt(0.5 * math.pi * RADIUS * length)
        found = snow.sinkage(load)
        self.assertAlmostEqual(found, sinkage, delta=1e-5)
        self.assertAlmostEqual(snow.work(found) / load / math.sqrt(2 * length / (math.pi * RADIUS)), 1.0, delta=0.01)

    def test_bearing_capacity_of_the_snow_is_prandtl(self) -> None:
        study = evaluation("report_wheel")
        self.assertAlmostEqual(math.degrees(study.PHI), 13.86, places=2)
        self.assertAlmostEqual(study.NC, 10.29, places=2)  # tables: 10.37 at 14 degrees


if __name__ == "__main__":
    unittest.main()
