# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow_post.empirical against closed forms, an independent quadrature and measurements; refusals with their words."""

import csv
import math
import os
import sys
import unittest
from pathlib import Path

SOURCE = Path(os.environ["FURROW_SOURCE"])
sys.path.insert(0, str(SOURCE / "postproc"))

import numpy as np

from furrow_post import empirical
from furrow_post.results import ResultsError


def reference(case):
    with open(SOURCE / "inputs" / "validation" / case / "reference.csv", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Snow(unittest.TestCase):
    def test_sinkage_is_the_density_ratio(self):
        # (0.519 + 0.0023 * 100) Mg/m3 = 749 kg/m3; the cap of ice from 173 kPa on
        self.assertAlmostEqual(empirical.nrmm_sinkage(0.3, 200.0, 100e3), 0.3 * (1 - 200 / 749), places=12)
        self.assertEqual(empirical.nrmm_final_density(500e3), 917.0)
        self.assertLess(empirical.nrmm_final_density(172e3), 917.0)

    def test_resistance_of_a_half_sunk_wheel(self):
        # z = r: the arc is a quarter of the circle; up to 150 kg/m3 deep snow counts once
        expected = 13.6041 * (120 * 0.25 * 0.4 * math.pi / 2) ** 1.26
        self.assertAlmostEqual(empirical.nrmm_resistance(120, 0.25, 0.4, 0.4) / expected, 1, places=12)
        shallow = empirical.nrmm_resistance(200, 0.25, 0.39, 0.2599)
        deep, deeper = (empirical.nrmm_resistance(200, 0.25, 0.39, z) for z in (0.2601, 0.3901))
        self.assertAlmostEqual(deep / shallow, 1.5, delta=2e-3)
        before = empirical.nrmm_resistance(200, 0.25, 0.39, 0.3899)
        self.assertAlmostEqual(deeper / before, 2.5 / 1.5, delta=2e-3)

    def test_refuses_what_its_tests_do_not_cover(self):
        with self.assertRaisesRegex(empirical.OutOfRange, "density 300 kg/m3, allowed 110 to 220 .*Table 11.*--extrapolate"):
            empirical.nrmm(6240, 0.37, 0.272, 0.2, 300, 179e3)
        prediction = empirical.nrmm(6240, 0.37, 0.272, 0.2, 300, 179e3, extrapolate=True)
        self.assertEqual(len(prediction.outside), 1)
        self.assertIn("EXTRAPOLATED: density 300", empirical.text(prediction))

    def test_scatter_is_that_of_the_measurements(self):
        rows = [{k: float(v) for k, v in row.items()} for row in reference("snow_wheel")]
        self.assertGreater(len(rows), 20)
        coefficient = [empirical.nrmm_resistance(r["density_kgm3"], 0.272, 0.38, r["sinkage_m"]) / 6240 - r["resistance"] for r in rows]
        sinkage = [empirical.nrmm_sinkage(r["depth_m"], r["density_kgm3"], 179e3) - r["sinkage_m"] for r in rows]
        rms = lambda values: float(np.sqrt(np.mean(np.square(values))))
        self.assertAlmostEqual(rms(coefficient), empirical.NRMM_COEFFICIENT_RMS, delta=0.0005)
        self.assertAlmostEqual(rms(sinkage), empirical.NRMM_SINKAGE_RMS, delta=0.00005)


class Sand(unittest.TestCase):
    def test_bekker_carries_its_load(self):
        # the sinkage's own equation: W = b k sqrt(D) z^(n + 1/2) (3 - n)/3; and the work of compaction per length is the resistance
        ground = empirical.terrain("LETE sand")
        p = empirical.bekker(5000, 0.9, 0.25, ground)
        k = 102e3 / 0.25 + 5301e3
        self.assertAlmostEqual(0.25 * k * math.sqrt(0.9) * p.sinkage ** 1.29 * (3 - 0.79) / 3 / 5000, 1, places=10)
        z = np.linspace(0, p.sinkage, 20001)
        work = 0.25 * np.trapz(ground.plate_pressure(z, 0.25), z)
        self.assertAlmostEqual(p.resistance / work, 1, places=5)

    def test_wong_reece_against_an_independent_quadrature(self):
        names = {"compact": "Wong-Reece compact sand", "loose": "Wong-Reece loose sand"}
        rows = reference("wong_reece")
        self.assertEqual(len(rows), 27)
        for row in rows:
            p = empirical.wong_reece(float(row["W_N"]), 2 * float(row["r_m"]), float(row["b_m"]), float(row["slip"]),
                                     empirical.terrain(names[row["case"].split("_")[0]]), extrapolate=True)
            values = dict((name, value) for name, value, _ in p.extra)
            self.assertAlmostEqual(p.sinkage, float(row["sinkage_m"]), delta=1e-4, msg=row)  # the table has four places
            self.assertAlmostEqual(values["drawbar pull"], float(row["DP_N"]), delta=1.6, msg=row)
            self.assertAlmostEqual(values["torque"], float(row["torque_Nm"]), delta=1.6, msg=row)

    def test_refusals(self):
        with self.assertRaisesRegex(empirical.OutOfRange, "diameter 0.3 m, allowed at least 0.5 .*below 50 cm"):
            empirical.bekker(200, 0.3, 0.15, empirical.terrain("LETE sand"))
        self.assertTrue(empirical.bekker(200, 0.3, 0.15, empirical.terrain("LETE sand"), extrapolate=True).outside)
        with self.assertRaisesRegex(ResultsError, "K, c1, c2 of 'LETE sand' are not known"):
            empirical.wong_reece(5000, 1.2, 0.3, 0.1, empirical.terrain("LETE sand"))
        with self.assertRaisesRegex(empirical.OutOfRange, "driven wheels, slip from 0 to 1, not -0.1"):
            empirical.wong_reece(5000, 1.2, 0.3, -0.1, empirical.terrain("Wong-Reece compact sand"), extrapolate=True)
        with self.assertRaisesRegex(ResultsError, "there is no terrain 'moon'; there are: LLL dry sand"):
            empirical.terrain("moon")


if __name__ == "__main__":
    unittest.main()
