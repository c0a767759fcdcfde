# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressures of plates whose checks are known, and their values at size zero."""

import math
import unittest

import numpy as np

from furrow_post.analyse import plates
from furrow_post.analyse.curves import Curve, CurveKind
from furrow_post.analyse.entry import LIMIT, RUN
from furrow_post.analyse.size_line import LEAST_RELATIVE_ERROR
from furrow_post.analyse.statistics import rms


def plate_curve(label: str, factor: float, box: float = 0.8, **facts: float) -> Curve:
    """p = factor x 1 MPa/m z."""
    z = np.linspace(1e-4, 0.05, 200)
    known = {"depth": 0.1, "box": box, **facts}
    return Curve(label, CurveKind.PLATE, "grains", z, 1e6 * factor * z, known, np.zeros(200))


class PlateErrorsTest(unittest.TestCase):
    base = plate_curve("base", math.exp(5 * 0.02), diameter=0.02)

    def test_errors_are_those_of_the_checks(self) -> None:
        checks = [
            plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04),
            plate_curve("seed", 1.1 * math.exp(5 * 0.02), diameter=0.02),
            plate_curve("wide", 0.9 * math.exp(5 * 0.02), box=1.2, diameter=0.02),
        ]
        run, _ = plates.plate_entries(self.base, checks, 0.01)
        self.assertAlmostEqual(run.value, 1e4 * math.exp(5 * 0.02), places=6)
        e = math.log(1.1)
        slope = 5 - 0.5 * e / 0.02  # the mean of two packings at 2 cm is higher by e/2
        relative = [1e-4 * part / math.exp(5 * 0.02) for part in run.parts.parts()]
        expected = [0.0, slope * 0.02, 0.5 * e - math.log(0.9), e / math.sqrt(2)]
        np.testing.assert_allclose(relative, expected, rtol=1e-9)

    def test_a_plate_at_size_zero_is_on_the_line_of_its_sizes(self) -> None:
        checks = [
            plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04),
            plate_curve("coarser", math.exp(5 * 0.06), diameter=0.06),
        ]
        run, limit = plates.plate_entries(self.base, checks, 0.01)
        self.assertEqual((run.kind, limit.kind), (RUN, LIMIT))
        self.assertAlmostEqual(limit.value, 1e4, places=6)
        # on the line: what is left is the least error of a value, [(X^T X)^-1]_00 of 2, 4, 6 cm
        h = np.array([0.02, 0.04, 0.06])
        open_at_zero = math.sqrt(1 / 3 + h.mean() ** 2 / np.sum((h - h.mean()) ** 2))
        self.assertAlmostEqual(limit.parts.size, 1e4 * LEAST_RELATIVE_ERROR * open_at_zero, places=6)
        self.assertAlmostEqual(run.parts.size, run.value * 5 * 0.02, places=6)
        self.assertEqual(run.unknown, ["domain", "packing"])
        self.assertEqual(run.quantity.label, "pressure at 10 mm [kPa]")

    def test_packings_make_the_value_at_size_zero_surer(self) -> None:
        random, scatter, zeros = np.random.default_rng(2), 0.1, []
        sizes = (0.02, 0.04, 0.06, 0.02, 0.04, 0.06)
        for _ in range(300):
            base, *checks = (
                plate_curve(f"{k}", math.exp(5 * h + random.normal(0, scatter)), diameter=h)
                for k, h in enumerate(sizes)
            )
            _, limit = plates.plate_entries(base, checks, 0.01)
            zeros.append((math.log(limit.value / 1e4), limit.parts.size / limit.value))
        found = np.array(zeros)
        self.assertAlmostEqual(found[:, 0].mean(), 0.0, delta=3 * found[:, 0].std() / math.sqrt(300))
        # of an error that is itself estimated from six runs, the mean square is the right one
        self.assertAlmostEqual(rms(found[:, 1]) / found[:, 0].std(), 1.0, delta=0.12)

    def test_what_lies_off_the_line_is_the_limit_s_error(self) -> None:
        # ln p at 2, 4, 6 cm is off its line by (1, -2, 1) e
        e, sizes = 0.03, (0.02, 0.04, 0.06)
        base, *checks = (
            plate_curve(f"{h}", math.exp(off * e), diameter=h) for h, off in zip(sizes, (1, -2, 1))
        )
        _, limit = plates.plate_entries(base, checks, 0.01)
        expected = math.sqrt(6) * e * math.sqrt(1 / 3 + 0.04**2 / (2 * 0.02**2))
        self.assertAlmostEqual(limit.parts.size / limit.value, expected, places=9)

    def test_of_one_size_there_is_no_limit_and_beyond_the_end_nothing(self) -> None:
        (alone,) = plates.plate_entries(self.base, [], 0.01)
        self.assertEqual((alone.kind, alone.unknown), (RUN, ["size", "domain", "packing"]))
        self.assertEqual(plates.plate_entries(self.base, [], 0.06), [])


if __name__ == "__main__":
    unittest.main()
