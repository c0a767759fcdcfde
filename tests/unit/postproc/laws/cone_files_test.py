# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil and tyre of the formulas of a cone index, from the files of inputs."""

import math
import unittest

from furrow_post.laws.cone_files import COHESIVE, Soil, cohesion, formula_tyre, kind_of, soil_of
from furrow_post.laws.terrain_values import terrains
from furrow_post.soil.make import Strength
from support.command import SOURCE

MATERIALS = SOURCE / "inputs" / "materials"
TYRE = SOURCE / "inputs" / "tyres" / "p235_75r15.yaml"


class ConeFilesTest(unittest.TestCase):
    def test_soil_is_read_from_the_material_file(self) -> None:
        self.assertEqual(soil_of(MATERIALS / "sand_medium.yaml"), Soil("sand", 131e3))
        self.assertEqual(soil_of(MATERIALS / "clay_stiff.yaml"), Soil("clay", 530e3))
        self.assertEqual(soil_of(MATERIALS / "sandy_loam.yaml"), Soil("clay", 202e3))
        self.assertIsNone(soil_of(MATERIALS / "moist_sand.yaml"))  # no formula has moist sand
        self.assertIsNone(soil_of(MATERIALS / "fresh_snow.yaml"))

    def test_soil_without_friction_is_fine_grained(self) -> None:
        self.assertEqual(kind_of("drucker_prager", {"d": 2000.0, "beta": 0.0}), "clay")
        self.assertEqual(kind_of("drucker_prager", {"d": 2000.0, "beta": 50.0}), "sand")
        self.assertEqual(kind_of("norsand", {"M": 1.2}), "sand")
        self.assertIsNone(kind_of("crushable_foam", {}))

    def test_cohesion_of_a_law_is_that_of_mohr_coulomb(self) -> None:
        made = Strength(1720.0, 29.0)
        law = {"d": made.d, "beta": math.degrees(math.atan(made.tangent))}
        self.assertAlmostEqual(cohesion(law), 1720, places=6)
        self.assertAlmostEqual(cohesion({"d": 3e4, "beta": 0.0}), 1.5e4, places=6)  # q = 2 c without friction
        self.assertEqual(cohesion({"M": 1.2}), 0)

    def test_limit_of_cohesion_lies_between_dry_sands_and_loam(self) -> None:
        cohesions = {name: values.c for name, values in terrains().items()}
        loam = cohesions.pop("LLL sandy loam")
        self.assertGreaterEqual(len(cohesions), 5)
        self.assertTrue(max(cohesions.values()) < COHESIVE < loam)

    def test_tyre_has_the_sizes_of_its_designation(self) -> None:
        """P235/75 R15 has a diameter of 0.733 m and a section height of 0.176 m. Its deflection is that of [Shoop2001]."""
        tyre = formula_tyre(TYRE, 179e3, 6227.0)
        self.assertAlmostEqual(tyre.diameter, 0.733, delta=0.01)
        self.assertAlmostEqual(tyre.section_height, 0.176, delta=0.006)
        self.assertAlmostEqual(tyre.width, 0.235, delta=0.035)  # under load it bulges
        self.assertAlmostEqual(tyre.deflection, 0.0404, delta=0.005)
        self.assertTrue(tyre.radial)
        self.assertFalse(formula_tyre(TYRE.with_name("15x6_00_6.yaml"), 1e5, 1000.0).radial)


if __name__ == "__main__":
    unittest.main()
