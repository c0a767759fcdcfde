# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post laboratory on curves whose answers are known: a Mohr-Coulomb ground, Janosi's and Bekker's formulas, a cone, refusals."""

import contextlib
import importlib.machinery
import importlib.util
import io
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(os.environ["FURROW_SOURCE"]) / "postproc"))

from furrow_post import laboratory
from furrow_post.command import main
from furrow_post.results import ResultsError

PHI, COHESION = 31.0, 2000.0


def write(folder, facts, rows):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "facts.txt").write_text(facts)
    np.savetxt(folder / "curve.txt", rows)
    return folder


def cell(strain, stress, density=1500.0):
    """Rows of fix cell/servo: step, edges, stresses, density, inertial number; the first row has no forces."""
    rows = np.column_stack((np.arange(len(strain)), 0.1 * np.exp(-strain), stress, np.full(len(strain), density), np.full(len(strain), 1e-4)))
    return np.vstack((rows[:1], rows))


class Laboratory(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()

    def quantities(self, folder):
        return {q.name: q.value for q in laboratory.Test(folder).evaluate()}

    def triaxial(self, confinement):
        axial = np.linspace(0, 0.2, 400)
        N = np.tan(np.radians(45 + PHI / 2)) ** 2
        top = confinement * N + 2 * COHESION * np.sqrt(N) - confinement
        deviator = top * (1 - np.exp(-axial / 0.01))
        strain = np.column_stack((-0.6 * axial, -0.6 * axial, axial))  # grows by 0.2 of the axial strain
        stress = np.column_stack((np.full_like(axial, confinement),) * 2 + (confinement + deviator,))
        return write(self.folder / f"triaxial_{confinement:g}", f"test triaxial ground clay confinement {confinement}", cell(strain, stress))

    def test_mohr_coulomb_from_triaxial_tests(self):
        folders = [self.triaxial(c) for c in (1e4, 2e4, 5e4)]
        found = {q.name: q for q in laboratory.together([laboratory.Test(f) for f in folders])}
        self.assertAlmostEqual(found["friction_angle_end"].value, PHI, delta=0.02)
        self.assertAlmostEqual(found["cohesion_end"].value, COHESION, delta=5)
        one = self.quantities(folders[0])
        self.assertAlmostEqual(one["dilation"], 0.2, places=6)

    def test_janosi_from_shear(self):
        folders = []
        for sigma in (1e4, 3e4, 6e4):
            j = np.linspace(0, 0.05, 400)
            tau = (COHESION + sigma * np.tan(np.radians(PHI))) * (1 - np.exp(-j / 0.004))
            rows = cell(np.zeros((len(j), 3)), np.full((len(j), 3), sigma))
            rows = np.column_stack((rows[:, :8], np.concatenate((j[:1], j)), np.concatenate((tau[:1], tau))))
            folders.append(write(self.folder / f"shear_{sigma:g}", f"test shear ground clay confinement {sigma}", rows))
        self.assertAlmostEqual(self.quantities(folders[0])["janosi_K"], 0.004, delta=2e-5)
        found = {q.name: q.value for q in laboratory.together([laboratory.Test(f) for f in folders])}
        self.assertAlmostEqual(found["friction_angle_residual"], PHI, delta=0.05)
        self.assertAlmostEqual(found["cohesion_residual"], COHESION, delta=10)

    def test_bekker_from_two_plates(self):
        kc, kphi, n = 3e3, 1.5e6, 1.1
        folders = []
        for size in (0.06, 0.12):
            z = np.linspace(0, 0.03, 300)
            pressure = (kc / (size / 2) + kphi) * z**n
            folders.append(write(self.folder / f"plate_{size}", f"test plate ground clay size {size}",
                                 np.column_stack((np.arange(300), z, pressure * size, pressure))))
        found = {q.name: q.value for q in laboratory.together([laboratory.Test(f) for f in folders])}
        self.assertAlmostEqual(found["bekker_n"], n, places=4)
        self.assertAlmostEqual(found["bekker_kphi"] / kphi, 1, places=3)
        self.assertAlmostEqual(found["bekker_kc"] / kc, 1, places=2)

    def test_oedometer_against_a_reference(self):
        strain = np.linspace(0, 1.2, 500)
        density, modulus = 200 * np.exp(strain), 4.0
        axial = 4e3 * np.exp(modulus * strain)
        rows = cell(np.column_stack((0 * strain, 0 * strain, strain)), np.column_stack((0.4 * axial, 0.4 * axial, axial)))
        rows[:, 7] = np.concatenate((density[:1], density))
        folder = write(self.folder / "oedometer", "test oedometer ground snow", rows)
        values = self.quantities(folder)
        self.assertAlmostEqual(values["K0"], 0.4, places=6)
        # stress = 4e3 (rho/200)^4: a reference twice as stiff is ln 2 away everywhere
        reference = self.folder / "reference.csv"
        pairs = [(rho, 8e3 * (rho / 200) ** 4) for rho in (430.0, 480.0, 540.0)]
        reference.write_text("# made up\nsigma1_Pa,rho_kgm3\n" + "".join(f"{s},{r}\n" for r, s in pairs))
        found = {q.name: q.value for q in laboratory.reference_error(laboratory.Test(folder), laboratory.read_reference(reference))}
        self.assertAlmostEqual(found["rms_ln_stress"], np.log(2), delta=1e-3)
        self.assertAlmostEqual(found["rms_ln_density"], np.log(2) / 4, delta=1e-3)

    def test_cap_law_from_its_own_curves(self):
        """inputs/laboratory/identify finds phi, E, nu, R and the hardening line of the law that the curves were made with."""
        path = Path(os.environ["FURROW_SOURCE"]) / "inputs" / "laboratory" / "identify"
        loader = importlib.machinery.SourceFileLoader("identify", str(path))
        identify = importlib.util.module_from_spec(importlib.util.spec_from_loader("identify", loader))
        loader.exec_module(identify)
        tangent, E, nu, R, H = 1.1, 4e6, 0.2, 0.3, 2e6  # p_b = its first value + H eps
        sine = 3 * tangent / (6 + tangent)  # triaxial compression
        folders = []
        for lateral in (1e4, 5e4):
            axial = np.linspace(0, 0.2, 4000)
            q = np.minimum(E * axial, lateral * tangent / (1 - tangent / 3))
            strain = np.column_stack((-nu * axial, -nu * axial, axial))
            stress = np.column_stack((np.full_like(axial, lateral),) * 2 + (lateral + q,))
            folders.append(write(self.folder / f"triaxial_{lateral:g}", f"test triaxial ground made confinement {lateral}", cell(strain, stress)))
        found, _ = identify.friction([laboratory.Test(f) for f in folders])
        self.assertAlmostEqual(found, sine, delta=1e-3)
        self.assertAlmostEqual(identify.MATCH["triaxial"][0](found), tangent, delta=4e-3)
        self.assertAlmostEqual(identify.MATCH["plane_strain"][0](np.sin(np.radians(30.0))), np.sqrt(0.75), places=9)
        np.testing.assert_allclose(identify.elasticity(laboratory.Test(folders[1])), (E, nu), rtol=1e-3)
        p, q, tip = identify.stresses(np.geomspace(1e3, 3e5, 3000), R, tangent, 0.0)
        self.assertAlmostEqual(identify.eccentricity(float(((p - q / 3) / (p + 2 * q / 3))[0]), tangent), R, delta=1e-3)
        self.assertEqual(identify.eccentricity(0.1, tangent), identify.SMALLEST)
        axial = p + 2 * q / 3
        compression = (p - p[0]) * 3 * (1 - 2 * nu) / E + (tip - tip[0]) / H  # elastic and plastic volume
        rows = cell(np.column_stack((0 * p, 0 * p, compression)), np.column_stack((p - q / 3, p - q / 3, axial)))
        rows[:, 7] = 1500.0 * np.exp(np.concatenate((compression[:1], compression)))
        test = laboratory.Test(write(self.folder / "oedometer", "test oedometer ground made", rows))
        hardening, density = identify.hardening(test, R, tangent, 0.0, E, nu)
        self.assertAlmostEqual(density, 1500.0, places=6)
        self.assertGreater(len(hardening), 6)
        for p_b, plastic in hardening:
            self.assertAlmostEqual(p_b, tip[0] + H * plastic, delta=0.01 * p_b)

    def test_slope_of_a_wedge(self):
        generator = np.random.default_rng(1)
        x, y = generator.uniform(0, 0.32, 20000), generator.uniform(0, 0.06, 20000)
        z = generator.uniform(0, 1, 20000) * (0.32 - x) * np.tan(np.radians(28.0)) + 0.02
        folder = self.folder / "repose"
        folder.mkdir()
        (folder / "facts.txt").write_text("test repose ground sand diameter 0.01 length 0.32")
        grains = np.column_stack((np.arange(len(x)), x, y, z, np.full(len(x), 1e-4)))
        np.savetxt(folder / "deposit.dump", grains, header="\n" * 8, comments="")
        self.assertAlmostEqual(self.quantities(folder)["angle_of_repose"], 28.0, delta=1.0)

    def test_command_writes_json_and_figure(self):
        folder = self.triaxial(1e4)
        with contextlib.redirect_stdout(io.StringIO()) as screen:
            self.assertEqual(main(["laboratory", str(folder)]), 0)
        self.assertIn("friction_angle_end", screen.getvalue())
        self.assertIn("E50", json.loads((folder / "laboratory.json").read_text())["quantities"])
        self.assertGreater((folder / "laboratory.png").stat().st_size, 10000)

    def test_refusals(self):
        with self.assertRaisesRegex(ResultsError, "has no facts.txt"):
            laboratory.Test(self.folder)
        (self.folder / "facts.txt").write_text("test juggling")
        with self.assertRaisesRegex(ResultsError, "'juggling' is not one of oedometer"):
            laboratory.Test(self.folder)
        (self.folder / "facts.txt").write_text("test oedometer")
        (self.folder / "curve.txt").write_text("0 1 2\n1 2 3\n")
        with self.assertRaisesRegex(ResultsError, "fewer than ten rows"):
            laboratory.Test(self.folder).evaluate()


if __name__ == "__main__":
    unittest.main()
