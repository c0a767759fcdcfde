# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas against closed forms, an independent quadrature and measurements; their refusals."""

import math
import unittest
from pathlib import Path

import numpy as np

from furrow_post.laws import empirical
from furrow_post.laws.prediction import OutOfRange
from furrow_post.laws.terrain_values import terrain
from furrow_post.uncertainty.statistics import rms
from furrow_post.csv_table import read_numbers, read_rows
from furrow_post.errors import ResultsError
from support.command import SOURCE, run_post


def reference(case: str) -> Path:
    return SOURCE / "inputs" / "validation" / case / "reference.csv"


class SnowTest(unittest.TestCase):
    def test_sinkage_is_the_density_ratio(self) -> None:
        # (0.519 + 0.0023 * 100) Mg/m3 = 749 kg/m3; the cap of ice from 173 kPa on
        expected = 0.3 * (1 - 200 / 749)
        self.assertAlmostEqual(empirical.nrmm_sinkage(0.3, 200.0, 100e3), expected, places=12)
        self.assertEqual(empirical.nrmm_final_density(500e3), 917.0)
        self.assertLess(empirical.nrmm_final_density(172e3), 917.0)

    def test_half_sunk_wheel_has_its_resistance(self) -> None:
        # z = r: the arc is a quarter of the circle; up to 150 kg/m3 deep snow counts once
        expected = 13.6041 * (120 * 0.25 * 0.4 * math.pi / 2) ** 1.26
        found = empirical.nrmm_resistance(120, 0.25, 0.4, 0.4)
        self.assertAlmostEqual(found / expected, 1, places=12)
        shallow, deep, before, deeper = (
            empirical.nrmm_resistance(200, 0.25, 0.39, z) for z in (0.2599, 0.2601, 0.3899, 0.3901)
        )
        self.assertAlmostEqual(deep / shallow, 1.5, delta=2e-3)
        self.assertAlmostEqual(deeper / before, 2.5 / 1.5, delta=2e-3)

    def test_factors_of_deep_snow_can_depend_on_depth(self) -> None:
        z = 0.12
        plain = empirical.nrmm_resistance(200, 0.25, 0.39, z)
        for depth, factor in ((0.25, 1.0), (0.27, 1.5), (0.38, 1.5), (0.40, 2.5)):
            found = empirical.nrmm_resistance(200, 0.25, 0.39, z, depth)
            self.assertAlmostEqual(found / plain, factor, places=12)

    def test_values_outside_the_tests_are_refused(self) -> None:
        message = "density 300 kg/m3, allowed 105 to 225 .*Table 11.*--extrapolate"
        with self.assertRaisesRegex(OutOfRange, message):
            empirical.nrmm(6240, 0.37, 0.272, 0.2, 300, 179e3)
        prediction = empirical.nrmm(6240, 0.37, 0.272, 0.2, 300, 179e3, extrapolate=True)
        self.assertEqual(len(prediction.outside), 1)
        self.assertIn("EXTRAPOLATED: density 300", prediction.report())

    def test_scatter_equals_that_of_the_measurements(self) -> None:
        rows = read_numbers(reference("snow_wheel"))
        self.assertGreater(len(rows), 20)
        coefficient, sinkage = [], []
        for r in rows:
            density, z = r["density_kgm3"], r["sinkage_m"]
            computed = empirical.nrmm_resistance(density, 0.272, 0.38, z) / 6240
            coefficient.append(computed - r["resistance"])
            sinkage.append(empirical.nrmm_sinkage(r["depth_m"], density, 179e3) - z)
        known = empirical.NRMM_COEFFICIENT_RMS, empirical.NRMM_SINKAGE_RMS
        self.assertAlmostEqual(rms(coefficient), known[0], delta=0.0005)
        self.assertAlmostEqual(rms(sinkage), known[1], delta=0.00005)


class SnowTractionTest(unittest.TestCase):
    """CRREL Report 95-1, Appendix A: the vehicle file of the M113 and Table A5."""

    WEIGHT = 23401 * 4.4482216  # [N]
    AREA = 2 * 15 * 105 * 0.0254**2  # [m2] of two tracks, in inches

    def test_gross_traction_equals_table_a5(self) -> None:
        printed = {"undisturbed": 44134.3, "packed": 29692.1, "ice": 16741.3}
        for surface, traction in printed.items():
            found = empirical.snow_traction(surface, self.WEIGHT, self.AREA)
            self.assertAlmostEqual(found.gross / traction, 1, delta=2e-5, msg=surface)
            self.assertAlmostEqual(found.coefficient * self.WEIGHT / traction, 1, delta=2e-5)

    def test_load_on_a_slope_is_its_normal_part(self) -> None:
        # example 2, 30 degrees: the ratio to example 1 depends on the exponent alone
        load = self.WEIGHT * math.cos(math.radians(30))
        found = empirical.snow_traction("undisturbed", load, self.AREA)
        self.assertAlmostEqual(found.gross / 39207.1, 1, delta=2e-5)

    def test_impossible_units_of_a_wheel_are_refused(self) -> None:
        with self.assertRaisesRegex(ResultsError, "a contact pressure of 6.2 Pa; allowed: 5000 to 2e"):
            empirical.snow_traction("ice", 6.2, 1.0)
        with self.assertRaisesRegex(ResultsError, "no surface 'slush'; there are undisturbed, packed, ice"):
            empirical.snow_traction("slush", 6e3, 0.05)


