# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/snow_wheel: laws of density alone, accuracy, size zero."""

import math
import sys
import unittest

import numpy as np

from support.command import SOURCE

sys.path.insert(0, str(SOURCE / "inputs" / "validation" / "snow_wheel"))

import cases
import report


class LawTest(unittest.TestCase):
    def test_strength_is_the_same_function_of_density(self) -> None:
        """Whatever the initial density; not below what carries half a metre."""
        law = {"slope": 6.0, "d": 5e3, "beta": 22.5, "E": 13.79e6, "p_510": 130e3}
        for density in (150.0, 300.0, 420.0):
            hardening = cases.power_law(density, **law)["hardening"]
            rho = density * np.exp(hardening["eps_vol_pl"])
            expected = np.maximum(130e3 * (rho / 510) ** 6, cases.OWN_WEIGHT)
            np.testing.assert_allclose(hardening["p"], expected, rtol=2e-3)

    def test_case_keeps_its_material_and_its_fallback(self) -> None:
        case = cases.on_field_snow("x", "rows", "towed")
        self.assertIn("law:\n  type: drucker_prager_cap\n", case.files["material.yaml"])
        self.assertEqual(case.fallback, {"remap_interval": 8})
        every_step = cases.on_field_snow("y", "rows", "towed", remap_interval=1)
        self.assertEqual(every_step.fallback, {})


class AccuracyTest(unittest.TestCase):
    def test_rms_and_mean_over_the_rows_that_were_run(self) -> None:
        table = [
            {
                "used": "prediction",
                "sinkage_m": 0.1,
                "resistance": 0.1,
                "towed_sinkage_m": 0.13,
                "towed_resistance": 0.1,
            },
            {
                "used": "prediction",
                "sinkage_m": 0.1,
                "resistance": 0.1,
                "towed_sinkage_m": 0.06,
                "towed_resistance": 0.2,
            },
            {
                "used": "prediction",
                "sinkage_m": 0.1,
                "resistance": 0.1,
                "towed_sinkage_m": "",
                "towed_resistance": "",
            },
        ]
        found = report.accuracy(table, "prediction", "towed")
        self.assertEqual(found["rows"], "prediction: 2")
        self.assertAlmostEqual(found["sinkage_m_rms"], math.sqrt((9 + 16) / 2) / 100, places=4)
        self.assertAlmostEqual(found["sinkage_m_mean"], -0.005)
        self.assertAlmostEqual(found["resistance_mean"], 0.05)
        self.assertTrue(math.isnan(report.accuracy(table, "calibration", "towed")["sinkage_m_rms"]))

    def test_size_zero_is_the_mean_of_both_orders(self) -> None:
        sizes = [0.04, 0.02, 0.01]
        value, uncertain = report.extrapolated(sizes, np.array([1.0, 1.0, 1.0]))
        self.assertAlmostEqual(value, 1.0)
        self.assertAlmostEqual(uncertain, 0.0)
        value, uncertain = report.extrapolated(sizes, 1.0 + 5.0 * np.array(sizes, dtype=float))
        self.assertLess(abs(value - 1.0), uncertain)


if __name__ == "__main__":
    unittest.main()
