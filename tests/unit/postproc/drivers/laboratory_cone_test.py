# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/laboratory/cone.py finds the cone that the ends of tests were made with."""

import sys
import unittest

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError
from furrow_post.laboratory.evaluation import values_of
from furrow_post.read.laboratory import LaboratoryTest
from support.command import SOURCE
from support.folder import FolderTest
from support.laboratory import write_cell

sys.path.insert(0, str(SOURCE / "inputs" / "laboratory"))

import cone

TANGENT, K = 1.1, 0.75
GROWTH = 0.1  # of volume, per driven strain


class ConeTest(FolderTest):
    def made(self, kind: str, end: Floats, strain: Floats) -> LaboratoryTest:
        """From the smallest stress to those at the end, at constant q/p from a tenth on."""
        driven = np.linspace(0, 0.2, 400)[:, None]
        stress = end.min() + (end - end.min()) * np.minimum(driven / 0.02, 1)
        folder = self.folder / f"{kind}_{end.min():g}"
        return LaboratoryTest(write_cell(folder, kind, driven * strain, stress, confinement=f"{end.min():g}"))

    def of_all_kinds(self, smallest: float) -> list[LaboratoryTest]:
        compression = smallest * TANGENT / (1 - TANGENT / 3)
        q = smallest * K * TANGENT / (1 - 2 * K * TANGENT / 3)  # p = smallest + 2 q/3
        plane = cone.plane_strain(TANGENT, K)
        # s3 = smallest, s2 = s3 + b d, s1 = s3 + d: q = d sqrt(1 - b + b^2), p = s3 + d (1 + b)/3
        b = plane.intermediate
        d = plane.stress_ratio / (np.sqrt(1 - b + b**2) - plane.stress_ratio * (1 + b) / 3)
        half = 0.5 * (1 + GROWTH)
        ends = (
            ("triaxial", [1, 1, 1 + compression / smallest], [-half, -half, 1.0]),
            ("extension", [1 + q / smallest, 1 + q / smallest, 1], [1.0, 1.0, -2.0 - GROWTH]),
            ("plane_strain", [1, 1 + b * d, 1 + d], [-1.0 - GROWTH, 0.0, 1.0]),
        )
        return [self.made(kind, smallest * np.array(stress), np.array(strain)) for kind, stress, strain in ends]

    def test_cone_is_recovered(self) -> None:
        found = cone.fit_cone([*self.of_all_kinds(1e4), *self.of_all_kinds(5e4)])
        self.assertAlmostEqual(found.tangent, TANGENT, places=5)
        self.assertAlmostEqual(found.K, K, places=5)
        self.assertLess(found.K_error, 1e-5)
        np.testing.assert_allclose(found.dilation, GROWTH, atol=1e-6)
        own = cone.plane_strain(TANGENT, K).intermediate
        self.assertAlmostEqual(found.intermediate, own, places=6)
        self.assertIn("K 0.750 +- 0.000, from 6 tests", found.sentences()[0])

    def test_misfit_is_reported(self) -> None:
        """Plane strain as strong as compression: no smooth cone has that."""
        tests = self.of_all_kinds(1e4)
        strong = np.array([1e4, 2.9e4, 4.9e4])
        tests[2] = self.made("plane_strain", strong, np.array([-1.0, 0.0, 1.0]))
        found = cone.fit_cone(tests)
        self.assertLess(found.of("plane_strain")[0], -0.01)
        self.assertGreater(found.of("triaxial")[0], 0.0)

    def test_every_kind_of_test_is_required(self) -> None:
        self.assertRaisesRegex(ResultsError, "there is no plane_strain", cone.fit_cone, self.of_all_kinds(1e4)[:2])

    def test_angles_of_single_tests_are_listed(self) -> None:
        """sin(phi) = (s1 - s3)/(s1 + s3)."""
        for test, sine in zip(self.of_all_kinds(2e4), (3 * TANGENT / (6 + TANGENT), None, None)):
            values = values_of(test)
            stress = test.curve()[-1, 4:7]
            known = (stress.max() - stress.min()) / (stress.max() + stress.min())
            self.assertAlmostEqual(np.sin(np.radians(values["friction_angle_end"])), known, places=6)
            if sine:
                self.assertAlmostEqual(known, sine, places=6)

    def test_plane_strain_is_compared_with_the_section(self) -> None:
        """The stress is on the section x^2 (1 - w c x) = 1 - w, and flow normal to it."""
        for ratio in (0.65, 0.8, 0.95):
            w = (1 - ratio**2) / (1 + ratio**3)
            b = cone.plane_strain(1.0, ratio).intermediate
            angle = float(np.arctan2(np.sqrt(3) * b, 2 - b))  # from compression

            def strength(theta: float) -> float:
                """x, by fixed-point iteration."""
                x = 1.0
                for _ in range(200):
                    x = float(np.sqrt((1 - w) / (1 - w * np.cos(3 * theta) * x)))
                return x

            x = strength(angle)
            self.assertAlmostEqual(cone.plane_strain(1.0, ratio).stress_ratio, x, places=9)
            slope = (strength(angle + 1e-5) - strength(angle - 1e-5)) / 2e-5
            self.assertAlmostEqual(angle + float(np.arctan2(-slope, x)), np.pi / 6, places=6)


if __name__ == "__main__":
    unittest.main()