class SandTest(unittest.TestCase):
    def test_bekker_carries_its_load(self) -> None:
        # the sinkage's own equation: W = b k sqrt(D) z^(n + 1/2) (3 - n)/3; and the work of
        # compaction per length is the resistance
        ground = terrain("LETE sand")
        p = empirical.bekker(5000, 0.9, 0.25, ground)
        k = 102e3 / 0.25 + 5301e3
        load = 0.25 * k * math.sqrt(0.9) * p.sinkage**1.29 * (3 - 0.79) / 3
        self.assertAlmostEqual(load / 5000, 1, places=10)
        z = np.linspace(0, p.sinkage, 20001)
        work = 0.25 * np.trapz(ground.plate_pressure(z, 0.25), z)
        self.assertAlmostEqual(p.resistance / float(work), 1, places=5)

    def test_wong_reece_agrees_with_an_independent_quadrature(self) -> None:
        names = {"compact": "Wong-Reece compact sand", "loose": "Wong-Reece loose sand"}
        rows = read_rows(reference("wong_reece"))
        self.assertEqual(len(rows), 27)
        for row in rows:
            load, radius, width, slip = (float(row[key]) for key in ("W_N", "r_m", "b_m", "slip"))
            ground = terrain(names[row["case"].split("_")[0]])
            p = empirical.wong_reece(load, 2 * radius, width, slip, ground, extrapolate=True)
            values = {result.name: result.value for result in p.extra}
            # the table has four places
            self.assertAlmostEqual(p.sinkage, float(row["sinkage_m"]), delta=1e-4, msg=str(row))
            pull, torque = float(row["DP_N"]), float(row["torque_Nm"])
            self.assertAlmostEqual(values["drawbar pull"], pull, delta=1.6, msg=str(row))
            self.assertAlmostEqual(values["torque"], torque, delta=1.6, msg=str(row))

    def test_faults_are_refused(self) -> None:
        lete, compact = terrain("LETE sand"), terrain("Wong-Reece compact sand")
        with self.assertRaisesRegex(OutOfRange, "diameter 0.3 m, allowed at least 0.5 .*50 cm"):
            empirical.bekker(200, 0.3, 0.15, lete)
        self.assertTrue(empirical.bekker(200, 0.3, 0.15, lete, extrapolate=True).outside)
        with self.assertRaisesRegex(ResultsError, "K, c1, c2 of 'LETE sand' are not known"):
            empirical.wong_reece(5000, 1.2, 0.3, 0.1, lete)
        with self.assertRaisesRegex(OutOfRange, "driven wheels, slip from 0 to 1, not -0.1"):
            empirical.wong_reece(5000, 1.2, 0.3, -0.1, compact, extrapolate=True)
        with self.assertRaisesRegex(ResultsError, "no terrain 'moon'; name a soil card, or one of LLL dry sand"):
            terrain("moon")
        with self.assertRaisesRegex(ResultsError, "6 N on a wheel of 0.9 m x 0.35 m are 19 Pa over diameter and width"):
            empirical.bekker(6, 0.9, 0.35, lete)

    def test_given_numbers_are_options_and_assumed_ones_are_printed(self) -> None:
        """The values are those of an independent quadrature."""
        wheel = "--load 400 --diameter 0.5 --width 0.16 --slip 0.2".split()
        soil = "--k_phi 3.2e6 --n 1.4 --c 140 --phi 35 --K 0.01".split()
        for place, sinkage, pull, torque in (("--c1 0.43 --c2 0.32", 47.6, 97.45, 54.27), ("", 38.8, 130.8, 55.16)):
            done = run_post("empirical", "wong_reece", *wheel, *soil, *place.split())
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"sinkage                {sinkage:.1f} mm", done.stdout)
            self.assertIn(f"drawbar pull           {pull:.4g} N", done.stdout)
            self.assertIn(f"torque                 {torque:.2f} N m", done.stdout)
            self.assertEqual("assumed      c1 0.18, that of Wong-Reece loose sand; give --c1" in done.stdout, not place)
            self.assertIn("ground       k_c 0, k_phi 3.2e+06, n 1.4, c 140, phi 35, K 0.01, c1 0.", done.stdout)
        for words, message in (
            (soil[:-2], "empirical wong_reece needs --terrain, or --K as well"),
            ([*soil[:-1], "10"], "K is 10 m; soils and snow have"),
            (["--terrain", "Wong-Reece loose sand", "--n", "1.1"], "has the law of Reece; give --k_phi and --n without"),
        ):
            self.assertIn(message, run_post("empirical", "wong_reece", *wheel, *words).stderr)

    def test_card_is_used_within_its_plates(self) -> None:
        card = terrain(str(SOURCE / "inputs" / "soils" / "dry_sand_smooth.yaml"))
        self.assertFalse(empirical.bekker(3000, 0.74, 0.272, card).outside)
        with self.assertRaisesRegex(OutOfRange, "sinkage 0.*allowed 0 to 0.0598.* .the plates of the card"):
            empirical.bekker(9000, 0.74, 0.272, card)
        self.assertIn("plates", str(empirical.wong_reece(9000, 0.74, 0.272, 0.1, card, extrapolate=True).outside))
        with self.assertRaisesRegex(ResultsError, "does not resist under a contact 0.009 m wide"):
            card.modulus(0.009)


if __name__ == "__main__":
    unittest.main()
