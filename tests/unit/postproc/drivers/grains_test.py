# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/grains: means over packings, the error of a difference, limits."""

import math
import sys
import unittest

import numpy as np

from support.command import SOURCE

sys.path.insert(0, str(SOURCE / "inputs" / "validation" / "grains"))

import run as grains

FAMILY = grains.FAMILIES[0]  # sand_triaxial: two angles


def outcomes(**values: list[float]) -> list[grains.Outcome]:
    """Runs of changes with these angles, one packing each."""
    return [
        grains.Outcome(
            grains.Planned(grains.CASES[0], change.replace("_", " "), seed),
            np.array([angle, angle - 1]),
            10.0,
        )
        for change, angles in values.items()
        for seed, angle in enumerate(angles)
    ]


class PackingsTest(unittest.TestCase):
    found = grains.by_change(outcomes(base=[28.0, 30.0], half_the_step=[30.0]))

    def test_means_and_scatter(self) -> None:
        base, half = self.found["base"], self.found["half the step"]
        self.assertEqual((base.count, base.means[0]), (2, 29.0))
        self.assertAlmostEqual(base.scatter[0], math.sqrt(2))
        self.assertTrue(np.isnan(half.scatter).all())

    def test_error_of_a_difference_is_that_of_the_packings(self) -> None:
        lines = grains.family_section(FAMILY, self.found)
        error = math.sqrt(2) * math.sqrt(1 + 1 / 2)
        expected = f"| half the step | 1 | 30.0 | +1.0 ± {error:.1f} |"
        self.assertTrue(any(line.startswith(expected) for line in lines), lines)
        self.assertTrue(any("| base | 2 | 29.0, scatter 1.4 |  |" in line for line in lines))

    def test_limits(self) -> None:
        self.assertEqual(list(grains.missed_limits(FAMILY, self.found)), [])
        soft = grains.by_change(outcomes(base=[20.0, 22.0]))
        missed = list(grains.missed_limits(FAMILY, soft))
        self.assertEqual(
            missed, ["sand_triaxial: friction_angle_end 20.000 is not in [25.0, 30.0]"]
        )
        (alone,) = grains.missed_limits(FAMILY, {})
        self.assertIn("fewer than two packings of the base", alone)


if __name__ == "__main__":
    unittest.main()
