# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/tyre_table6: errors against Table 6, and its goals."""

import unittest

from support.evaluation import evaluation

table6 = evaluation("tyre_table6")


def state(pressure: float, factor: float) -> dict[str, float]:
    """The measured state times a factor."""
    measured = next(row for row in table6.reference() if row.pressure == pressure)
    return {
        "pressure_kPa": pressure,
        "load_N": 6227,
        "deflection_cm": factor * measured.deflection,
        "perimeter_area_cm2": factor * measured.area,
        "section_width_cm": measured.section_width,
    }


class GoalsTest(unittest.TestCase):
    def test_errors_are_relative(self) -> None:
        (row,) = table6.errors([state(138, 1.12), {**state(138, 1.0), "load_N": 0.0}])
        self.assertAlmostEqual(table6.number(row, "deflection_error"), 0.12)
        self.assertAlmostEqual(table6.number(row, "section_width_error"), 0.0)
        self.assertEqual(row["used_for"], "prediction")

    def test_goals_of_identified_and_predicted_states(self) -> None:
        good = [state(pressure, 1.05) for pressure in (103, 138, 179, 241)]
        self.assertEqual(list(table6.missed_goals(table6.errors(good))), [])
        # 12 %: beyond every goal but that of a predicted deflection
        off = [state(103, 1.12), state(138, 1.12), state(179, 1.0), state(241, 1.0)]
        missed = list(table6.missed_goals(table6.errors(off)))
        self.assertEqual(
            missed,
            [
                "103 kPa: area +12.0 %, goal 10 %",
                "103 kPa: deflection +12.0 %, goal 10 %",
                "138 kPa: area +12.0 %, goal 10 %",
            ],
        )

    def test_missing_state_is_a_miss(self) -> None:
        good = [state(pressure, 1.0) for pressure in (103, 138, 241)]
        self.assertEqual(list(table6.missed_goals(table6.errors(good))), ["179 kPa: no result"])


if __name__ == "__main__":
    unittest.main()
