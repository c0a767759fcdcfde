# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests on curves whose answers are known: a Mohr-Coulomb ground, formulas of Janosi and Bekker, a
wedge; refusals."""

import contextlib
import io
import json
import unittest
from pathlib import Path

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.cli.main import main
from furrow_post.errors import ResultsError
from furrow_post.laboratory.evaluation import evaluate, reference_error, values_of
from furrow_post.laboratory.quantity import LaboratoryQuantity
from furrow_post.laboratory.together import together
from furrow_post.read.laboratory import LaboratoryTest, read_oedometer_reference
from support.folder import FolderTest
from support.laboratory import cell_rows, triaxial_stress, write_test

PHI, COHESION = 31.0, 2000.0  # [degrees], [Pa]


class LaboratoryTests(FolderTest):
    def values(self, folder: Path) -> dict[str, float]:
        return values_of(LaboratoryTest(folder))

    def together(self, folders: list[Path]) -> dict[str, LaboratoryQuantity]:
        found = together([LaboratoryTest(folder) for folder in folders])
        return {quantity.name: quantity for quantity in found}

    def triaxial(self, confinement: float) -> Path:
        axial = np.linspace(0, 0.2, 400)
        N = np.tan(np.radians(45 + PHI / 2)) ** 2
        top = confinement * N + 2 * COHESION * np.sqrt(N) - confinement
        deviator = top * (1 - np.exp(-axial / 0.01))
        strain = np.column_stack((-0.6 * axial, -0.6 * axial, axial))  # grows by 0.2 of the axial
        rows = cell_rows(strain, triaxial_stress(confinement, confinement + deviator))
        facts = f"test triaxial ground clay confinement {confinement}"
        return write_test(self.folder / f"triaxial_{confinement:g}", facts, rows)

    def test_triaxial_tests_give_mohr_coulomb(self) -> None:
        folders = [self.triaxial(c) for c in (1e4, 2e4, 5e4)]
        found = self.together(folders)
        self.assertAlmostEqual(found["friction_angle_end"].value, PHI, delta=0.02)
        self.assertAlmostEqual(found["cohesion_end"].value, COHESION, delta=5)
        self.assertAlmostEqual(self.values(folders[0])["dilation"], 0.2, places=6)

    def test_unconfined_test_gives_the_free_sides(self) -> None:
        """Sides that give way by 0.05 of the axial strain; a linear, then a brittle pull."""
        axial = np.linspace(0, 0.45, 500)
        strain = np.column_stack((-0.06 * axial, -0.04 * axial, axial))
        density = 200.0 * np.exp(0.9 * axial)
        rows = cell_rows(strain, triaxial_stress(0.0, 2e4 * axial), density)
        found = self.values(write_test(self.folder / "unconfined", "test unconfined", rows))
        for level in (5, 10, 20, 40):
            self.assertAlmostEqual(found[f"lateral_ratio_{level}%"], 0.05, places=6)
            self.assertAlmostEqual(found[f"stress_{level}%"] / (200.0 * level), 1, delta=0.01)
        self.assertAlmostEqual(found["density_20%"], 200 * np.exp(0.18), delta=0.5)
        pull = np.where(axial < 0.2, 3e3 * axial, 0.0)
        rows = cell_rows(-0.1 * strain, triaxial_stress(0.0, -pull), 200.0)
        found = self.values(write_test(self.folder / "tension", "test tension", rows))
        self.assertAlmostEqual(found["tensile_strength"] / 600, 1, delta=0.02)

    def shear(self, sigma: float) -> Path:
        j = np.linspace(0, 0.05, 400)
        strength = COHESION + sigma * np.tan(np.radians(PHI))
        tau = strength * (1 - np.exp(-j / 0.004))
        rows = cell_rows(np.zeros((len(j), 3)), np.full((len(j), 3), sigma))

        def from_first(values: Floats) -> Floats:
            return np.concatenate((values[:1], values))

        rows = np.column_stack((rows[:, :8], from_first(j), from_first(tau)))
        facts = f"test shear ground clay confinement {sigma} gap 0.1"
        return write_test(self.folder / f"shear_{sigma:g}", facts, rows)

    def test_shear_test_gives_janosi(self) -> None:
        folders = [self.shear(sigma) for sigma in (1e4, 3e4, 6e4)]
        values = self.values(folders[0])
        self.assertAlmostEqual(values["janosi_K"], 0.004, delta=2e-5)
        strength = COHESION + 1e4 * np.tan(np.radians(PHI))
        self.assertAlmostEqual(values["peak_shear"] / strength, 1, delta=1e-4)
        self.assertAlmostEqual(values["strain_at_peak"], 0.004 * np.log(20) / 0.1, delta=2e-3)
        found = self.together(folders)
        self.assertAlmostEqual(found["friction_angle_residual"].value, PHI, delta=0.05)
        self.assertAlmostEqual(found["cohesion_residual"].value, COHESION, delta=10)

    def test_two_plates_give_bekker(self) -> None:
        kc, kphi, n = 3e3, 1.5e6, 1.1
        folders = []
        for size in (0.06, 0.12):
            z = np.linspace(0, 0.03, 300)
            pressure = (kc / (size / 2) + kphi) * z**n
            rows = np.column_stack((np.arange(300), z, pressure * size, pressure))
            facts = f"test plate ground clay size {size}"
            folders.append(write_test(self.folder / f"plate_{size}", facts, rows))
        found = self.together(folders)
        self.assertAlmostEqual(found["bekker_n"].value, n, places=4)
        self.assertAlmostEqual(found["bekker_kphi"].value / kphi, 1, places=3)
        self.assertAlmostEqual(found["bekker_kc"].value / kc, 1, places=2)

    def test_oedometer_is_compared_with_a_reference(self) -> None:
        strain = np.linspace(0, 1.2, 500)
        density, modulus = 200 * np.exp(strain), 4.0
        axial = 4e3 * np.exp(modulus * strain)
        stress = np.column_stack((0.4 * axial, 0.4 * axial, axial))
        rows = cell_rows(np.column_stack((0 * strain, 0 * strain, strain)), stress)
        rows[:, 7] = np.concatenate((density[:1], density))
        folder = write_test(self.folder / "oedometer", "test oedometer ground snow", rows)
        self.assertAlmostEqual(self.values(folder)["K0"], 0.4, places=6)
        # stress = 4e3 (rho/200)^4: a reference twice as stiff is ln 2 away everywhere
        reference = self.folder / "reference.csv"
        pairs = [(rho, 8e3 * (rho / 200) ** 4) for rho in (430.0, 480.0, 540.0)]
        lines = "".join(f"{stress},{rho}\n" for rho, stress in pairs)
        reference.write_text("# made up\nsigma1_Pa,rho_kgm3\n" + lines)
        measured = read_oedometer_reference(reference)
        errors = reference_error(LaboratoryTest(folder), measured)
        found = {quantity.name: quantity.value for quantity in errors}
        self.assertAlmostEqual(found["rms_ln_stress"], float(np.log(2)), delta=1e-3)
        self.assertAlmostEqual(found["rms_ln_density"], float(np.log(2) / 4), delta=1e-3)

    def test_wedge_has_its_slope(self) -> None:
        random = np.random.default_rng(1)
        x, y = random.uniform(0, 0.32, 20000), random.uniform(0, 0.06, 20000)
        slope = np.tan(np.radians(28.0))
        z = random.uniform(0, 1, 20000) * (0.32 - x) * slope + 0.02
        folder = self.folder / "repose"
        folder.mkdir()
        (folder / "facts.txt").write_text("test repose ground sand diameter 0.01 length 0.32")
        grains = np.column_stack((np.arange(len(x)), x, y, z, np.full(len(x), 1e-4)))
        np.savetxt(folder / "deposit.dump", grains, header="\n" * 8, comments="")
        self.assertAlmostEqual(self.values(folder)["angle_of_repose"], 28.0, delta=1.0)

    def test_command_writes_json_and_figure(self) -> None:
        folder = self.triaxial(1e4)
        with contextlib.redirect_stdout(io.StringIO()) as screen:
            self.assertEqual(main(["laboratory", str(folder)]), 0)
        self.assertIn("friction_angle_end", screen.getvalue())
        content = json.loads((folder / "laboratory.json").read_text())
        self.assertIn("E50", content["quantities"])
        self.assertGreater((folder / "laboratory.png").stat().st_size, 10000)

    def test_faults_are_refused(self) -> None:
        with self.assertRaisesRegex(ResultsError, "has no facts.txt"):
            LaboratoryTest(self.folder)
        (self.folder / "facts.txt").write_text("test juggling")
        with self.assertRaisesRegex(ResultsError, "'juggling' is not one of oedometer"):
            LaboratoryTest(self.folder)
        (self.folder / "facts.txt").write_text("test oedometer")
        (self.folder / "curve.txt").write_text("0 1 2\n1 2 3\n")
        with self.assertRaisesRegex(ResultsError, "fewer than ten rows"):
            evaluate(LaboratoryTest(self.folder))


if __name__ == "__main__":
    unittest.main()
