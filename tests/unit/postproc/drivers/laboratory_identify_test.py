# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/laboratory/cap.py finds the law that curves were made with."""

import contextlib
import io
import sys
import unittest

import numpy as np

from furrow_post.read.laboratory import LaboratoryTest
from support.command import SOURCE
from support.folder import FolderTest
from support.laboratory import axisymmetric, write_cell

sys.path.insert(0, str(SOURCE / "inputs" / "laboratory"))

import cap

TANGENT, E, NU, R, H = 1.1, 4e6, 0.2, 0.3, 2e6  # p_b = its first value + H eps


class CapLawTest(FolderTest):
    def triaxial(self, lateral: float, end: float = 0.2) -> LaboratoryTest:
        axial = np.linspace(0, end, 4000)
        q = np.minimum(E * axial, lateral * TANGENT / (1 - TANGENT / 3))
        strain, stress = axisymmetric(-NU * axial, axial), axisymmetric(lateral, lateral + q)
        folder = self.folder / f"triaxial_{lateral:g}"
        return LaboratoryTest(write_cell(folder, "triaxial", strain, stress, confinement=lateral))

    def test_friction_and_its_matched_cone_are_found(self) -> None:
        found, each = cap.friction([self.triaxial(1e4), self.triaxial(5e4)])
        sine = 3 * TANGENT / (6 + TANGENT)  # triaxial compression
        self.assertEqual(len(each), 2)
        self.assertAlmostEqual(found, sine, delta=1e-3)
        triaxial, plane = cap.MATCH["triaxial"], cap.MATCH["plane_strain"]
        self.assertAlmostEqual(triaxial.tangent(found), TANGENT, delta=4e-3)
        half = float(np.sin(np.radians(30.0)))
        self.assertAlmostEqual(plane.tangent(half), float(np.sqrt(0.75)), places=9)

    def test_short_tests_are_reported(self) -> None:
        for end, said in ((0.2, ""), (0.02, "ends at 2.0% of axial strain")):
            told = io.StringIO()
            with contextlib.redirect_stderr(told):
                cap.warn_of_short_tests([self.triaxial(1e4, end)])
            self.assertIn(said, told.getvalue())
            self.assertEqual(bool(said), bool(told.getvalue()))

    def test_elasticity_is_identified(self) -> None:
        found = cap.elasticity(self.triaxial(5e4))
        np.testing.assert_allclose(found, (E, NU), rtol=1e-3)

    def test_eccentricity_and_hardening_are_identified(self) -> None:
        on_cap = cap.cap_stress(np.geomspace(1e3, 3e5, 3000), R, TANGENT, 0.0)
        K0 = float(on_cap.K0[0])
        self.assertAlmostEqual(cap.eccentricity(K0, TANGENT), R, delta=1e-3)
        self.assertEqual(cap.eccentricity(0.1, TANGENT), cap.SMALLEST)
        # elastic and plastic volume
        elastic = (on_cap.p - on_cap.p[0]) * 3 * (1 - 2 * NU) / E
        compression = elastic + (on_cap.p_b - on_cap.p_b[0]) / H
        stress = axisymmetric(on_cap.p - on_cap.q / 3, on_cap.axial)
        density = 1500.0 * np.exp(compression)
        folder = write_cell(self.folder / "oedometer", "oedometer", axisymmetric(0, compression), stress, density)
        law = cap.Law(TANGENT, 0.0, R, E, NU)
        hardening, initial = cap.hardening(LaboratoryTest(folder), law)
        self.assertAlmostEqual(initial, 1500.0, places=6)
        self.assertGreater(len(hardening), 6)
        for p_b, plastic in hardening:
            self.assertAlmostEqual(p_b, on_cap.p_b[0] + H * plastic, delta=0.01 * p_b)


if __name__ == "__main__":
    unittest.main()
