# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/crosscheck: what a table says of two grounds."""

import sys
import unittest

from furrow_post.analyse.comparison import RUN, Comparison, Entry, judge
from furrow_post.analyse.cost_table import Components
from furrow_post.analyse.verdict import COEFFICIENT, SINKAGE, Quantity, Verdict
from support.command import SOURCE

sys.path.insert(0, str(SOURCE / "inputs" / "crosscheck"))

import cases
import wheel_cases


def verdict(quantity: Quantity, difference: float, u: float) -> Verdict:
    """On 1 and 1 + difference with this uncertainty."""
    parts = Components(u, 0.0, 0.0, 0.0)
    a, b = (Entry(quantity, name, v, parts, RUN) for name, v in (("a", 1.0), ("b", 1 + difference)))
    return judge(a, b)


class AgreementCellTest(unittest.TestCase):
    def cell(self, *verdicts: Verdict) -> str:
        return wheel_cases.agreement_cell(Comparison([], verdicts=list(verdicts)))

    def test_cells_read_as_sentences(self) -> None:
        agree, differ, vague = (0.0, 0.01), (0.5, 0.01), (0.0, 0.5)
        for sinkage, coefficient, expected in (
            (agree, agree, "sinkage and resistance coefficient"),
            (agree, vague, "sinkage; not decided: resistance coefficient"),
            (vague, vague, "not decided: sinkage and resistance coefficient"),
            (differ, vague, "not decided: resistance coefficient"),
            (differ, differ, "neither"),
            (differ, agree, "resistance coefficient"),
        ):
            with self.subTest(expected=expected):
                both = verdict(SINKAGE, *sinkage), verdict(COEFFICIENT, *coefficient)
                self.assertEqual(self.cell(*both), expected)


class PlanTest(unittest.TestCase):
    def test_lines_of_cases_csv_become_runs(self) -> None:
        plans = {plan.run.name: plan for plan in cases.plan()}
        size = plans["wheel_on_snow/continuum_size_0.05"]
        self.assertEqual((size.kind, size.is_check, size.of_wheel), ("size", True, True))
        self.assertEqual(size.run.variables["cell"], "0.05")
        base = plans["wheel_on_snow/grains_base"]
        self.assertFalse(base.is_check)
        point = plans["confined_snow/continuum_base"]
        self.assertEqual(point.run.program, "furrow-point")
        self.assertIn("fresh_snow_shoop.yaml", point.run.files["path.yaml"])


if __name__ == "__main__":
    unittest.main()
