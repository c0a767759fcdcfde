# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/cmu_sand: limits of size zero, and what its page concludes from its tables."""

import math
import sys
import unittest

from support.command import SOURCE

FOLDER = SOURCE / "inputs" / "validation" / "cmu_sand"
sys.path.insert(0, str(FOLDER))

import cases
import grounds
import grounds_report

from furrow_post.csv_table import read_rows


class LimitTest(unittest.TestCase):
    def test_of_a_straight_line_is_its_intercept_with_the_error_of_the_line(self) -> None:
        sizes, scatter = [10.0, 8.0, 6.0], 0.03
        limit = grounds_report.at_size_zero(sizes, [1.0 + 0.1 * size for size in sizes], scatter)
        self.assertAlmostEqual(limit.value, 1.0)
        # s sqrt(1/n + mean^2/sum((x - mean)^2))
        self.assertAlmostEqual(limit.error, scatter * math.sqrt(1 / 3 + 64 / 8))

    def test_scatter_about_the_line_counts_where_it_is_larger(self) -> None:
        values = [0.0, 0.3, 0.0]
        calm, rough = (
            grounds_report.at_size_zero([10.0, 8.0, 6.0], values, s).error for s in (0.0, 1.0)
        )
        self.assertGreater(calm, 0.1)
        self.assertGreater(rough, calm)

    def test_scatter_of_pours_comes_from_pairs_of_one_point(self) -> None:
        row: grounds_report.Row = {
            "ground": "grains", "size_mm": 8.0, "slip": 0.0, "fx_over_fz": -0.2
        }  # fmt: skip
        pair = [row, {**row, "fx_over_fz": -0.16}, {**row, "size_mm": 6.0, "fx_over_fz": 5.0}]
        scatter = grounds_report.scatter_of_pours(pair, "fx_over_fz")
        self.assertAlmostEqual(scatter, 0.04 / math.sqrt(2))


class PageTest(unittest.TestCase):
    def setUp(self) -> None:
        accuracy = read_rows(FOLDER / "accuracy.csv")
        self.rms = {
            (row["ground"], float(row["size_mm"])): float(row["rms_fx_over_fz"]) for row in accuracy
        }
        limits = read_rows(FOLDER / "size_zero.csv")
        self.limits = {(row["ground"], row["slip"]): row for row in limits}

    def test_grains_leave_the_measurement_as_they_become_finer(self) -> None:
        rms = [self.rms["grains", size] for size in (10.0, 8.0, 6.0, 0.0)]
        self.assertEqual(rms, sorted(rms))
        self.assertGreater(rms[-1], grounds.GOAL)

    def test_the_continuum_of_their_law_is_nearer_to_it(self) -> None:
        for fine, cells in ((8.0, 7.0), (0.0, 0.0)):
            self.assertLess(self.rms["continuum", cells], self.rms["grains", fine])

    def test_the_continuum_has_less_resistance_than_grains_of_its_law_at_size_zero(self) -> None:
        slips = {slip for ground, slip in self.limits if ground == "grains"}
        self.assertEqual(len(slips), len(grounds.SLIPS))
        pairs = [(self.limits["continuum", slip], self.limits["grains", slip]) for slip in slips]
        apart = [float(one["fx_over_fz"]) - float(other["fx_over_fz"]) for one, other in pairs]
        error = math.hypot(*(float(row["fx_over_fz_error"]) for pair in pairs for row in pair))
        self.assertGreater(min(apart), 0.0)
        self.assertGreater(sum(apart), 2 * error)

    def test_the_law_of_the_smooth_wheel_meets_grousers_with_six_mm_and_not_at_size_zero(self) -> None:
        rows = read_rows(FOLDER / "grousers_accuracy.csv")
        self.assertTrue(all(int(row["slips"]) == len(cases.wheel_points("grouser")) for row in rows))
        rms = {float(row["size_mm"]): float(row["rms_fx_over_fz"]) for row in rows}
        self.assertLess(rms[8.0], rms[10.0])
        self.assertGreater(rms[8.0], grounds.GOAL)
        self.assertLessEqual(rms[6.0], grounds.GOAL)
        self.assertGreater(rms[0.0], grounds.GOAL)

    def test_with_coarse_grains_lateral_force_follows_their_strength_alone(self) -> None:
        sideways = [row for row in read_rows(FOLDER / "grounds.csv") if row["fy_over_fz"]]
        strong = [row for row in sideways if "rolling" in row["ground"]]
        self.assertEqual(len(strong), 1)
        weak = [float(row["fy_over_fz"]) for row in sideways if row not in strong]
        self.assertGreater(len(weak), 6)
        self.assertLess(max(weak) - min(weak), 0.11)
        self.assertGreater(float(strong[0]["fy_over_fz"]), max(weak) + 0.11)

    def test_sixteen_grains_in_the_width_have_less_lateral_force_than_five(self) -> None:
        rows = read_rows(FOLDER / "slip_angle.csv")
        mine = [row for row in rows if row["ground"] == "grains, rolling friction 0.35"]
        finest = max(mine, key=lambda row: float(row["grains_in_width"]))
        self.assertGreaterEqual(float(finest["grains_in_width"]), 16.0)
        coarse = [row for row in mine if row["size_mm"] == "10.0"]
        self.assertEqual(len(coarse), 2)
        for row in coarse:
            self.assertLess(float(finest["fy_over_fz"]), float(row["fy_over_fz"]))
        limits = {row["ground"]: row for row in read_rows(FOLDER / "slip_angle_limit.csv")}
        fitted, stronger = (limits[f"grains, rolling friction {law}"] for law in ("0.35", "0.5"))
        apart = float(stronger["fy_over_fz"]) - float(fitted["fy_over_fz"])
        self.assertLess(abs(apart), float(stronger["fy_over_fz_error"]))


if __name__ == "__main__":
    unittest.main()
