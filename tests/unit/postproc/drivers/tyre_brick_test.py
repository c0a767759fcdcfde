# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/tyre_brick: the mould's outline, the tyre files made of it, errors and goals."""

import math
import re
import sys
import unittest

from furrow_post.analyse import measured_choice
from furrow_post.csv_table import read_comments, read_rows
from support.command import SOURCE

sys.path.insert(0, str(SOURCE / "inputs" / "validation" / "tyre_brick"))

import cases
import choice
import mould
import report
import shapes


def state(pressure: float, factor: float) -> dict[str, float]:
    """A line of furrow-tyre at 138 kPa's measured state times a factor, of another pressure."""
    return {
        "pressure_kPa": pressure,
        "load_N": 6227.0,
        "deflection_cm": factor * 5.4,
        "nodal_area_cm2": 400.0,
        "perimeter_area_cm2": 419.4,
        "section_width_cm": 25.9 - report.WALL,
    }


class MouldTest(unittest.TestCase):
    def test_four_arcs_meet_without_a_corner(self) -> None:
        shape = mould.outline(mould.Mould(crown=1.0))
        self.assertEqual((shape.axial[0], shape.radius[0]), (0.0, mould.BELT_RADIUS))
        self.assertEqual((shape.axial[-1], shape.radius[-1]), mould.BEAD)
        self.assertEqual(max(shape.axial), mould.Mould().widest)
        chords = list(zip(shape.axial, shape.radius))
        angles = [math.atan2(a[1] - b[1], b[0] - a[0]) for a, b in zip(chords, chords[1:])]
        self.assertEqual(angles, sorted(angles))  # bent to the bead everywhere
        self.assertLess(max(b - a for a, b in zip(angles, angles[1:])), math.radians(26))
        total = sum(math.dist(a, b) for a, b in zip(chords, chords[1:]))
        self.assertLess(total, shape.length)
        self.assertAlmostEqual(total, shape.length, delta=2e-3)

    def test_a_flat_crown_has_its_sagitta(self) -> None:
        of = mould.Mould(crown=1.0)
        shape = mould.outline(of)
        edge = shape.axial.index(of.crown_end)
        drop = 1.0 - math.sqrt(1.0 - of.crown_end**2)
        self.assertAlmostEqual(shape.radius[edge], mould.BELT_RADIUS - drop, delta=1e-5)

    def test_the_tyre_files_have_what_was_chosen(self) -> None:
        for tread, of in (
            *((tread, cases.OF_SMOOTH) for tread in ("smooth", "ribbed", "lugged")),
            ("equivalent", cases.OF_EQUIVALENT),
        ):
            shape = mould.outline(of.mould)
            text = (cases.TYRES / f"p235_75r15_{tread}.yaml").read_text(encoding="utf-8")
            self.assertEqual(mould.listed(text, "axial"), shape.axial)
            self.assertEqual(mould.listed(text, "radius"), shape.radius)
            self.assertEqual(mould.listed(text, "zone_end"), mould.zone_ends(of.mould))
            ends = [0, of.mould.belt_end, of.mould.tread_end]
            self.assertEqual(mould.listed(text, "at"), ends)
            self.assertEqual(mould.listed(text, "stretch_along")[0], of.belt)
            self.assertEqual(mould.listed(text, "shear")[2:5], [of.shear] * 3)
        for file, of in ((cases.SMOOTH, cases.OF_SMOOTH), (cases.EQUIVALENT, cases.OF_EQUIVALENT)):
            (rubber,) = re.findall(r"C10: (\S+)", file.read_text(encoding="utf-8"))
            self.assertEqual(float(rubber), of.rubber)

    def test_a_trial_is_a_tyre_file_with_other_values(self) -> None:
        text = mould.tyre_text(cases.SMOOTH, mould.Mould(crown=0.5), 4e6, 5e3, 3e5)
        self.assertEqual(mould.listed(text, "stretch_along")[0], 4e6)
        self.assertEqual(mould.listed(text, "radius"), mould.outline(mould.Mould(crown=0.5)).radius)
        self.assertIn("C10: 300000", text)
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

    def test_the_stored_table_is_within_the_goals_and_has_the_stored_errors(self) -> None:
        table = report.stored("table6.csv")
        self.assertEqual(list(report.missed_goals(table)), [])
        for row, measured in zip(table, report.read_rows(report.MEASURED), strict=True):
            for what in ("deflection_cm", "area_cm2", "section_width_cm"):
                error = row[what] / float(measured[what]) - 1
                name = what.removesuffix("_cm2").removesuffix("_cm") + "_error"
                self.assertAlmostEqual(row[name], error, delta=2e-4)  # both are rounded

    def test_a_state_that_differs_from_the_stored_one_is_named(self) -> None:
        (row,) = report.errors([state(138, 1.0)])
        self.assertEqual(list(report.changed([row], [row])), [])
        (said,) = report.changed([{**row, "area_cm2": 1.01 * row["area_cm2"]}], [row])
        self.assertIn("138 kPa, 60 sections: area_cm2 423.594 was 419.4, +1.00 %", said)

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


