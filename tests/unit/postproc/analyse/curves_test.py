# SPDX-License-Identifier: GPL-2.0-or-later
"""Errors and verdicts of curves whose checks are known."""

import math
import unittest

import numpy as np

from furrow_post.analyse import curves
from furrow_post.analyse.curves import NUMERICAL_PARTS, Curve, CurveKind, NumericalErrors
from furrow_post.analyse.verdict import Agreement


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

    def test_verdict_names_what_is_not_known(self) -> None:
        other = plate_curve("other", 1.3 * math.exp(5 * 0.02), diameter=0.02)
        result = curves.compare_curves([self.base, other])

        def errors(value: float) -> NumericalErrors:
            return {name: np.full(len(result.levels), value) for name in NUMERICAL_PARTS}

        verdict = curves.judge_curves(result, 1, [errors(0.1), errors(math.nan)])
        self.assertEqual(set(verdict.agreements), {Agreement.AGREE})
        self.assertEqual(
            verdict.sentence,
            "base and other agree at every level (35 % allowed); "
            "not known: size of other, domain of other, packing of other",
        )
        vague = curves.judge_curves(result, 1, [errors(0.2), errors(0.1)])
        self.assertEqual(set(vague.agreements), {Agreement.UNDECIDED})
        self.assertIn("base and other cannot be told apart at every level", vague.sentence)

    def test_curves_that_lie_far_apart_differ(self) -> None:
        result = curves.compare_curves([self.base, plate_curve("far", 2.0, diameter=0.02)])
        known = {name: np.full(len(result.levels), 0.1) for name in NUMERICAL_PARTS}
        verdict = curves.judge_curves(result, 1, [known, known])
        self.assertEqual(verdict.sentence, "base and far differ at every level (49 % allowed)")

    def test_total_is_known_where_the_error_of_the_size_is(self) -> None:
        errors = {
            "size": np.array([0.3, math.nan]),
            "domain": np.array([0.4, 0.4]),
            "packing": np.array([math.nan, 0.1]),
        }
        total = curves.combined_errors(errors, np.zeros(2))
        assert total is not None
        np.testing.assert_allclose(total, [0.5, math.nan])
        unknown = {**errors, "size": np.full(2, math.nan)}
        self.assertIsNone(curves.combined_errors(unknown, np.zeros(2)))


if __name__ == "__main__":
    unittest.main()
