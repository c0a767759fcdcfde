# SPDX-License-Identifier: GPL-2.0-or-later
"""Slip over slope of a wheel with a closed form: slip, band, limits, and what is refused."""

import unittest

import numpy as np

from furrow_post.csv_table import read_comments, read_numbers
from furrow_post.surrogate.gaussian_process import Z_95
from furrow_post.surrogate.mobility import Vehicle
from furrow_post.surrogate.slopes import limits, slip_over_slope
from furrow_post.surrogate.training import HUB_DROP, PULL
from support.command import run_post
from support.folder import FolderTest
from support.surrogate import RANGES, closed_form, made_surrogate, wheel

SLOPES = np.linspace(0.0, 30.0, 31)
PHI = 32.0


class SlopesTest(FolderTest):
    def test_slip_has_the_closed_form(self) -> None:
        for load in (400.0, 700.0):
            curve = slip_over_slope(made_surrogate(), Vehicle(load, 0.5), SLOPES, {"phi": PHI})
            self.assertEqual(len(curve), len(SLOPES))
            climbing = 0
            for _, row in curve.iterrows():
                margin, slip, _ = closed_form(row["slope_deg"], PHI, load)
                if slip == RANGES["slip"][0]:
                    self.assertTrue(np.isnan(row["slip"]))
                elif margin > 0.01:
                    climbing += 1
                    self.assertAlmostEqual(row["slip"], slip, delta=0.003)
                    on_slope = load * np.cos(np.radians(row["slope_deg"]))
                    drop = float(wheel(np.array(slip), np.array(on_slope), np.array(PHI))[HUB_DROP])
                    self.assertAlmostEqual(row["hub_drop_m"], drop, delta=2e-4)
                elif margin < -0.01:
                    self.assertTrue(np.isnan(row["slip"]))
            self.assertTrue(10 < climbing < len(SLOPES), climbing)
            steepest = next(s for s in np.arange(0, 45, 0.01) if closed_form(float(s), PHI, load)[0] < 0)
            self.assertAlmostEqual(float(limits(curve, (0.5,))[0]), steepest, delta=1.0)
            self.assertEqual(limits(curve[:9], (0.95, 0.5)), [">8", ">8"])
            self.assertEqual(limits(curve[-2:], (0.5,)), [""])

    def test_band_is_the_slip_at_the_ends_of_the_pull(self) -> None:
        surrogate = made_surrogate()
        for name in (PULL, HUB_DROP):
            surrogate.processes[name].factor = 30.0
        curve = slip_over_slope(surrogate, Vehicle(600.0, 0.5), SLOPES[8:15], {"phi": PHI})
        wide = curve["greatest"] - curve["least"]
        self.assertTrue((wide > 0.005).all(), wide)
        load = 600.0 * np.cos(np.radians(curve["slope_deg"].to_numpy()))
        for end, sign in (("least", 1.0), ("greatest", -1.0)):
            x = surrogate.scaled({"slip": curve[end].to_numpy(), "load": load, "phi": PHI})
            mean, deviation = surrogate.processes[PULL].predict(x)
            np.testing.assert_allclose(mean + sign * Z_95 * deviation, np.tan(np.radians(curve["slope_deg"])), atol=1e-3)
        x = surrogate.scaled({"slip": curve["slip"].to_numpy(), "load": load, "phi": PHI})
        mean, deviation = surrogate.processes[HUB_DROP].predict(x)
        self.assertTrue((curve["hub_drop_least_m"] <= mean - Z_95 * deviation + 1e-12).all())
        self.assertTrue((curve["hub_drop_greatest_m"] >= mean + Z_95 * deviation - 1e-12).all())

    def test_need_below_the_range_has_no_slip(self) -> None:
        curve = slip_over_slope(made_surrogate(), Vehicle(600.0, 0.5), np.array([-20.0, 5.0]), {"phi": PHI})
        self.assertTrue(np.isnan(curve["slip"][0]))
        self.assertEqual(curve["probability"][0], 1.0)
        self.assertTrue(np.isfinite(curve["slip"][1]))

    def test_command_states_the_radius_and_refuses_faults(self) -> None:
        file, out = self.folder / "wheel.json", self.folder / "out"
        made_surrogate().write(file)
        done = run_post("slopes", file, "--load", "310:600:3", "--slope", "0:30:16", "--set", f"phi={PHI}", "-o", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("climbs at 95 %", done.stdout)
        self.assertIn("8 slopes and loads lie outside", done.stdout)  # 310 N cos a < 300 N from 16 degrees on
        self.assertRegex(done.stdout, r"\n +310( +>14){3}\n +455( +26){3}\n")
        self.assertIn("radius of 0.25 m", "".join(read_comments(out / "slopes.csv")))
        rows = read_numbers(out / "slopes.csv")
        self.assertEqual({row["load_N"] for row in rows}, {310.0, 455.0, 600.0})
        self.assertGreater((out / "slopes.png").stat().st_size, 10_000)
        for words, message in (
            (("--load", "600"), "no soil parameter phi; give it by --set phi=NUMBER"),
            (("--load", "600", "--set", "phi=50"), "phi: 50 lies outside of the training range"),
            (("--load", "600", "--set", "n=1", "phi=30"), "the surrogate has no soil parameter 'n'"),
            (("--load", "2000", "--set", "phi=30"), "no slope and load lie inside the training range: load 300 to 900"),
            (("--set", "phi=30"), "has no single load and speed"),
        ):
            done = run_post("slopes", file, "-o", out, *words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