class ChoiceTest(unittest.TestCase):
    """The tables that --error chooses from, against those of both studies."""

    def test_the_tables_are_those_of_both_studies(self) -> None:
        seconds = {r["run"]: float(r["user_s"]) for r in read_rows(cases.HERE / "costs.csv")}
        table6 = choice.table6(
            {
                cases.COARSE: (report.stored("meshes.csv"), seconds["meshes/60"]),
                cases.SECTIONS: (report.stored("table6.csv"), seconds["table6"]),
            }
        )
        stress = choice.stress(read_rows(cases.HERE / "contact_stress.csv"))
        for scene, rows in (("tyre_on_plane", table6), ("brick_tyre_on_plane", stress)):
            with self.subTest(scene=scene):
                written = [{key: str(value) for key, value in row.items()} for row in rows]
                self.assertEqual(read_rows(cases.HERE / f"errors_{scene}.csv"), written)

    def test_each_tyre_is_worth_it_somewhere(self) -> None:
        for scene, error, tyre, scene_of_it in (
            ("tyre_on_plane", 0.2, "tyre/darnell", "tyre_on_plane"),
            ("tyre_on_plane", 0.15, "tyre/darnell", "tyre_on_plane"),
            ("tyre_on_plane", 0.12, "tyre/brick", "brick_tyre_on_plane"),
            ("tyre_on_plane", 0.1, "tyre/brick", "brick_tyre_on_plane"),
            ("brick_tyre_on_plane", 0.7, "tyre/darnell", "tyre_on_plane"),
            ("brick_tyre_on_plane", 0.1, "tyre/brick", "brick_tyre_on_plane"),
        ):
            with self.subTest(scene=scene, error=error):
                table = cases.HERE / f"errors_{scene}.csv"
                self.assertTrue(measured_choice.measurement(read_comments(table)))
                chosen = measured_choice.recommend(measured_choice.read_compared(table), error)
                self.assertLessEqual(chosen.error, error)
                self.assertEqual((chosen.wheel, chosen.options.split()[0]), (tyre, scene_of_it))

    def test_a_peak_that_changes_with_the_mesh_is_no_small_error(self) -> None:
        rows = [{"largest_kPa": value} for value in (765.0, 612.0)]
        first, finest = choice.mesh_errors(rows)
        self.assertEqual((first, finest), ({"mesh_error": 0.2}, {"mesh_error": 0.25}))


class ShapesTest(unittest.TestCase):
    """A section with one groove, from the mid-plane outwards: y, z [m]."""

    UNLOADED = [(0.0, -0.37), (0.0115, -0.37), (0.0117, -0.365), (0.0279, -0.365), (0.0281, -0.37)]

    def test_the_sidewall_begins_beside_the_tread(self) -> None:
        points = [(0.0, -0.37), (0.075, -0.368), (0.1, -0.3), (0.09, -0.31), (0.082, -0.2)]
        profile = shapes.sidewall(points)
        self.assertEqual([y for y, _ in profile], [0.1, 0.09, 0.082])
        self.assertAlmostEqual(profile[0][1], 0.07)

    def test_a_wall_leans_by_the_way_of_its_top(self) -> None:
        inner, outer = shapes.walls(self.UNLOADED)
        self.assertEqual((inner.top, inner.foot, outer.foot, outer.top), (1, 2, 3, 4))
        self.assertAlmostEqual(inner.lean(self.UNLOADED), -math.degrees(math.atan2(2, 50)))
        leaning = list(self.UNLOADED)
        leaning[4] = (0.0279 + 0.005, -0.37)
        self.assertAlmostEqual(outer.lean(leaning), 45.0)


if __name__ == "__main__":
    unittest.main()
