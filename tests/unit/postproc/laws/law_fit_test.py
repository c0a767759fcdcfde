# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits of laws to curves that furrow-point computes, and the files of a fit.

tests/unit/io/point_file_test.cpp has the fits that furrow-point refuses.
"""

import json
import math
import unittest
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import h5py
import numpy as np
import yaml

from furrow_post.laws.fitter import Fitted, NotComputed, Parameter
from furrow_post.laws.law_fit import LawFit, fit_law, report
from furrow_post.uncertainty.material_error import intervals
from furrow_post.laws.point_curves import Curve, PointCurves
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_columns
from furrow_post.errors import ResultsError
from support.command import SOURCE, run_post
from support.folder import FolderTest

POINTS = SOURCE / "inputs" / "points"
SAND = "mccormick_sand_exponential"
PC0, LAMBDA = {"hardening.pc0": 0.35e6}, {"hardening.lambda": 0.045}


def named(fit: LawFit, name: str) -> Fitted:
    return next(fitted for fitted in fit.parameters if fitted.parameter.name == name)


class LawFitTest(FolderTest):
    def opened(self, parameters: list[dict[str, Any]], material: str = SAND) -> PointCurves:
        """A fit to confined compression to 12 MPa."""
        stresses = 0.5e6 * np.arange(1, 25)
        rows = "".join(f"{stress},0\n" for stress in stresses)
        (self.folder / "data.csv").write_text(f"stress,eps\n{rows}", encoding="utf-8")
        curve = {
            "title": "synthetic",
            "data": "data.csv",
            "path": {"type": "confined", "steps": 5},
            "drive": {"stress": "stress"},
            "compare": {"eps_vol": "eps"},
        }
        fit = {
            "material": str(SOURCE / f"inputs/materials/{material}.yaml"),
            "parameters": parameters,
            "curves": [curve],
        }
        file = self.folder / "fit.yaml"
        file.write_text(json.dumps(fit), encoding="utf-8")  # JSON is YAML
        point = PointCurves(file)
        self.addCleanup(point.close)
        return point

    def synthetic(self, truth: Mapping[str, float]) -> LawFit:
        """The fit to data that the law itself computes for these values."""
        point = self.opened([{"name": name} for name in truth])
        return fit_law(point.parameters, measured(point, list(truth.values())), point)

    def test_recovers_the_parameters_of_perfect_data(self) -> None:
        truth = {**PC0, **LAMBDA, "elasticity.E": 500e6}
        fit = self.synthetic(truth)
        self.assertTrue(fit.converged, fit.end)
        self.assertLess(fit.rms, 1e-8)
        self.assertGreater(np.sqrt(np.mean(fit.start**2)), 1e-3)
        for name, value in truth.items():
            fitted = named(fit, name)
            self.assertAlmostEqual(fitted.value / value, 1.0, delta=1e-5)
            self.assertTrue(fitted.determined, fitted.remark)
        self.assertEqual([len(curve) for curve in fit.fitted], [24])

    def test_flags_parameters_that_only_a_combination_fixes(self) -> None:
        """With kappa = 0 the hardening depends on (1 + e0)/lambda alone."""
        fit = self.synthetic({**PC0, **LAMBDA, "hardening.e0": 0.5})
        self.assertLess(fit.rms, 1e-8)
        pc0, slope, void = fit.parameters
        self.assertTrue(pc0.determined)
        self.assertAlmostEqual(pc0.value / 0.35e6, 1.0, delta=1e-5)
        for fitted in (slope, void):
            self.assertFalse(fitted.determined)
            self.assertEqual(fitted.deviation, math.inf)
            self.assertEqual(
                fitted.remark,
                "the curves depend only on a combination of hardening.lambda, hardening.e0",
            )
        self.assertAlmostEqual((1 + void.value) / slope.value / (1.5 / 0.045), 1.0, delta=1e-5)
        self.assertLess(fit.singular_values[2], 1e-6 * fit.singular_values[0])

    def test_flags_a_parameter_without_influence(self) -> None:
        """The density has no influence on a quasi-static path."""
        slope, density = self.synthetic({**LAMBDA, "law.density": 1900.0}).parameters
        self.assertTrue(slope.determined)
        self.assertAlmostEqual(slope.value / 0.045, 1.0, delta=1e-6)
        self.assertFalse(density.determined)
        self.assertEqual(density.remark, "the curves do not depend on it")

    def test_parameter_at_its_bound_is_reported(self) -> None:
        point = self.opened([{"name": "hardening.lambda", "lower": 0.001, "upper": 0.04}])
        fit = fit_law(point.parameters, measured(point, [0.045]), point)
        (fitted,) = fit.parameters
        self.assertFalse(fitted.determined)
        self.assertEqual(fitted.remark, "stands at its upper bound 0.04")
        self.assertIn("NOT DETERMINED: stands at its upper bound 0.04", report(point, fit))

    def test_fit_leaves_a_start_at_a_bound(self) -> None:
        point = self.opened(
            [{"name": "hardening.lambda", "start": 0.06, "lower": 0.001, "upper": 0.06}]
        )
        fit = fit_law(point.parameters, measured(point, [0.045]), point)
        self.assertAlmostEqual(fit.parameters[0].value / 0.045, 1.0, delta=1e-6)

    def test_number_of_a_table_can_be_a_parameter(self) -> None:
        point = self.opened([{"name": "hardening.p[6]", "start": 2.2e6}], "mccormick_sand")
        fit = fit_law(point.parameters, measured(point, [2.758e6]), point)  # Table 5, row 6
        self.assertAlmostEqual(fit.parameters[0].value / 2.758e6, 1.0, delta=1e-6)

    def test_refused_start_is_reported_with_its_cause(self) -> None:
        point = self.opened([{"name": "hardening.lambda"}])
        with self.assertRaisesRegex(NotComputed, "keyword 'lambda' is -1.0; allowed: a number > 0"):
            point(np.array([-1.0]))
        with self.assertRaisesRegex(NotComputed, "line has 2 values; allowed: 1, one of each"):
            point(np.array([0.04, 0.05]))
        self.assertEqual(len(point(np.array([0.04]))[0]), 24)
        point._process.kill()
        with self.assertRaisesRegex(ResultsError, "furrow-point ended without a message"):
            point(np.array([0.04]))


class FormulaTest(unittest.TestCase):
    """Fits to formulas in place of furrow-point."""

    X = np.linspace(0.0, 1.0, 6)

    def fit(self, parameter: Parameter, data: Floats, **more: Any) -> LawFit:
        options: dict[str, Any] = {"relative": False, "deviation": 0.0, **more}
        curve = Curve("line", "confined", "x", self.X, "y", "y", data, **options)
        return fit_law([parameter], [curve], self.line)

    def line(self, values: Floats) -> list[Floats]:
        """1 + value x, which exists for values above -0.5."""
        if values[0] <= -0.5:
            raise NotComputed("too small")
        return [1 + values[0] * self.X]

    def test_linear_fit_has_the_error_of_the_closed_form(self) -> None:
        data = 1 + 2 * self.X + np.array([0.01, -0.02, 0.01, 0.03, -0.01, 0.0])
        fit = self.fit(Parameter("slope", "", -0.1, -math.inf, math.inf), data)
        slope = self.X @ (data - 1) / (self.X @ self.X)
        spread = math.sqrt(np.sum((data - 1 - slope * self.X) ** 2) / 5)
        self.assertAlmostEqual(fit.parameters[0].value, slope, delta=1e-8)
        expected = spread / math.sqrt(self.X @ self.X)
        self.assertAlmostEqual(fit.parameters[0].deviation / expected, 1.0, delta=1e-6)

    def test_misfit_beyond_the_deviation_widens_the_error(self) -> None:
        off = np.array([0.01, -0.02, 0.01, 0.03, -0.01, 0.0])
        slope = Parameter("slope", "", 1.0, -math.inf, math.inf)
        unknown = self.fit(slope, 1 + 2 * self.X + off)
        missed = self.fit(slope, 1 + 2 * self.X + off, deviation=0.01)
        self.assertAlmostEqual(missed.parameters[0].deviation, unknown.parameters[0].deviation, delta=1e-9)
        self.assertGreater(missed.scatter, 1.5)
        met = self.fit(slope, 1 + 2 * self.X + off, deviation=0.1)
        self.assertEqual(met.scatter, 1.0)
        self.assertAlmostEqual(met.parameters[0].deviation, 0.1 / math.sqrt(self.X @ self.X), delta=1e-6)

    def test_uncertainties_are_those_of_repeated_measurements(self) -> None:
        """Over 120 repetitions the errors have the standard deviation that the fit states."""
        noise, repetitions = 5e-4, 120
        pressure = 0.5e6 * np.arange(1, 25)
        truth = np.array([0.35e6, 0.045])
        parameters = [
            Parameter("pc0", "Pa", 0.2e6, 0.0, math.inf),
            Parameter("lambda", "", 0.03, 0.0, math.inf),
        ]

        def compression(values: Floats) -> list[Floats]:
            return [values[1] * np.log1p(pressure / values[0])]

        for known in (noise, 0.0):
            random = np.random.default_rng(11)
            square = np.zeros(2)
            for _ in range(repetitions):
                noisy = compression(truth)[0] + noise * random.standard_normal(len(pressure))
                curve = Curve("", "", "p", pressure, "eps", "", noisy, False, known)
                fit = fit_law(parameters, [curve], compression)
                deviation = np.array([fitted.deviation for fitted in fit.parameters])
                square += ((fit.values - truth) / deviation) ** 2 / repetitions
            # Mean of 120 squares of standard normal numbers: 1 ± 0.13, taken four times
            np.testing.assert_allclose(square, 1.0, atol=0.52)

    def test_values_that_cannot_be_computed_shorten_the_step(self) -> None:
        start = Parameter("slope", "", 3.0, -math.inf, math.inf)
        fit = self.fit(start, 1 - 0.49 * self.X)
        self.assertAlmostEqual(fit.parameters[0].value, -0.49, delta=1e-6)

    def test_points_without_a_measured_value_are_left_out(self) -> None:
        data = np.where(self.X < 0.5, math.nan, 1 + 2 * self.X)
        fit = self.fit(Parameter("slope", "", 1.0, 0.1, 10.0), data, relative=True)
        self.assertEqual(len(fit.residuals), 3)
        self.assertAlmostEqual(fit.parameters[0].value, 2.0, delta=1e-6)
        self.assertTrue(np.all(np.isfinite(fit.fitted[0])))

    def test_as_many_data_as_parameters_leave_the_error_unknown(self) -> None:
        data = np.full(6, math.nan)
        data[-1] = 3.0
        (fitted,) = self.fit(Parameter("slope", "", 1.0, 0.1, 10.0), data).parameters
        self.assertTrue(math.isnan(fitted.deviation))
        self.assertIn("no scatter to judge by", fitted.remark)
        (fitted,) = self.fit(Parameter("slope", "", 1.0, 0.1, 10.0), data, deviation=0.1).parameters
        self.assertAlmostEqual(fitted.deviation, 0.1, delta=1e-6)

    def test_start_that_cannot_be_computed_is_refused_with_the_cause(self) -> None:
        with self.assertRaisesRegex(NotComputed, "too small"):
            self.fit(Parameter("slope", "", -0.6, -math.inf, math.inf), self.X)
        with self.assertRaisesRegex(NotComputed, "y is -1 and is compared in logarithms"):
            fit_law(
                [Parameter("slope", "", 1.0, 0.1, 10.0)],
                [Curve("line", "", "", self.X, "y", "", self.X + 1, True, 0.0)],
                lambda values: [1 - 2 * values[0] * self.X],
            )


class ShippedFitsTest(FolderTest):
    def shipped(self, name: str) -> LawFit:
        with PointCurves(POINTS / f"fit_{name}.yaml") as point:
            fit = fit_law(point.parameters, point.curves, point)
        self.assertTrue(fit.converged)
        return fit

    def test_tables_agree_with_the_oedometer_within_its_error(self) -> None:
        for name, limit in (("abele_gow_table", 0.1), ("cam_clay", 0.15)):  # deviations of 3 %
            fit = self.shipped(name)
            self.assertLess(fit.rms, limit)
            self.assertTrue(all(fitted.determined for fitted in fit.parameters))

    def test_oedometer_does_not_determine_the_friction_angle(self) -> None:
        fit = self.shipped("abele_gow")
        self.assertLess(fit.rms, 0.03)  # of ln(rho)
        self.assertTrue(named(fit, "hardening.lambda").determined)
        self.assertFalse(named(fit, "law.beta").determined)

    def test_foam_has_the_value_of_its_material_file(self) -> None:
        fit = self.shipped("foam")
        self.assertLess(fit.rms, 0.04)  # of ln(rho)
        self.assertTrue(named(fit, "hardening.lambda").determined)
        self.assertAlmostEqual(named(fit, "hardening.lambda").value, 0.381338, delta=1e-5)

    def test_files_of_a_fit_agree(self) -> None:
        results = self.folder / "fit"
        done = run_post("fit", "law", POINTS / "fit_mccormick.yaml", "-o", results, "--no-plot")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn((results / "report.txt").read_text(encoding="utf-8"), done.stdout)
        self.assertRegex(
            done.stdout,
            "NOT DETERMINED: the curves depend only on a combination of hardening.lambda, "
            r"hardening.e0\n(.|\n)*scatter of the data from the residuals",
        )
        table = read_columns(results / "fit.csv")
        data = read_columns(SOURCE / "inputs/validation/mccormick_ranch_sand/reference.csv")
        np.testing.assert_array_equal(table["measured"], data["eps_vol_pl"])
        self.assertLess(np.sqrt(np.mean((table["fitted"] - table["measured"]) ** 2)), 0.01)
        material = yaml.safe_load((results / "material.yaml").read_text(encoding="utf-8"))
        with h5py.File(results / "fit.h5") as content:
            np.testing.assert_array_equal(content["curves/0/fitted"][...], table["fitted"])
            pc0 = content["parameters/hardening.pc0"].attrs
            slope = content["parameters/hardening.lambda"].attrs
            self.assertEqual(float(material["hardening"]["pc0"]), pc0["value"])
            self.assertEqual((pc0["determined"], slope["determined"]), (1.0, 0.0))
            (interval,) = intervals(results / "material.yaml")  # of what the data determine alone
            self.assertEqual((interval.name, interval.value), ("hardening.pc0", pc0["value"]))
            self.assertAlmostEqual(interval.error / pc0["deviation"], 1.0)
        self.assertEqual(sorted(results.glob("*.part")), [])

    def test_law_that_misses_the_data_by_more_than_two_deviations_is_reported(self) -> None:
        with PointCurves(POINTS / "fit_cam_clay.yaml") as point:
            fit = fit_law(point.parameters, point.curves, point)

            def reported(rms: float) -> str:
                return report(point, replace(fit, residuals=np.full(9, rms)))

            self.assertNotIn("cannot follow", reported(1.9))
            self.assertIn(
                "this law cannot follow the data: the rms residual is 2.1 deviations", reported(2.1)
            )

    def test_refused_file_leaves_no_results(self) -> None:
        results = self.folder / "fit"
        done = run_post("fit", "law", POINTS / "snow_rut.yaml", "-o", results)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(
            done.stderr, "^furrow-post: .*it looks like a point file with a path to drive"
        )
        self.assertFalse(results.exists())
        done = run_post("fit", "law", self.folder / "absent.yaml")
        self.assertIn("absent.yaml does not exist", done.stderr)


def measured(point: PointCurves, truth: Any) -> list[Curve]:
    """The curves, with values of the law as the measured ones."""
    return [
        replace(curve, measured=values)
        for curve, values in zip(point.curves, point(np.array(truth)))
    ]


if __name__ == "__main__":
    unittest.main()
