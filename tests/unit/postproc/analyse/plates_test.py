# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressures of plates whose checks are known, and their best estimates."""

import math
import unittest

import numpy as np

from furrow_post.analyse import plates
from furrow_post.analyse.curves import Curve, CurveKind
from furrow_post.uncertainty.verdict import BEST, RUN
from furrow_post.uncertainty.grid_convergence import grid_convergence


def plate_curve(label: str, factor: float, box: float = 0.8, **facts: float) -> Curve:
    """p = factor x 1 MPa/m z."""
    z = np.linspace(1e-4, 0.05, 200)
    known = {"depth": 0.1, "box": box, **facts}
    return Curve(label, CurveKind.PLATE, "grains", z, 1e6 * factor * z, known, np.zeros(200))


class PlateErrorsTest(unittest.TestCase):
    base = plate_curve("base", math.exp(5 * 0.02), diameter=0.02)

    def test_errors_equal_those_of_the_checks(self) -> None:
        checks = [
            plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04),
            plate_curve("seed", 1.1 * math.exp(5 * 0.02), diameter=0.02),
            plate_curve("wide", 0.9 * math.exp(5 * 0.02), box=1.2, diameter=0.02),
        ]
        run, best = plates.plate_entries(self.base, checks, 0.01)
        self.assertAlmostEqual(run.value, 1e4 * math.exp(5 * 0.02), places=6)
        e = math.log(1.1)
        relative = [1e-4 * part / math.exp(5 * 0.02) for part in [run.parts.part(name) for name in run.parts.NUMERICAL]]
        np.testing.assert_allclose(
            [relative[0], *relative[2:]], [0.0, 0.5 * e - math.log(0.9), e / math.sqrt(2)], rtol=1e-9
        )
        # two sizes do not extrapolate: the mean of the packings of 2 cm, Roache's bound of two sizes
        self.assertAlmostEqual(math.log(best.value / 1e4), 5 * 0.02 + 0.5 * e, places=9)
        bound = 3 * (5 * 0.02 - 0.5 * e) / 2
        noise = e / math.sqrt(2) / math.sqrt(2)
        self.assertAlmostEqual(best.parts.size / best.value, math.hypot(bound, noise), places=4)

    def test_best_estimate_of_a_plate_lies_on_the_curve_of_its_sizes(self) -> None:
        checks = [
            plate_curve("coarse", math.exp(5 * 0.04), diameter=0.04),
            plate_curve("coarser", math.exp(5 * 0.06), diameter=0.06),
        ]
        run, best = plates.plate_entries(self.base, checks, 0.01)
        self.assertEqual((run.kind, best.kind), (RUN, BEST))
        self.assertAlmostEqual(best.value, 1e4, delta=5.0)
        index = 0.5 * 1.25 * 5 * 0.02  # half of the grid convergence index, of ln p
        series = grid_convergence((0.02, 0.04, 0.06), (0.1, 0.2, 0.3), (1e-3, 1e-3, 1e-3))
        self.assertAlmostEqual(series.index_error, index, delta=1e-3 * index)
        self.assertAlmostEqual(best.parts.size / best.value, series.error, places=3)
        self.assertAlmostEqual(run.parts.size / run.value, math.hypot(5 * 0.02, series.error), places=3)
        self.assertEqual(run.unknown, ["domain", "packing"])
        self.assertEqual(run.quantity.label, "pressure at 10 mm [kPa]")

    def test_packings_reduce_the_error_of_the_best_estimate(self) -> None:
        random, scatter = np.random.default_rng(2), 0.02
        sizes, held, errors = (0.02, 0.04, 0.06), 0, []
        for _ in range(100):
            found = []
            for packings in (2, 6):
                base, *checks = (
                    plate_curve(f"{k}", math.exp(5 * h + random.normal(0, scatter)), diameter=h)
                    for k, h in enumerate(packings * sizes)
                )
                _, best = plates.plate_entries(base, checks, 0.01)
                found.append(best.parts.size / best.value)
            held += abs(math.log(best.value / 1e4)) < 2 * found[1]
            errors.append(found)
        self.assertGreaterEqual(held, 90)  # the order is uncertain too where packings scatter
        few, many = np.mean(errors, axis=0)
        self.assertLess(many, few)

    def test_non_monotonic_series_gives_its_finest_value(self) -> None:
        # ln p at 2, 4, 6 cm: 1, -2, 1 e
        e, sizes = 0.03, (0.02, 0.04, 0.06)
        base, *checks = (
            plate_curve(f"{h}", math.exp(off * e), diameter=h) for h, off in zip(sizes, (1, -2, 1))
        )
        run, best = plates.plate_entries(base, checks, 0.01)
        self.assertAlmostEqual(best.value, run.value, places=9)
        self.assertGreater(best.parts.size / best.value, e)

    def test_one_size_has_no_limit_and_no_value_beyond_its_curve(self) -> None:
        (alone,) = plates.plate_entries(self.base, [], 0.01)
        self.assertEqual((alone.kind, alone.unknown), (RUN, ["size", "domain", "packing"]))
        self.assertEqual(plates.plate_entries(self.base, [], 0.06), [])


if __name__ == "__main__":
    unittest.main()
