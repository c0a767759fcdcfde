# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/report_wheel: the closed form, and the snow that differs from the report's."""

import math
import unittest
from unittest.mock import patch

import numpy as np

from furrow_post.analyse.statistics import place_of_greatest
from furrow_post.arrays import Floats
from support.evaluation import cases, evaluation

closed_form = evaluation("report_wheel")


def linear(strain: Floats, d: float) -> Floats:
    """A spring bed in the compressed depth w: 1 MPa/m."""
    pressure: Floats = 1e6 * closed_form.DEPTH * (1 - np.exp(-strain))
    return pressure


class ClosedFormTest(unittest.TestCase):
    def test_spring_bed_is_bekkers_wheel(self) -> None:
        # p = k w under a circle: the integral of k (sqrt(r^2 - x^2) - (r - z)) in closed form
        r, z, k = closed_form.RADIUS, 0.08, 1e6
        half = math.sqrt(2 * r * z - z * z)
        segment = 0.5 * (half * (r - z) + r * r * math.asin(half / r)) - (r - z) * half
        with patch.object(closed_form, "axial_stress", linear):
            load = closed_form.carried(z, 0.0, 1)
            self.assertAlmostEqual(load / (closed_form.WIDTH * k * segment), 1, places=5)
            work = closed_form.resistance(z, 0.0) * closed_form.LOAD
            self.assertAlmostEqual(work / (closed_form.WIDTH * k * z * z / 2), 1, places=5)

    def test_sunk_wheel_carries_its_load(self) -> None:
        for sides in (1, 2):
            z = closed_form.sunk(5e3, sides, False)
            self.assertAlmostEqual(closed_form.carried(z, 5e3, sides) / closed_form.LOAD, 1, 6)
            self.assertLess(closed_form.sunk(5e3, sides, True), z)

    def test_bearing_capacity_is_prandtls(self) -> None:
        self.assertAlmostEqual(math.degrees(closed_form.PHI), 13.86, places=2)
        self.assertAlmostEqual(closed_form.NC, 10.29, places=2)  # tables: 10.37 at 14 degrees


class CasesTest(unittest.TestCase):
    def test_depths_follow_the_report_s_schedule(self) -> None:
        depths = [case for case in cases("report_wheel").values() if case.stage == "depth"]
        self.assertTrue(depths)
        for case in depths:
            names = ("settle", "accelerate", "distance", "depth", "cell")
            values = {name: float(str(case.variables[name])) for name in names}
            end = values["settle"] + 0.5 * values["accelerate"] + values["distance"] / 2.235
            self.assertAlmostEqual(end, 5.0, places=1)  # [s]
            cells = values["depth"] / values["cell"]
            self.assertAlmostEqual(cells, round(cells), places=3)


class FieldsTest(unittest.TestCase):
    def test_greatest_of_a_layer_is_placed(self) -> None:
        x = np.linspace(-0.3, 0.3, 601)
        field = np.exp(-(((x - 0.05) / 0.1) ** 2))
        layer = np.abs(x) < 0.2
        for chosen, place in ((layer, 5.0), (x < 0.0, -0.5)):  # [cm]
            found = 100 * place_of_greatest(x[chosen], field[chosen], closed_form.GREATEST)
            self.assertAlmostEqual(found, place, delta=0.1)


if __name__ == "__main__":
    unittest.main()
