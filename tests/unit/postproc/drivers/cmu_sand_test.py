# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/cmu_sand: forces along the heading, and what its page concludes from its tables."""

import math
import unittest

from support.evaluation import evaluation, stored

study = evaluation("cmu_sand")
GOAL = 0.10  # rms of Fx/Fz


class FrameTest(unittest.TestCase):
    def test_traction_along_the_heading_is_the_rotated_force(self) -> None:
        angle, force = math.radians(20.0), (-0.27, 0.25)  # along and across the travel
        lateral = -force[0] * math.sin(angle) + force[1] * math.cos(angle)
        traction = force[0] * math.cos(angle) + force[1] * math.sin(angle)
        self.assertAlmostEqual(study.along_heading(force[0], lateral, 20.0), traction)

    def test_error_along_the_heading_grows_by_that_of_the_lateral_force(self) -> None:
        self.assertAlmostEqual(study.error_along_heading(0.03, 0.0, 60.0), 0.06)
        self.assertAlmostEqual(study.error_along_heading(0.0, 0.02, 45.0), 0.02)


class PageTest(unittest.TestCase):
    def test_finer_grains_increase_the_distance_from_the_measurement(self) -> None:
        rms = stored("cmu_sand", "accuracy").set_index(["ground", "size_mm"])["rms_fx_over_fz"]["grains"]
        self.assertTrue(rms[[10.0, 8.0, 6.0, 0.0]].is_monotonic_increasing)
        self.assertGreater(rms[0.0], GOAL)

    def test_law_of_the_smooth_wheel_agrees_for_grousers_of_six_mm_alone(self) -> None:
        rows = stored("cmu_sand", "grousers_accuracy")
        points = [p for p in study.MEASURED if p["kind"] == "grouser" and -0.55 < p["slip"] < 0.8]
        self.assertTrue((rows["slips"] == len(points)).all())
        rms = rows.set_index("size_mm")["rms_fx_over_fz"]
        self.assertLess(rms[8.0], rms[10.0])
        self.assertGreater(rms[8.0], GOAL)
        self.assertLessEqual(rms[6.0], GOAL)

    def test_lateral_force_on_coarse_grains_follows_their_strength_alone(self) -> None:
        sideways = stored("cmu_sand", "grounds").dropna(subset="fy_over_fz")
        is_strong = sideways["ground"].str.contains("rolling")
        weak, (strong,) = sideways["fy_over_fz"][~is_strong], sideways["fy_over_fz"][is_strong]
        self.assertGreater(len(weak), 6)
        self.assertLess(weak.max() - weak.min(), 0.11)
        self.assertGreater(strong, weak.max() + 0.11)

    def test_lateral_force_falls_from_5_to_16_grains_in_the_width(self) -> None:
        mine = stored("cmu_sand", "slip_angle").query("ground == 'grains, rolling friction 0.35'")
        finest = mine.loc[mine["grains_in_width"].idxmax()]
        self.assertGreaterEqual(finest["grains_in_width"], 16.0)
        coarse = mine.query("size_mm == 10")["fy_over_fz"]
        self.assertEqual(len(coarse), 2)
        self.assertLess(finest["fy_over_fz"], coarse.min())
        limits = stored("cmu_sand", "slip_angle_best_estimates").set_index("ground")
        fitted, stronger = (limits.loc[f"grains, rolling friction {law}"] for law in ("0.35", "0.5"))
        self.assertLess(abs(stronger["fy_over_fz"] - fitted["fy_over_fz"]), stronger["fy_over_fz_error"])


if __name__ == "__main__":
    unittest.main()
