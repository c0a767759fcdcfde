# SPDX-License-Identifier: GPL-2.0-or-later
"""A parameter from measured rows: runs and tests in which quantities are parabolas in 1/M^2, straight in the depth."""

import math
import unittest

import numpy as np

from furrow_post.laws.compressed_snow import cam_clay_confined
from furrow_post.laws.response import Identified, Response

VALUES, DEPTHS = (1.4, 2.0, 3.3), (0.18, 0.22, 0.38)
GOALS = {"sinkage": 0.012, "resistance": 0.031, "density": 25.5}


def sinkage(m: float, depth: float) -> float:
    return 0.7 * depth + 0.1 * m**-2 + 0.02 * m**-4


def identify(m: float, scatter: float = 0.0) -> Identified:
    z = np.array([[sinkage(value, depth) for depth in DEPTHS] for value in VALUES])
    response = Response(VALUES, DEPTHS, {"sinkage": z, "resistance": 0.1 + z, "density": 510.0 + 0 * z})
    depths = [0.18, 0.18, 0.20, 0.20, 0.30, 0.30]
    measured = [sinkage(m, depth) + sign * scatter for depth, sign in zip(depths, (-1, 1) * 3)]
    return response.identify(depths, {"sinkage": measured, "resistance": [0.1 + one for one in measured], "density": 510.0}, GOALS)


class ResponseTest(unittest.TestCase):
    def test_parameter_of_the_tests_is_recovered(self) -> None:
        found = identify(2.4)
        self.assertAlmostEqual(found.value, 2.4, delta=0.001)
        self.assertAlmostEqual(found.left["sinkage"], 0.0, places=4)

    def test_scatter_widens_the_range_as_the_standard_error_does(self) -> None:
        """The scatter is of z alone: its error over dz/dM, from N = 6 tests; here z and c state the same, and the density is a
        thirteenth term, without scatter."""
        for scatter in (0.002, 0.003):
            found = identify(2.4, scatter)
            expected = scatter / math.sqrt(12) / (0.2 * 2.4**-3 + 0.08 * 2.4**-5)
            self.assertAlmostEqual(found.value, 2.4, delta=0.01)
            self.assertAlmostEqual((found.high - found.low) / (2 * expected), 1.0, delta=0.05)

    def test_value_beyond_the_runs_is_a_bound(self) -> None:
        found = identify(4.0)
        self.assertEqual((found.value, found.high), (3.3, 3.3))
        self.assertLess(found.low, 3.3)

    def test_k0_and_strength_follow_from_confined_compression(self) -> None:
        """K0 as src/material/snow.md has it; p and q under an axial stress of 1 on the ellipse."""
        for slope, k0 in ((3.3, 0.12), (2.0, 0.41), (1.5, 0.57)):
            found, p0 = cam_clay_confined(slope, 0.1)
            self.assertAlmostEqual(found, k0, delta=0.005)
            p, q = (1 + 2 * found) / 3, 1 - found
            self.assertAlmostEqual((p + 0.1 * p0) * (p0 - p), q * q * 1.2 / slope**2, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
