# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits of tyre files to a stand-in of furrow-tyre, whose states follow from a formula.

tests/unit/postproc/drivers/tyre_files_test.py has fits by furrow-tyre.
"""

import math
import tempfile
import unittest
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import yaml

from furrow_post.laws.fitter import NotComputed
from furrow_post.laws.tyre_estimate import Catalogue, guesses, hub_mass, tyre_text
from furrow_post.laws.tyre_fit import MEASURED, Mesh, PlateTest, fit_tyre, read_tests
from furrow_post.laws.tyre_size import INCH, read_size
from furrow_post.errors import ResultsError

KNOWN = Catalogue(read_size("235/75R15"), 241e3, rim_width=6.5 * INCH, diameter=0.737)
LOADS = (2000.0, 6000.0)
PRESSURES = (100.0, 250.0)


def formula(text: str, tests: Sequence[PlateTest], mesh: Mesh) -> list[dict[str, float]]:
    """Powers of the tyre's values; a coarse mesh is 3 % off."""
    tyre = yaml.safe_load(text)
    tread, sidewall = tyre["tread"], tyre["sidewall"]
    coarse = 1.03 if mesh[1] < 72 else 1.0
    belts, springs = tread["E1"] / 3.62e10, sidewall["rim_stiffness"] / 50.0
    width, length, radius = tread["half_width"], sidewall["length"], tread["radius"]
    states = []
    for test in tests:
        share = test.load / (test.pressure * 1e3) / (4.0 * width * radius)
        deflection = (
            coarse * radius * share**0.8 * (length / 0.16) * springs**-0.02 / belts**0.1
        )
        area = 4.0 * width * math.sqrt(2.0 * radius * deflection) / belts**0.05
        states.append(
            {
                "deflection_cm": 100.0 * deflection,
                "perimeter_area_cm2": 1e4 * area,
                "section_width_cm": 100.0 * (0.1 + length * (1.0 + share) ** 0.3),
            }
        )
    return states


def text_of(shifts: Sequence[float]) -> str:
    start = guesses(KNOWN)
    values = {
        name: guess.value * math.exp(guess.spread * shift)
        for (name, guess), shift in zip(start.items(), shifts)
    }
    return tyre_text("true", [], KNOWN, values, {name: "" for name in start})


def measure(
    shifts: Sequence[float], quantities: Sequence[str], noise: np.random.Generator | None = None
) -> list[PlateTest]:
    """Tests of a tyre that lies so many spreads from the guess."""
    states = [
        PlateTest(p, load, dict.fromkeys(quantities, 1.0)) for p in PRESSURES for load in LOADS
    ]
    tests = []
    for test, state in zip(states, formula(text_of(shifts), states, (4, 72))):
        values = {
            name: state[name] * math.exp(MEASURED[name] * noise.standard_normal() if noise else 0.0)
            for name in quantities
        }
        tests.append(PlateTest(test.pressure, test.load, values))
    return tests


