# SPDX-License-Identifier: GPL-2.0-or-later
"""The fitter against closed forms: priors, rows held out, further samples, intervals, cheap slopes."""

import math
import unittest

import numpy as np

from furrow_post.laws.fitter import NotComputed, Parameter, Search, assess, fit, plain
from furrow_post.arrays import Floats

X = np.linspace(0.1, 1.0, 10)
SLOPE = [Parameter("slope", "", 1.0, -math.inf, math.inf)]


def line(data: Floats, deviation: float = 1.0):  # type: ignore[no-untyped-def]
    return lambda values: (values[0] * X - data) / deviation


class FitterTest(unittest.TestCase):
    def test_prior_is_weighted_by_its_variance(self) -> None:
        """The posterior of a line has a closed form."""
        data, s, t = 2.0 * X + 0.01 * np.sin(9 * X), 0.1, 0.5
        found = fit([Parameter("slope", "", 1.0, -math.inf, math.inf, spread=t)], line(data, s))
        precision = X @ X / s**2 + 1 / t**2
        (one,) = found.parameters
        self.assertAlmostEqual(one.value, (X @ data / s**2 + 1.0 / t**2) / precision, places=6)
        self.assertAlmostEqual(one.deviation, precision**-0.5, places=6)
        self.assertAlmostEqual(one.share, 1 - 1 / (precision * t**2), places=6)

    def test_parameter_without_data_is_its_prior(self) -> None:
        parameter = Parameter("a", "", 3.0, -math.inf, math.inf, spread=0.2)
        (one,) = assess([parameter], np.array([1.0]), np.zeros(0), np.zeros((0, 1))).parameters
        self.assertEqual((one.value, one.share), (3.0, 0.0))
        self.assertAlmostEqual(one.deviation, 0.6)  # of z, in units of the start

    def test_rows_held_out_do_not_move_the_fit_and_are_predicted(self) -> None:
        data = 2.0 * X
        data[-2:] += 0.3
        held = np.arange(10) > 7
        found = fit(SLOPE, line(data), held=held)
        self.assertAlmostEqual(found.values[0], 2.0, places=8)
        self.assertLess(found.rms, 1e-8)
        self.assertAlmostEqual(found.rms_held, 0.3)
        self.assertEqual((len(found.residuals), len(found.start)), (8, 10))

    def test_further_samples_widen_the_errors_by_their_scatter(self) -> None:
        found = fit(SLOPE, line(2.0 * X, 0.1))
        noise = np.random.default_rng(4).normal(0.0, 3.0, (40, 10))
        wider = found.with_samples(list(found.residuals + noise))
        ratio = wider.parameters[0].deviation / found.parameters[0].deviation
        self.assertAlmostEqual(ratio, 3.0, delta=0.25)  # of 400 numbers

    def test_intervals_have_their_stated_coverage(self) -> None:
        noise, truth = np.random.default_rng(7), 5.0
        parameter = [Parameter("k", "", 1.0, 0.0, math.inf)]
        inside = 0
        for _ in range(300):
            data = truth * X * np.exp(0.2 * noise.standard_normal(10))
            found = fit(parameter, lambda values, data=data: np.log(values[0] * X / data) / 0.2)  # type: ignore[misc]
            low, high = found.parameters[0].interval(0.9)
            inside += low < truth < high
        self.assertAlmostEqual(inside / 300, 0.9, delta=0.05)

    def test_several_tests_share_their_parameters(self) -> None:
        """Loads of two plates: k_c and k_phi, of which one plate gives a combination alone."""
        def plates(radii: tuple[float, ...]) -> Floats:
            one = fit(plain((1.0, 1.0), (0, 0), (9, 9)), lambda v: np.concatenate([v[0] * X / b + v[1] * X - (3 / b + 2) * X for b in radii]))
            return np.array([*one.values, sum(p.determined for p in one.parameters)])

        np.testing.assert_allclose(plates((0.5, 1.0)), (3.0, 2.0, 2), atol=1e-6)
        self.assertEqual(plates((0.5,))[2], 0)

    def test_updated_slopes_reach_the_same_solution_with_fewer_evaluations(self) -> None:
        data = 3.0 * X**0.7
        parameters = [Parameter("a", "", 1.0, 0.1, 10.0), Parameter("n", "", 1.0, 0.1, 3.0)]
        residuals = lambda v: np.log(v[0] * X ** v[1] / data)  # noqa: E731
        exact = fit(parameters, residuals, Search(central=False))
        cheap = fit(parameters, residuals, Search(central=False, update=True, xtol=1e-8))
        np.testing.assert_allclose(cheap.values, exact.values, rtol=1e-5)
        self.assertLess(cheap.evaluations, exact.evaluations)

    def test_failed_evaluations_are_skipped(self) -> None:
        def residuals(values: Floats) -> Floats:
            if values[0] > 2.5:
                raise NotComputed("too steep")
            return np.asarray(values[0] * X - 2.4 * X)

        self.assertAlmostEqual(fit(SLOPE, residuals, Search(step=0.3, central=False)).values[0], 2.4, places=5)


if __name__ == "__main__":
    unittest.main()
