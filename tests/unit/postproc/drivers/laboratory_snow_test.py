# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/laboratory/identify_snow.py: what it reads from curves, that it finds the law a record was
made with, and that the preset is what it makes of its record; snow_strength.py: what it draws."""

import re
import sys
import unittest
from dataclasses import replace

import numpy as np

from furrow_post.errors import ResultsError
from furrow_post.read.laboratory import LaboratoryTest
from furrow_post.run.tools import Tools
from support.command import SOURCE
from support.folder import FolderTest
from support.laboratory import axisymmetric, cell_rows, write_cell, write_test

sys.path.insert(0, str(SOURCE / "inputs" / "laboratory"))

import identify_snow
import snow_strength
from snow_laws import LAWS, Elastic, Material, compared_rows, fit
from snow_paths import Points, predicted
from snow_record import Place, Row, read_record, record_of, write_record

RECORDS = SOURCE / "inputs" / "laboratory" / "records"
MATERIALS = SOURCE / "inputs" / "materials" / "variants"
RECORD = RECORDS / "snow_bonded.csv"
PRESET = MATERIALS / "snow_bonded_cam_clay.yaml"

NUMBER = r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?"

# A law of 200 kg/m3 whose strength grows by e in 0.15 of volume strain
STRAINS = np.array([0.0, 0.15, 0.3, 0.45, 0.6])
TABLE = [(200 * float(np.exp(e)), 1e3 * float(np.exp(e / 0.15))) for e in STRAINS]
MADE = Material(LAWS["cam_clay"], (3.0, 0.25), Elastic(2e7, 0.0), 200.0, TABLE)


def shear_strength(M: float, beta: float, p0: float, load: float) -> float:
    """Shear strength of Cam clay between sides that do not move: stress tau that flows without lateral strain."""
    side = M**2 * ((1 - beta) * p0 - 2 * load) / (9 * (1 + 2 * beta) + 4 * M**2)
    p = load + 2 * side  # side: deviatoric stress along x and y
    q2 = M**2 * (p + beta * p0) * (p0 - p) / (1 + 2 * beta)
    return float(np.sqrt(q2 / 3 - 3 * side**2))


class RecordTest(FolderTest):
    def test_curves_have_the_closed_form(self) -> None:
        """Two packings, one 10 % stronger: means, scatter, and the place of each value."""
        tests = []
        axial, pulled = np.linspace(0, 0.6, 2000), np.linspace(0, 1e-3, 400)
        for packing, strength in enumerate((1.0, 1.1)):
            stress = 2e3 * strength * np.exp(axial / 0.1)
            lateral, density = axisymmetric(0.1 * stress, stress), 200 * np.exp(axial)
            free, q = axisymmetric(-0.3 * axial, axial), axisymmetric(0, 5e3 * strength + 0 * axial)
            pull = axisymmetric(0, -np.minimum(1e7 * pulled, 4e3 * strength))
            still = cell_rows(np.zeros((400, 3)), axisymmetric(0, np.full(400, 1e3)), 300.0)
            tau = np.append(0.0, 6e3 * strength * np.minimum(np.linspace(0, 5, 400), 1))
            rows = np.column_stack((still[:, :8], np.linspace(0, 0.01, 401), tau))
            facts = "test shear ground made compaction 0.4 confinement 1000"
            tests += [
                write_cell(self.folder / f"o{packing}", "oedometer", axisymmetric(0, axial), lateral, density),
                write_cell(self.folder / f"u{packing}", "unconfined", free, q, compaction=0.7),
                write_cell(self.folder / f"t{packing}", "tension", axisymmetric(0, -pulled), pull, compaction=0),
                write_test(self.folder / f"s{packing}", facts, rows),
            ]
        rows_of = record_of(LaboratoryTest(test) for test in tests)
        write_record(self.folder / "record.csv", rows_of)
        found = {row.place: row for row in read_record(self.folder / "record.csv")}
        expected = {
            Place("oedometer", 0, 0, 2e4, "K0"): (0.1, 0.0),
            Place("unconfined", 0.7, 0, 0.2, "lateral_ratio"): (0.3, 0.0),
            Place("unconfined", 0.7, 0, 0.1, "stress"): (5.25e3, 500 / np.sqrt(2)),
            Place("tension", 0, 0, 0, "strength"): (4.2e3, 400 / np.sqrt(2)),
            Place("tension", 0, 0, 0, "modulus"): (1e7, 0.0),
            Place("shear", 0.4, 1e3, 0, "strength"): (6.3e3, 600 / np.sqrt(2)),
            Place("shear", 0.4, 1e3, 0, "density"): (300.0, 0.0),
        }
        for place, (value, scatter) in expected.items():
            self.assertEqual(found[place].packings, 2)
            self.assertAlmostEqual(found[place].value / value, 1.0, delta=2e-3, msg=str(place))
            self.assertAlmostEqual(found[place].scatter / value, scatter / value, delta=1e-3)
        density = np.mean([200 * (2e4 / s) ** 0.1 for s in (2e3, 2.2e3)])
        at_20_kPa = found[Place("oedometer", 0, 0, 2e4, "density")]
        self.assertAlmostEqual(at_20_kPa.value / density, 1.0, delta=1e-3)

    def test_faults_are_refused(self) -> None:
        rows = np.ones((20, 9))
        sand = write_test(self.folder / "s", "test plate ground made", rows)
        with self.assertRaisesRegex(ResultsError, "is a test 'plate'; name results of oedometer"):
            record_of([LaboratoryTest(sand)])
        self.assertRaisesRegex(ResultsError, "name results of that test too", record_of, [])


class FitTest(FolderTest):
    def points(self) -> Points:
        tools = Tools.of(SOURCE / "inputs" / "laboratory" / "run.py")
        return self.enterContext(Points(tools, self.folder))

    def test_law_of_a_record_is_recovered(self) -> None:
        kinds = [
            ("oedometer", 0.0, (0.0,), ("density",)),
            ("oedometer", 0.0, (5e3, 1e4, 2e4, 5e4), ("density", "K0")),
            *(("tension", c, (0.0,), ("strength",)) for c in (0.0, 0.4)),
            *(("unconfined", c, (0.1, 0.2), ("stress", "lateral_ratio")) for c in (0.0, 0.4)),
        ]
        rows = [
            Row(test, compaction, 0.0, level, quantity, 0.0, 0.0, 1)
            for test, compaction, levels, quantities in kinds
            for level in levels
            for quantity in quantities
        ]
        values = predicted(MADE.sections(), rows, self.points())
        record = [replace(row, value=values[row.place]) for row in rows]
        record.append(Row("tension", 0.0, 0.0, 0.0, "modulus", 2e7, 0.0, 1))
        found = fit(MADE.law, record, self.points(), start=(2.4, 0.1))
        np.testing.assert_allclose(found.shape, MADE.shape, rtol=0.02)
        for density, strength in found.table:
            made = np.interp(np.log(density / 200), STRAINS, np.log([p for _, p in TABLE]))
            self.assertAlmostEqual(np.log(strength), made, delta=0.03)

    def test_shear_of_a_law_has_the_closed_form(self) -> None:
        """It ends in flow without lateral strain: df/d(sigma_xx) = 0 with sigma_zz given, on
        q^2 (1 + 2 beta) = M^2 (p + beta p0)(p0 - p)."""
        loads = (1.0, 300.0)
        rows = [Row("shear", 0.0, load, 0.0, "strength", 0.0, 0.0, 1) for load in loads]
        values = predicted(MADE.sections(), rows, self.points())
        (M, beta), p0 = MADE.shape, TABLE[0][1]
        for row in rows:
            tau = shear_strength(M, beta, p0, row.confinement)
            self.assertAlmostEqual(values[row.place] / tau, 1.0, delta=2e-3)

    def test_strengths_are_compared_with_measurements(self) -> None:
        """Clusters as the record has them, a preset's undisturbed snow in closed form, slabs of
        200 kg/m3 as [Sigrist2006] has them."""
        record = read_record(RECORD)
        found = snow_strength.of_clusters(record)
        for kind, load in (("tension", 0.0), ("shear", 100.0)):
            rows = [r for r in record if (r.test, r.confinement, r.quantity) == (kind, load, "strength")]
            np.testing.assert_array_equal(found[kind].strength, [row.value for row in rows])
            self.assertTrue((np.diff(found[kind].density) > 50).all())
        law = snow_strength.of_law("snow_bonded", 100.0, self.points())["shear"]
        text = PRESET.read_text(encoding="utf-8")
        M, beta, p0 = (float(re.findall(rf"{key}: +\[?({NUMBER})", text)[0]) for key in ("M", "tension_ratio", "p"))
        self.assertAlmostEqual(law.strength[0] / shear_strength(M, beta, p0, 100.0), 1.0, delta=5e-3)
        slabs = snow_strength.measured("tension")[0]
        self.assertAlmostEqual(float(slabs.at(200.0)), 5.85e3, delta=10)

    def test_preset_is_the_fit_of_its_record(self) -> None:
        record = read_record(RECORD)
        material = fit(LAWS["cam_clay"], record, self.points())
        rows = compared_rows(record)
        values = predicted(material.sections(), rows, self.points())
        made = identify_snow.material_text("snow: fitted", RECORD, material, rows, values)
        title, made = made.split("\n", 1)
        self.assertEqual(title, 'title: "snow: fitted"')  # one text, whatever is in it
        _, shipped = PRESET.read_text(encoding="utf-8").split("\n", 1)
        shipped, _ = shipped.split("contact:", 1)  # of which a laboratory without a wheel knows nothing
        self.assertEqual(re.sub(NUMBER, "N", made).split(), re.sub(NUMBER, "N", shipped).split())
        both = [[float(x) for x in re.findall(NUMBER, text)] for text in (made, shipped)]
        np.testing.assert_allclose(both[0], both[1], rtol=0.02, atol=0.011)

    def test_preset_of_the_slab_has_its_stated_misfit(self) -> None:
        """Free sides at every density, which the clusters of snow_bonded do not give a law."""
        preset = MATERIALS / "snow_bonded_slab_cam_clay.yaml"
        rows = compared_rows(read_record(RECORDS / "snow_bonded_slab.csv"))
        values = predicted(identify_snow.sections_of(preset), rows, self.points())
        found = identify_snow.deviations(rows, values)
        lines = preset.read_text(encoding="utf-8").splitlines()
        said = " ".join(line[2:] for line in lines if line.startswith("# "))
        for kind, value in found.items():
            self.assertIn(f"{identify_snow.meaning(kind)} {identify_snow.cell(value)}", said)
        self.assertLess(found["unconfined", "stress"][0], 0.2)


if __name__ == "__main__":
    unittest.main()