class FitTest(unittest.TestCase):
    def test_determined_parameters_are_recovered(self) -> None:
        shifts = (0.0, -1.2, 1.0, 0.0, 0.0)
        fit = fit_tyre(KNOWN, measure(shifts, tuple(MEASURED)), formula)
        for parameter, shift in zip(fit.parameters, shifts):
            true = parameter.guess.value * math.exp(parameter.guess.spread * shift)
            with self.subTest(name=parameter.name):
                self.assertLess(abs(math.log(parameter.value / true)), parameter.error)
        self.assertLess(max(fit.misfits().values()), 0.01)
        found = {parameter.name: parameter for parameter in fit.parameters}
        self.assertEqual(found["half_width"].verdict(), "determined by the tests")
        self.assertEqual(found["sidewall_stiffness"].verdict(), "guess")
        self.assertEqual(fit.stretch, 1.0)

    def test_parameters_without_tests_are_estimates(self) -> None:
        fit = fit_tyre(KNOWN, [], formula)
        for parameter in fit.parameters:
            self.assertEqual(parameter.value, parameter.guess.value)
            self.assertEqual(parameter.error, parameter.guess.spread)
            self.assertEqual(parameter.verdict(), "guess")
        self.assertEqual(len(fit.singular_values), 0)

    def test_one_deflection_determines_one_combination(self) -> None:
        tests = measure((0.0, 0.0, 0.0, 0.0, 0.0), ("deflection_cm",))[:1]
        fit = fit_tyre(KNOWN, tests, formula)
        self.assertEqual(sum(value > 1.0 for value in fit.singular_values), 1)
        self.assertLess(sum(parameter.determined for parameter in fit.parameters), 1.0)

    def test_standard_errors_are_those_of_repeated_measurements(self) -> None:
        """Tyres drawn about the guess, tests with their errors: (found - true)/error has a variance
        of 1."""
        noise = np.random.default_rng(5)
        scores: list[float] = []
        while len(scores) < 200:
            shifts = [float(shift) for shift in noise.standard_normal(5)]
            try:
                text_of(shifts)
            except ResultsError:  # rim, tread and section do not fit together
                continue
            fit = fit_tyre(KNOWN, measure(shifts, tuple(MEASURED), noise), formula)
            for parameter, shift in zip(fit.parameters, shifts):
                true = parameter.guess.value * math.exp(parameter.guess.spread * shift)
                scores.append(math.log(parameter.value / true) / parameter.error)
        variance = float(np.mean(np.square(scores)))
        # 200 scores: a standard error of 0.1 if they were independent, 0.22 if a fit gave one
        self.assertGreater(variance, 0.6)
        self.assertLess(variance, 1.4)

    def test_misfit_beyond_the_errors_enlarges_them(self) -> None:
        tests = measure((0.0, 0.0, 0.0, 0.0, 0.0), tuple(MEASURED))
        good = fit_tyre(KNOWN, tests, formula)
        for test, factor in zip(tests, (1.2, 0.83, 0.83, 1.2)):
            test.measured["deflection_cm"] *= factor
        bad = fit_tyre(KNOWN, tests, formula)
        self.assertGreater(bad.stretch, 2.0)
        width = [fit.parameters[1].error for fit in (good, bad)]
        self.assertGreater(width[1], 1.5 * width[0])

    def test_unsettled_trial_tyres_are_skipped(self) -> None:
        def fragile(text: str, tests: Sequence[PlateTest], mesh: Mesh) -> list[dict[str, float]]:
            if (
                yaml.safe_load(text)["tread"]["half_width"]
                > 1.02 * guesses(KNOWN)["half_width"].value
            ):
                raise NotComputed("the tyre does not come to rest")
            return formula(text, tests, mesh)

        tests = measure((0.0, -1.0, 0.0, 0.0, 0.0), tuple(MEASURED))
        fit = fit_tyre(KNOWN, tests, fragile)
        true = fit.parameters[1].guess.value * math.exp(-fit.parameters[1].guess.spread)
        self.assertLess(abs(math.log(fit.parameters[1].value / true)), fit.parameters[1].error)

    def test_other_errors_end_the_fit(self) -> None:
        def broken(*_: object) -> list[dict[str, float]]:
            raise ResultsError("there is no program furrow-tyre")

        with self.assertRaisesRegex(ResultsError, "no program"):
            fit_tyre(KNOWN, measure((0.0,) * 5, ("deflection_cm",)), broken)


