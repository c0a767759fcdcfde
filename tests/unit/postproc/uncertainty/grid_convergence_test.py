# SPDX-License-Identifier: GPL-2.0-or-later
"""Extrapolation to zero size: series of closed form, and series that must not be extrapolated."""

import math
import unittest

import numpy as np

from furrow_post.uncertainty.grid_convergence import (
    Convergence,
    grid_convergence,
    mean_shift,
    pooled_scatter,
)

SIZES = (0.01, 0.015, 0.02, 0.04)


def power(order: float, zero: float = 2.0, slope: float = 3.0) -> list[float]:
    """f0 + a h^p at SIZES."""
    return [zero + slope * h**order for h in SIZES]


class PowerLawTest(unittest.TestCase):
    def test_order_and_value_of_a_power_law_are_found(self) -> None:
        for order in (0.6, 1.0, 1.5, 2.0):
            for count in (3, 4):
                with self.subTest(order=order, count=count):
                    found = grid_convergence(SIZES[:count], power(order)[:count])
                    self.assertTrue(found.extrapolated)
                    self.assertAlmostEqual(found.order, order, delta=2e-3)
                    self.assertAlmostEqual(found.value, 2.0, delta=2e-4)
                    self.assertAlmostEqual(found.at(0.03), 2.0 + 3.0 * 0.03**order, delta=1e-4)

    def test_index_is_safety_factor_times_distance_of_the_finest(self) -> None:
        found = grid_convergence(SIZES, power(1.0))
        # Roache: 1.25 |f2 - f1|/(r - 1), which covers 95 %; a standard error is half of it
        f1, f2 = power(1.0)[:2]
        index = 1.25 * (f2 - f1) / (SIZES[1] / SIZES[0] - 1.0)
        self.assertAlmostEqual(found.index_error, index / 2, delta=1e-4 * index)
        self.assertEqual(found.noise, 0.0)

    def test_series_outside_the_asymptotic_range_uses_second_order(self) -> None:
        found = grid_convergence(SIZES, power(4.0, slope=1e4))
        f1, f2 = power(4.0, slope=1e4)[:2]
        distance = (f2 - f1) / ((SIZES[1] / SIZES[0]) ** 2 - 1.0)
        self.assertAlmostEqual(found.order, 4.0, delta=0.01)
        self.assertEqual(found.used_order, 2.0)
        self.assertAlmostEqual(found.value, f1 - distance, places=9)
        self.assertAlmostEqual(found.index_error, 3.0 * distance / 2, places=9)

    def test_two_terms_stay_within_the_error(self) -> None:
        """f0 + a h + b h^2 has no one order, but a value at zero size."""
        for a, b in ((3.0, 40.0), (3.0, -20.0), (-1.0, -200.0), (0.5, 100.0)):
            values = [2.0 + a * h + b * h**2 for h in SIZES]
            with self.subTest(a=a, b=b):
                found = grid_convergence(SIZES, values)
                self.assertTrue(found.extrapolated)
                self.assertLess(abs(found.value - 2.0), 2 * found.error)


class NoExtrapolationTest(unittest.TestCase):
    def check(self, found: Convergence, reason: str, finest: float, error: float) -> None:
        self.assertFalse(found.extrapolated)
        self.assertIn(reason, found.reason)
        self.assertEqual(found.value, finest)
        self.assertAlmostEqual(found.error, error, places=9)
        self.assertTrue(math.isnan(found.used_order))

    def test_fewer_than_three_sizes_are_not_extrapolated(self) -> None:
        found = grid_convergence([0.02, 0.01], [1.2, 1.1])
        self.check(found, "fewer than three", 1.1, 3.0 * 0.1 / 2)  # Roache's bound of first order

    def test_one_size_has_no_error(self) -> None:
        found = grid_convergence([0.01, 0.01], [1.0, 1.2], [0.1, 0.1])
        self.assertAlmostEqual(found.value, 1.1)
        self.assertTrue(math.isnan(found.error))

    def test_non_monotonic_series_is_not_extrapolated(self) -> None:
        self.check(grid_convergence(SIZES[:3], [1.0, 0.9, 1.3]), "monotonic", 1.0, 3.0 * 0.4 / 2)

    def test_order_below_one_half_is_not_extrapolated(self) -> None:
        for values in ([2.0 + 3.0 * h**0.3 for h in SIZES], [math.log(h) for h in SIZES]):
            span = max(values) - min(values)
            self.check(grid_convergence(SIZES, values), "below 0.5", values[0], 3.0 * span / 2)

    def test_diverging_series_is_not_extrapolated(self) -> None:
        """The sinkage on the law of sand of crosscheck: 50, 40, 33 mm."""
        found = grid_convergence([0.05, 0.04, 1 / 30], [0.0685661, 0.0728122, 0.0774177])
        self.check(found, "below 0.5", 0.0774177, 3.0 * (0.0774177 - 0.0685661) / 2)

    def test_differences_within_the_scatter_are_not_extrapolated(self) -> None:
        found = grid_convergence(SIZES[:3], [1.00, 1.01, 1.03], [0.05] * 3)
        self.check(found, "scatter", 1.0, math.hypot(3.0 * 0.03 / 2, 0.05))


class NoiseTest(unittest.TestCase):
    def test_two_standard_errors_cover_the_value_of_scattered_series(self) -> None:
        random, scatter, held, extrapolated = np.random.default_rng(3), 2e-3, 0, 0
        for _ in range(400):
            values = np.array(power(1.0)) + random.normal(0.0, scatter, len(SIZES))
            found = grid_convergence(SIZES, list(values), [scatter] * len(SIZES))
            held += abs(found.value - 2.0) < 2 * found.error
            extrapolated += found.extrapolated
        self.assertGreaterEqual(held / 400, 0.95)
        self.assertGreater(extrapolated, 200)

    def test_packings_of_a_size_enter_by_their_mean(self) -> None:
        sizes = (0.01, 0.0101, 0.02, 0.04)
        found = grid_convergence(sizes, [1.02, 1.00, 1.02, 1.04], [1e-3, 1e-3, 1e-3, 1e-3])
        self.assertEqual(len(found.sizes), 3)
        self.assertAlmostEqual(found.values[0], 1.01)

    def test_scatter_and_shift_enter_the_error(self) -> None:
        self.assertAlmostEqual(pooled_scatter([[1.0, 1.2], [5.0], [2.0, 2.2]]), 0.1 * math.sqrt(2))
        self.assertTrue(math.isnan(pooled_scatter([[1.0], [2.0]])))
        self.assertAlmostEqual(mean_shift([(1.0, [0.5, 0.7]), (2.0, [2.2])]), 0.1)


if __name__ == "__main__":
    unittest.main()
