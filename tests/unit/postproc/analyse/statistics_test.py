# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers made of values at several sizes."""

import unittest

from furrow_post.analyse.statistics import at_size_zero


class SizeZeroTest(unittest.TestCase):
    def test_errors_of_second_and_of_first_order_are_removed(self) -> None:
        def second(size: float) -> tuple[float, float]:
            return size, 7.0 + 3.0 * size**2

        def first(size: float) -> tuple[float, float]:
            return size, 7.0 + 3.0 * size

        self.assertAlmostEqual(at_size_zero(second(0.4), second(0.3))[0], 7.0)
        value, distance = at_size_zero(first(0.4), first(0.3))
        self.assertAlmostEqual(value - distance, 7.0)


if __name__ == "__main__":
    unittest.main()
