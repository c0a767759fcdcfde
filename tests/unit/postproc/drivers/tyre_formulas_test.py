# SPDX-License-Identifier: GPL-2.0-or-later
"""Tyres and formulas: which formulas count."""

import unittest

from support.evaluation import evaluation


class TyreFormulasTest(unittest.TestCase):
    def test_every_run_has_a_formula_and_a_tyre(self) -> None:
        study = evaluation("tyre_formulas")
        for keys in study.combinations():
            self.assertTrue(study.formulas(keys["size"], keys["soil"]).answers, keys)
            self.assertIn("tread:", study.estimate(keys["size"]).text)

    def test_tyre_on_soft_clay_is_outside_the_range_of_maclaurin(self) -> None:
        # N = CI b^0.8 d^0.8 delta^0.4/W is 1.4, the formula starts at 1.85
        answers = evaluation("tyre_formulas").formulas("265/70R17", "clay_soft", 1e-6).answers
        outside = {one.method: [limit for limit in one.outside if not limit.startswith("slip ")] for one in answers}
        self.assertTrue(outside["Maclaurin"])
        self.assertFalse(outside["Wismer-Luth"])


if __name__ == "__main__":
    unittest.main()
