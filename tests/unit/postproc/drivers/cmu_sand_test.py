# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/cmu_sand: forces along the heading, and what its page concludes from its tables."""

import math
import unittest

from furrow_post.csv_table import read_rows
from support.evaluation import VALIDATION, evaluation


FOLDER = VALIDATION / "cmu_sand"
study = evaluation("cmu_sand")
GOAL = 0.10  # rms of Fx/Fz


class FrameTest(unittest.TestCase):
    def test_traction_along_the_heading_is_that_of_the_rotated_force(self) -> None:
        angle, force = math.radians(20.0), (-0.27, 0.25)  # along and across the travel
        lateral = -force[0] * math.sin(angle) + force[1] * math.cos(angle)
        traction = force[0] * math.cos(angle) + force[1] * math.sin(angle)
        self.assertAlmostEqual(study.along_heading(force[0], lateral, 20.0), traction)

    def test_error_along_the_heading_grows_by_that_of_the_lateral_force(self) -> None:
        self.assertAlmostEqual(study.error_along_heading(0.03, 0.0, 60.0), 0.06)
        self.assertAlmostEqual(study.error_along_heading(0.0, 0.02, 45.0), 0.02)


class PageTest(unittest.TestCase):
    def setUp(self) -> None:
        accuracy = read_rows(FOLDER / "accuracy.csv")
        self.rms = {
            (row["ground"], float(row["size_mm"])): float(row["rms_fx_over_fz"]) for row in accuracy
        }
        limits = read_rows(FOLDER / "best_estimates.csv")
        self.limits = {(row["ground"], row["slip"]): row for row in limits}

    def test_grains_leave_the_measurement_as_they_become_finer(self) -> None:
        rms = [self.rms["grains", size] for size in (10.0, 8.0, 6.0, 0.0)]
        self.assertEqual(rms, sorted(rms))
        self.assertGreater(rms[-1], GOAL)

    def test_the_law_of_the_smooth_wheel_meets_grousers_with_six_mm_alone(self) -> None:
        rows = read_rows(FOLDER / "grousers_accuracy.csv")
        points = [p for p in study.MEASURED if p["kind"] == "grouser" and -0.55 < p["slip"] < 0.8]
        self.assertTrue(all(int(row["slips"]) == len(points) for row in rows))
        rms = {float(row["size_mm"]): float(row["rms_fx_over_fz"]) for row in rows}
        self.assertLess(rms[8.0], rms[10.0])
        self.assertGreater(rms[8.0], GOAL)
        self.assertLessEqual(rms[6.0], GOAL)

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
        limits = {row["ground"]: row for row in read_rows(FOLDER / "slip_angle_best_estimates.csv")}
        fitted, stronger = (limits[f"grains, rolling friction {law}"] for law in ("0.35", "0.5"))
        apart = float(stronger["fy_over_fz"]) - float(fitted["fy_over_fz"])
        self.assertLess(abs(apart), float(stronger["fy_over_fz_error"]))


if __name__ == "__main__":
    unittest.main()