class EstimateTest(unittest.TestCase):
    def test_scaling_to_the_same_size_changes_nothing(self) -> None:
        """inputs/tyres/p235_75r15.yaml from its section, tread and diameter: the same stiffnesses."""
        known = Catalogue(
            read_size("235/75R15"), 241e3, 6.5 * INCH, 0.737, 0.229, 0.157, 0.021, mass=None
        )
        values = {name: guess.value for name, guess in guesses(known).items()}
        text = tyre_text("x", [], known, values, {name: "" for name in values})
        made = yaml.safe_load(text)
        there = Path(__file__).resolve().parents[4] / "inputs" / "tyres" / "p235_75r15.yaml"
        tyre = yaml.safe_load(there.read_text(encoding="utf-8"))
        for section, key, tolerance in (
            ("tyre", "bead_radius", 0.01),
            ("tyre", "bead_spacing", 0.01),
            ("tread", "radius", 0.002),
            ("tread", "half_width", 0.001),
            ("tread", "thickness", 0.001),
            ("tread", "E1", 0.001),
            ("tread", "E2", 0.001),
            ("tread", "areal_mass", 0.001),
            ("sidewall", "length", 0.03),
            ("sidewall", "rim_stiffness", 0.001),
            ("sidewall", "tread_stiffness", 0.001),
        ):
            with self.subTest(section=section, key=key):
                ratio = float(made[section][key]) / float(tyre[section][key])
                self.assertLess(abs(ratio - 1.0), tolerance)
        np.testing.assert_allclose(
            made["sidewall"]["bending"], tyre["sidewall"]["bending"], rtol=1e-3
        )

    def test_sidewall_is_an_arc_of_the_section_width(self) -> None:
        values = {name: guess.value for name, guess in guesses(KNOWN).items()}
        text = tyre_text("x", [], KNOWN, values, {name: "" for name in values})
        tyre = yaml.safe_load(text)
        sidewall = tyre["sidewall"]
        angles = np.radians(np.linspace(sidewall["rim_angle"], sidewall["tread_angle"], 2001))
        step = sidewall["length"] / len(angles)
        axial = 0.5 * tyre["tyre"]["bead_spacing"] + np.cumsum(step * np.cos(angles))
        radius = tyre["tyre"]["bead_radius"] + np.cumsum(step * np.sin(angles))
        self.assertAlmostEqual(float(axial[-1]), tyre["tread"]["half_width"], delta=3e-4)
        self.assertAlmostEqual(float(radius[-1]), tyre["tread"]["radius"], delta=3e-4)
        self.assertAlmostEqual(2.0 * float(axial.max()), 0.235, delta=5e-4)

    def test_mass_is_the_sum_of_tread_and_hub(self) -> None:
        known = Catalogue(read_size("235/75R15"), 241e3, mass=14.0)
        values = {name: guess.value for name, guess in guesses(known).items()}
        tyre = yaml.safe_load(
            tyre_text("x", [], known, values, {name: "" for name in values})
        )
        tread = tyre["tread"]
        area = 4.0 * math.pi * tread["radius"] * tread["half_width"]
        self.assertAlmostEqual(
            tread["areal_mass"] * area + (hub_mass(known) or 0.0), 14.0, delta=0.02
        )

    def test_rim_wider_than_the_section_is_refused(self) -> None:
        known = Catalogue(read_size("235/75R15"), 241e3, rim_width=10 * INCH)
        values = {name: guess.value for name, guess in guesses(known).items()}
        with self.assertRaisesRegex(ResultsError, "a section is wider than both"):
            tyre_text("x", [], known, values, {name: "" for name in values})


class ReadTest(unittest.TestCase):
    def read(self, text: str) -> list[PlateTest]:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "tests.csv"
            path.write_text(text, encoding="utf-8")
            return read_tests(path)

    def test_output_of_furrow_tyre_is_read_as_a_test(self) -> None:
        tests = self.read(
            "pressure_kPa,load_N,deflection_cm,perimeter_area_cm2\n241,0,0,0\n241,6227,3.1,\n"
        )
        self.assertEqual(tests, [PlateTest(241.0, 6227.0, {"deflection_cm": 3.1})])

    def test_other_tables_are_refused(self) -> None:
        for text, message in (
            ("pressure_kPa,deflection_cm\n241,3\n", "no column load_N"),
            ("pressure_kPa,load_N,x\n241,6227,1\n", "one of deflection_cm"),
            ("pressure_kPa,load_N,deflection_cm\n-1,6227,3\n", "above 0"),
            ("pressure_kPa,load_N,deflection_cm\n241,6227,-3\n", "must be above 0"),
            ("pressure_kPa,load_N,deflection_cm\n241,6227,much\n", "could not convert"),
        ):
            with self.subTest(text=text), self.assertRaisesRegex(ResultsError, message):
                self.read(text)


if __name__ == "__main__":
    unittest.main()
