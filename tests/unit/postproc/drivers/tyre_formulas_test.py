# SPDX-License-Identifier: GPL-2.0-or-later
"""Tyres and formulas: which formulas count, and what the stored tables say."""

import math
import unittest

from furrow_post.csv_table import read_rows
from support.command import SOURCE
from support.evaluation import evaluation

FOLDER = SOURCE / "inputs" / "validation" / "tyre_formulas"


class TyreFormulasTest(unittest.TestCase):
    def test_every_run_has_a_formula_and_a_tyre(self) -> None:
        study = evaluation("tyre_formulas")
        for keys in study.combinations():
            self.assertTrue(study.formulas(keys["size"], keys["soil"]).answers, keys)
            self.assertIn("tread:", study.estimate(keys["size"]).text)

    def test_a_tyre_on_soft_clay_is_outside_of_maclaurins_range(self) -> None:
        # N = CI b^0.8 d^0.8 delta^0.4/W is 1.4, the formula starts at 1.85
        answers = evaluation("tyre_formulas").formulas("265/70R17", "clay_soft", 1e-6).answers
        outside = {one.method: [limit for limit in one.outside if not limit.startswith("slip ")] for one in answers}
        self.assertTrue(outside["Maclaurin"])
        self.assertFalse(outside["Wismer-Luth"])

    def test_the_summary_is_that_of_the_results(self) -> None:
        rows = [row for row in read_rows(FOLDER / "results.csv") if row["soil"].startswith("sand") and row["quantity"] == "net_traction_coefficient"]
        off = [float(row["value"]) - float(row["of_formulas"]) for row in rows]
        (stored,) = [row for row in read_rows(FOLDER / "summary.csv") if row["kind"] == "sand" and row["quantity"] == "net_traction_coefficient"]
        self.assertEqual(int(stored["values"]), len(off))
        self.assertAlmostEqual(float(stored["mean_off"]), sum(off) / len(off), delta=1e-3)
        self.assertAlmostEqual(float(stored["rms_off"]), math.sqrt(sum(one * one for one in off) / len(off)), delta=1e-3)


if __name__ == "__main__":
    unittest.main()
