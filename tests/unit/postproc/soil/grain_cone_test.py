# SPDX-License-Identifier: GPL-2.0-or-later
"""Cones on grains: a series of grain sizes with a known limit, and one that does not settle."""

import unittest

import numpy as np

from furrow_post.read.soil_card import Cone
from furrow_post.soil.fits import ConeCurve
from furrow_post.soil.grain_cone import GrainCone, cone_notes, fit_grain_cones

LIMIT, DENSITY, GRAVITY, GRAIN = 26.0, 1350.0, 1.62, 0.01
SLOPE = 20.0  # of the index over depth, both over the size of the cone


def cones(effect: dict[float, float], packings: tuple[float, ...] = (1.0,)) -> list[GrainCone]:
    """effect: grains across the base -> factor on the limit."""
    made = []
    for packing in packings:
        for grains, factor in effect.items():
            size = grains * GRAIN
            weight, depth = DENSITY * GRAVITY * size, np.linspace(0, size, 101)
            pressure = packing * weight * (LIMIT * factor + SLOPE * (depth / size - 0.5))
            made.append(GrainCone(ConeCurve(depth, pressure, size, 30.0), grains, weight))
    return made


class GrainConeTest(unittest.TestCase):
    def fitted(self, runs: list[GrainCone]) -> Cone:
        cone = fit_grain_cones(runs)
        self.assertEqual(cone.size, max(run.curve.size for run in runs))
        return cone

    def test_limit_of_a_second_order_series_is_within_the_error(self) -> None:
        runs = cones({grains: 1 + 6 / grains**2 for grains in (4.0, 6.0, 8.0)})
        cone, weight = self.fitted(runs), runs[2].weight
        self.assertAlmostEqual(cone.index.value / weight, LIMIT * (1 + 6 / 64), places=9)
        self.assertLess(abs(cone.index.value - LIMIT * weight), cone.index.error)
        self.assertAlmostEqual(cone.gradient.value * cone.size / weight, SLOPE, places=9)
        self.assertIn(f"extrapolated to zero grain size {LIMIT:.3g} ± ", cone_notes(runs)[1])

    def test_unsettled_series_is_not_extrapolated(self) -> None:
        runs = cones({4.0: 1.0, 6.0: 1.4, 8.0: 1.1})
        cone, weight = self.fitted(runs), runs[2].weight
        self.assertGreater(cone.index.error, 0.4 * LIMIT * weight)
        self.assertIn("not extrapolated to zero grain size: the series is not monotonic", cone_notes(runs)[1])

    def test_error_includes_the_scatter_of_packings(self) -> None:
        effect = {grains: 1.0 + 1e-9 / grains for grains in (4.0, 6.0, 8.0)}
        runs = cones(effect, (0.95, 1.05))
        cone, weight = self.fitted(runs), runs[2].weight
        self.assertAlmostEqual(cone.index.value / weight, LIMIT, delta=0.01 * LIMIT)
        self.assertGreater(cone.index.error, 0.03 * LIMIT * weight)
        self.assertGreater(cone.gradient.error * cone.size / weight, 0.049 * SLOPE)


if __name__ == "__main__":
    unittest.main()
