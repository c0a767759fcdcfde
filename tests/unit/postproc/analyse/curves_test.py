# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors of curves whose checks are known, and their values at size zero."""

import math
import unittest

import numpy as np

from furrow_post.analyse import curves
from furrow_post.analyse.curves import Curve, CurveKind
from furrow_post.analyse.entry import LIMIT, RUN


def plate_curve(label: str, factor: float, box: float = 0.8, **facts: float) -> Curve:
    """p = factor x 1 MPa/m z."""
    z = np.linspace(1e-4, 0.05, 200)
    known = {"depth": 0.1, "box": box, **facts}
    return Curve(label, CurveKind.PLATE, "grains", z, 1e6 * factor * z, known, np.zeros(200))


class CurveErrorsTest(unittest.TestCase):
    base = plate_curve("base", math.exp(5 * 0.02), diameter=0.02)

    def test_errors_are_those_of_the_checks(self) -> None:
        checks = [
            plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04),
            plate_curve("seed", 1.1 * math.exp(5 * 0.04), diameter=0.04),
            plate_curve("wide", 0.9 * math.exp(5 * 0.02), box=1.2, diameter=0.02),
        ]
        found = curves.numerical_errors(self.base, checks, [0.01, 0.02])
        np.testing.assert_allclose(found["size"], 5 * 0.02, rtol=1e-9)  # ln p is linear in it
        np.testing.assert_allclose(found["packing"], math.log(1.1) / math.sqrt(2), rtol=1e-9)
        np.testing.assert_allclose(found["domain"], -math.log(0.9), rtol=1e-9)
        alone = curves.numerical_errors(self.base, [], [0.01])
        self.assertTrue(all(np.isnan(v).all() for v in alone.values()))
        # beyond the end of a check nothing is known
        beyond = curves.numerical_errors(self.base, checks, [0.06])
        self.assertTrue(np.isnan(beyond["size"][0]))

    def test_a_plate_at_size_zero_is_on_the_line_of_its_sizes(self) -> None:
        checks = [
            plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04),
            plate_curve("coarser", math.exp(5 * 0.06), diameter=0.06),
            plate_curve("seed", 1.1 * math.exp(5 * 0.04), diameter=0.04),
        ]
        run, limit = curves.plate_entries(self.base, checks, 0.01)
        self.assertEqual((run.kind, limit.kind), (RUN, LIMIT))
        self.assertAlmostEqual(run.value, 1e4 * math.exp(5 * 0.02), places=6)
        self.assertAlmostEqual(limit.value, 1e4, places=6)
        # on the line, which two packings leave open by their scatter
        scatter = math.log(1.1) / math.sqrt(2)
        expected = 1e4 * scatter / (math.sqrt(2) * 0.02) * 0.02
        self.assertAlmostEqual(limit.parts.size, expected, places=6)
        self.assertAlmostEqual(run.parts.size, run.value * 5 * 0.02, places=6)
        self.assertAlmostEqual(run.parts.packing, run.value * math.log(1.1) / math.sqrt(2))
        self.assertEqual((run.unknown, limit.unknown), (["domain"], ["domain"]))
        self.assertEqual(run.quantity.label, "pressure at 10 mm [kPa]")

    def test_what_lies_off_the_line_is_the_limit_s_error(self) -> None:
        # ln p at 2, 4, 6 cm is off its line by (1, -2, 1) e
        e, sizes = 0.03, (0.02, 0.04, 0.06)
        base, *checks = (
            plate_curve(f"{h}", math.exp(off * e), diameter=h) for h, off in zip(sizes, (1, -2, 1))
        )
        _, limit = curves.plate_entries(base, checks, 0.01)
        expected = math.sqrt(6) * e / (math.sqrt(2) * 0.02) * 0.02
        self.assertAlmostEqual(limit.parts.size / limit.value, expected, places=9)

    def test_of_one_size_there_is_no_limit_and_beyond_the_end_nothing(self) -> None:
        (alone,) = curves.plate_entries(self.base, [], 0.01)
        self.assertEqual((alone.kind, alone.unknown), (RUN, ["size", "domain", "packing"]))
        self.assertEqual(curves.plate_entries(self.base, [], 0.06), [])


if __name__ == "__main__":
    unittest.main()
