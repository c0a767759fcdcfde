# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/tyre_brick: the mould's outline, the tyre files made of it, errors and goals."""

import math
import sys
import unittest

from support.command import SOURCE

sys.path.insert(0, str(SOURCE / "inputs" / "validation" / "tyre_brick"))

import cases
import mould
import report


def state(pressure: float, factor: float) -> dict[str, float]:
    """A line of furrow-tyre at 138 kPa's measured state times a factor, of another pressure."""
    return {
        "pressure_kPa": pressure,
        "load_N": 6227.0,
        "deflection_cm": factor * 5.4,
        "nodal_area_cm2": 419.4,
        "perimeter_area_cm2": 400.0,
        "section_width_cm": 25.9 - report.WALL,
    }


class MouldTest(unittest.TestCase):
    def test_four_arcs_meet_without_a_corner(self) -> None:
        shape = mould.outline(1.0)
        self.assertEqual((shape.axial[0], shape.radius[0]), (0.0, mould.BELT_RADIUS))
        self.assertEqual((shape.axial[-1], shape.radius[-1]), mould.BEAD)
        self.assertEqual(max(shape.axial), mould.WIDEST)
        chords = list(zip(shape.axial, shape.radius))
        angles = [math.atan2(a[1] - b[1], b[0] - a[0]) for a, b in zip(chords, chords[1:])]
        self.assertEqual(angles, sorted(angles))  # bent to the bead everywhere
        self.assertLess(max(b - a for a, b in zip(angles, angles[1:])), math.radians(26))
        total = sum(math.dist(a, b) for a, b in zip(chords, chords[1:]))
        self.assertLess(total, shape.length)
        self.assertAlmostEqual(total, shape.length, delta=2e-3)

    def test_a_flat_crown_has_its_sagitta(self) -> None:
        shape = mould.outline(1.0)
        edge = shape.axial.index(mould.CROWN_END)
        drop = 1.0 - math.sqrt(1.0 - mould.CROWN_END**2)
        self.assertAlmostEqual(shape.radius[edge], mould.BELT_RADIUS - drop, delta=1e-5)

    def test_the_tyre_files_have_what_was_chosen(self) -> None:
        shape = mould.outline(cases.CHOSEN.crown)
        for tread in ("smooth", "ribbed", "lugged"):
            text = (cases.TYRES / f"p235_75r15_{tread}.yaml").read_text(encoding="utf-8")
            self.assertEqual(mould.listed(text, "axial"), shape.axial)
            self.assertEqual(mould.listed(text, "radius"), shape.radius)
            self.assertEqual(mould.listed(text, "zone_end"), mould.zone_ends(shape))
            self.assertEqual(mould.listed(text, "at"), [0, mould.BELT_END, mould.TREAD_END])
            self.assertEqual(mould.listed(text, "stretch_along")[0], cases.CHOSEN.belt)
            self.assertEqual(mould.listed(text, "shear")[2:5], [cases.CHOSEN.shear] * 3)

    def test_a_trial_is_a_tyre_file_with_other_values(self) -> None:
        text = mould.tyre_text(cases.SMOOTH, 0.5, 4e6, 5e3)
        self.assertEqual(mould.listed(text, "stretch_along")[0], 4e6)
        self.assertEqual(mould.listed(text, "radius"), mould.outline(0.5).radius)
        self.assertNotIn("#", text)
        with self.assertRaises(ValueError):
            mould.replaced(text, "no_such_key", [1.0])


class GoalsTest(unittest.TestCase):
    def test_errors_are_relative_and_the_width_has_its_walls(self) -> None:
        (row,) = report.errors([state(138, 1.2), {**state(138, 1.0), "load_N": 0.0}])
        self.assertAlmostEqual(row["deflection_error"], 0.2)
        self.assertAlmostEqual(row["area_error"], 0.0)
        self.assertAlmostEqual(row["section_width_error"], 0.0)
        self.assertEqual(row["used_for"], "prediction")

    def test_what_is_beyond_a_goal_or_absent_is_missed(self) -> None:
        missed = list(report.missed_goals(report.errors([state(138, 1.2)])))
        self.assertEqual(
            missed,
            [
                "103 kPa: no result",
                "179 kPa: no result",
                "241 kPa: no result",
                "138 kPa: deflection +20.0 %, goal 10 %",
            ],
        )


if __name__ == "__main__":
    unittest.main()
