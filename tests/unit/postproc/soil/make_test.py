# SPDX-License-Identifier: GPL-2.0-or-later
"""Material files of furrow-post card material: closed forms, virtual tests of the laws, and refusals."""

import math
import re
import unittest
from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import yaml

from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.soil.make import (
    CLASSES,
    Strength,
    bands_of,
    compression,
    cone_resistance,
    estimate_of,
    from_bekker,
    from_cone,
    from_strength,
    middle,
)
from furrow_post.read.soil_card import Range
from furrow_post.soil.material import read_material
from furrow_post.soil.oedometer import confined_strain, oedometer_misfit, read_oedometer
from support.command import SOURCE, run_card
from support.folder import FolderTest

OEDOMETER = "# mine\nstress_Pa,strain\n1e4,0.02\n2e4,0.03\n5e4,0.045\n1e5,0.06\n3e5,0.09\n"

BAND = re.compile(r"(.+): (\S+), (\S+) to ([^\s:]+)")


def bands(lines: Iterable[str]) -> dict[str, tuple[float, float, float]]:
    """Quantity -> value and ends of the bands in lines of text."""
    found = [match.groups() for line in lines if (match := BAND.match(line))]
    return {name: (float(value), float(low), float(high)) for name, value, low, high in found}


class MakeTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.table = self.folder / "oedometer.csv"
        self.table.write_text(OEDOMETER, encoding="utf-8")
        self.file = self.folder / "mine.yaml"

    def test_law_has_the_strength_of_mohr_coulomb(self) -> None:
        # triaxial compression at s3: s1 = s3 N + 2 c sqrt(N); extension with s1 on two sides
        c, phi, s3 = 2e3, 30.0, 1e4
        strength = Strength(c, phi)
        n = math.tan(math.radians(45 + phi / 2)) ** 2
        s1 = s3 * n + 2 * c * math.sqrt(n)
        p, q = (s1 + 2 * s3) / 3, s1 - s3
        self.assertAlmostEqual(q / (strength.d + p * strength.tangent), 1, places=12)
        p = (2 * s1 + s3) / 3
        self.assertAlmostEqual(q / (strength.K * (strength.d + p * strength.tangent)), 1, places=12)

    def test_law_has_the_oedometer_of_its_data(self) -> None:
        oedometer = read_oedometer(self.table)
        made = from_strength("mine", 500.0, 33.0, 1600.0, oedometer, None)
        self.file.write_text(made.text(), encoding="utf-8")
        self.assertLess(oedometer_misfit(self.file, oedometer), 2e-3)
        between = confined_strain(self.file, (3e4,))[0]
        self.assertTrue(0.03 < between < 0.045)
        self.assertEqual(read_material(self.file).density, 1600)

    def test_norsand_has_pressure_dependent_elasticity(self) -> None:
        material = read_material(SOURCE / "inputs" / "materials" / "norsand_dry.yaml")
        # by hand: 2 G (1 + nu) at a tenth of the pressure of G, to which the law adds pt
        young = 2 * 1.686e6 * (1 + 0.227) * ((1e4 + 20) / 1e5) ** 0.3320
        self.assertAlmostEqual(material.young / young, 1, places=9)
        self.assertAlmostEqual(material.wave_speed, 38.3, places=1)

    def test_modulus_gives_the_curve_of_janbu(self) -> None:
        made = from_strength("mine", 0.0, 33.0, 1600.0, None, 1.2e7)
        self.file.write_text(made.text(), encoding="utf-8")
        low, high = confined_strain(self.file, (9.9e4, 1.01e5))
        self.assertAlmostEqual(2e3 / (high - low) / 4e6, 1, delta=0.15)  # E/3, piecewise linear
        self.assertIn("GUESSED: Janbu", self.file.read_text())

    def test_bekkers_plate_is_a_confined_layer(self) -> None:
        made = from_bekker("mine", 5270.0, 1515040.0, 0.7, 1720.0, 29.0, 0.025, 0.075, None)
        self.file.write_text(made.text(), encoding="utf-8")
        strain = confined_strain(self.file, (2e4, 4e4))
        z = ((2e4 / (5270 / 0.075 + 1515040)) ** (1 / 0.7), (4e4 / (5270 / 0.075 + 1515040)) ** (1 / 0.7))
        np.testing.assert_allclose(strain, np.array(z) / (0.96 * 0.15), rtol=0.08)
        self.assertIn("K = 0.025 m is not used", self.file.read_text())

    def test_cone_index_gives_strength_by_vesic(self) -> None:
        # without friction, with the rigidity index G/c
        c, shear, depth = 2e4, 2e6, 0.1
        weight = 1800 * 9.80665 * depth
        expected = c * (4 / 3 * (math.log(shear / c) + 1) + math.pi / 2 + 1) + weight
        found = cone_resistance(Strength(c, 0.0), 1800, shear, depth)
        self.assertAlmostEqual(found / expected, 1, places=12)
        # continuous in phi
        self.assertAlmostEqual(cone_resistance(Strength(c, 0.2), 1800, shear, depth) / expected, 1, delta=0.02)
        for soil_class, index in (("SP", 3e5), ("CL", 4e5), ("CH", 2e5)):
            made = from_cone("mine", index, soil_class, None)
            self.file.write_text(made.text(), encoding="utf-8")
            law = yaml.safe_load(self.file.read_text())["law"]
            self.assertEqual(law["density"], float(f"{middle(CLASSES[soil_class].density):.6g}"))
            self.assertGreaterEqual(len(made.guesses()), 6)

    def test_firmer_cone_gives_a_stronger_soil(self) -> None:
        betas = [float(from_cone("s", q, "SP", None).law["beta"].value) for q in (1e5, 2e5, 4e5)]
        cohesions = [float(from_cone("c", q, "CL", None).law["d"].value) for q in (1e5, 2e5, 4e5)]
        self.assertEqual(betas, sorted(betas))
        self.assertEqual(cohesions, sorted(cohesions))

    def test_band_contains_the_value_of_the_file(self) -> None:
        for soil_class, typical in CLASSES.items():
            for index in (1e5, 2e5, 3e5):
                made = from_cone("mine", index, soil_class, None)
                found = bands(made.bands)
                for name, (value, low, high) in found.items():
                    self.assertTrue(low <= value <= high, f"{soil_class}, {index:g} Pa: {name}")
                written = {"density, kg/m3": made.law["density"], "E, Pa": made.elasticity["E"]}
                for name, parameter in written.items():
                    self.assertAlmostEqual(found[name][0] / float(parameter.value), 1, delta=5e-3, msg=soil_class)
                self.assertTrue(set(made.bands) < {line[2:] for line in made.text().splitlines()})
                self.assertTrue(typical.friction.low <= typical.phi <= typical.friction.high, soil_class)

    def test_every_end_of_a_band_has_the_cone_index(self) -> None:
        index, typical = 4e5, CLASSES["CL"]
        found = bands(from_cone("mine", index, "CL", None).bands)
        ends = []
        for density in (typical.density.low, typical.density.high):
            for ratio in (3.0, 8.0):  # of the source, below 0.7 MPa
                for phi in (27.0, 35.0):
                    soil = estimate_of(index, typical, density, ratio, phi)
                    q = cone_resistance(soil.strength, density, ratio * index / 2.5, 0.075)
                    self.assertAlmostEqual(q / index, 1, places=9)
                    ends.append(soil.strength.c)
        _, low, high = found["cohesion, Pa"]
        self.assertAlmostEqual(low / min(ends), 1, delta=5e-3)
        self.assertAlmostEqual(high / max(ends), 1, delta=5e-3)

    def test_friction_alone_ends_the_band_of_a_weak_silt(self) -> None:
        made = from_cone("mine", 2e5, "ML", None)
        _, low, high = bands(made.bands)["friction angle, degrees"]
        self.assertEqual(low, CLASSES["ML"].friction.low)
        self.assertTrue(32 < high < CLASSES["ML"].friction.high)

    def test_ends_without_a_strength_are_counted(self) -> None:
        # loose sand of a modulus of 2 needs more than 48 degrees
        made = from_cone("mine", 9e5, "SP", None)
        self.assertIn("ends of the ranges without a strength of this cone index, not in the bands: 1", made.bands)
        self.assertNotIn("without a strength", from_cone("mine", 3e5, "SP", None).text())

    def test_given_friction_angle_has_no_band(self) -> None:
        for soil_class in ("SP", "ML"):
            found = bands(from_cone("mine", 4e5, soil_class, None, 33.0).bands)
            self.assertNotIn("friction angle, degrees", found)
            self.assertIn("cohesion, Pa", found)

    def test_wider_range_gives_a_wider_band(self) -> None:
        typical = CLASSES["SP"]
        soil = estimate_of(2e5, typical, middle(typical.density), 2.0, None)
        density = Range(typical.density.low - 100, typical.density.high + 100)
        wider = (replace(typical, density=density), replace(typical, moduli=((math.inf, Range(1, 6)),)))
        before = bands(bands_of(soil, typical, None, None))
        for changed in wider:
            after = bands(bands_of(soil, changed, None, None))
            for name in ("friction angle, degrees", "shear strength over a pressure of 100 kPa"):
                self.assertLess(after[name][1], before[name][1], name)
                self.assertGreater(after[name][2], before[name][2], name)
        given = bands(bands_of(soil, typical, soil.density, None))
        self.assertNotIn("density, kg/m3", given)
        self.assertLess(given["friction angle, degrees"][2], before["friction angle, degrees"][2])

    def test_class_without_a_range_states_it(self) -> None:
        for soil_class, typical in CLASSES.items():
            text = "\n".join(from_cone("mine", 3e5, soil_class, None).bands)
            known = "no range known for this class" not in text
            self.assertEqual(known, bool(typical.moduli), soil_class)
        self.assertFalse(CLASSES["GW"].moduli)

    def test_known_friction_angle_gives_the_cohesion_of_moist_sand(self) -> None:
        made = from_cone("moist", 6e5, "SP", 1700.0, 36.0)
        n = math.tan(math.radians(45 + 36 / 2)) ** 2
        M = 6 * math.sin(math.radians(36)) / (3 - math.sin(math.radians(36)))
        self.assertAlmostEqual(math.tan(math.radians(float(made.law["beta"].value))), M, places=9)
        # uniaxial strength 2 c sqrt(n) lies on q = d + p M with p = q/3
        c = float(made.law["d"].value) / (2 * math.sqrt(n) * (1 - M / 3))
        q = cone_resistance(Strength(c, 36.0), 1700, 2 * 6e5 / 2.5, 0.075)
        self.assertAlmostEqual(q / 6e5, 1, places=9)

    def test_table_ends_before_the_soil_has_no_voids(self) -> None:
        made = from_bekker("mine", 5270.0, 1515040.0, 0.7, 1720.0, 29.0, 0.025, 0.075, None)
        self.assertLess(1600 * math.exp(made.strain[-1]), 2650)
        self.assertGreater(1600 * math.exp(made.strain[-1]), 1800)

    def test_virtual_cone_in_an_estimated_sand_has_the_given_index(self) -> None:
        inputs = SOURCE / "inputs"
        for row in read_rows(inputs / "soils" / "cone_on_estimated_sand.csv"):
            asked = float(row["asked_Pa"])
            stored = yaml.safe_load((inputs / "materials" / f"{row['file']}.yaml").read_text())["law"]
            made = from_cone("mine", asked, "SP", float(row["density_kgm3"]))
            self.assertAlmostEqual(float(made.law["beta"].value), stored["beta"], delta=1e-3)
            self.assertAlmostEqual(float(row["index_Pa"]) / asked, 1, delta=0.15)

    def test_command_in_the_head_of_a_soil_writes_its_file(self) -> None:
        inputs = SOURCE / "inputs"
        for row in read_rows(inputs / "soils" / "cone_on_cohesive_soil.csv"):
            text = (inputs / "materials" / f"{row['file']}.yaml").read_text()
            command = re.search(r"furrow-post card material (\S+) (.*)", text)
            assert command, row
            done = run_card("material", command[1], *command[2].split(), "--no-check", folder=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            written = (self.folder / command[1]).read_text()
            made, stored = yaml.safe_load(written), yaml.safe_load(text)
            self.assertEqual({key: stored[key] for key in made if key != "title"}, {key: made[key] for key in made if key != "title"})
            self.assertTrue({line for line in written.splitlines() if line.startswith("#")} <= set(text.splitlines()))
            index = float(row["index_Pa"])
            self.assertIn(f"{1e-3 * index:.0f} kPa", stored["title"])
            self.assertAlmostEqual(float(row["asked_Pa"] or index) / index, 1, delta=0.2)
            self.assertAlmostEqual(float(stored.get("cone_index", index)) / index, 1, delta=2e-3)

    def test_every_estimate_is_marked_in_the_file(self) -> None:
        done = run_card("material", self.file, "--c", 500, "--phi", 33, "--density", 1600,
                        "--oedometer", self.table, folder=self.folder)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        marked = [line.split(":")[0].strip() for line in self.file.read_text().splitlines() if "GUESSED" in line]
        self.assertEqual(marked, ["R", "E", "nu"])
        for name in marked:
            self.assertIn(f"guessed       {name}: ", done.stdout)
        self.assertRegex(done.stdout, r"check +virtual oedometer: rms 0\.\d% of the greatest measured strain")

    def test_wrong_units_and_tables_are_refused(self) -> None:
        good: dict[str, object] = {"--c": 500, "--phi": 33, "--density": 1600, "--E": 1e7}
        changes: tuple[tuple[dict[str, object], str], ...] = (
            ({"--c": 0.5}, r"c is 0.5 Pa; soils and snow have 20 to 5e\+06 Pa or 0. Give SI units: kPa times 1000"),
            ({"--phi": 0.58}, "phi is 0.58 degrees; .*radians times 57.3"),
            ({"--density": 1.6}, "density is 1.6 kg/m3; .*g/cm3 times 1000"),
            ({"--E": 10}, "E is 10 Pa; .*MPa times 1e6"),
            ({"--E": None}, "needs --oedometer FILE or --E"),
            ({"--phi": None}, "--c needs --phi as well"),
            ({"--n": 0.7}, "--c does not use --n; leave it out"),
            ({"--c": None, "--phi": None, "--density": None, "--E": None}, "needs --c, --k_phi or --cone_index"),
            ({"--oedometer": "none.csv"}, "none.csv: no such file"),
        )
        for change, message in changes:
            words = [w for k, v in {**good, **change}.items() if v is not None for w in (k, v)]
            done = run_card("material", self.file, "--no-check", *words, folder=self.folder)
            self.assertEqual(done.returncode, 1, message)
            self.assertRegex(done.stderr, f"^furrow-post: .*{message}")
        self.assertFalse(self.file.exists())
        for text, message in (
            ("force,strain\n1e4,0.1\n", "has no column of the stress; it has 'force', 'strain'; an oedometer is"),
            ("stress_Pa,height\n1e4,0.1\n", "has no column of the strain"),
            ("stress_Pa,strain\n10,0.02\n20,0.03\n50,0.04\n", "row 1: stress is 10 Pa"),
            ("stress_Pa,strain\n1e4,2\n2e4,3\n5e4,4\n", "'strain' has no unit, and values up to 4: in ratio .*in %"),
            ("stress,strain\n10,0.02\n20,0.03\n50,0.04\n", "'stress' has no unit, and values up to 50: in Pa .*in kPa"),
            ("stress_Pa,strain\n1e4,0.02\n5e4,0.04\n2e4,0.05\n", "increasing stress and increasing strain"),
            ("stress_Pa,strain\n1e4,0.02\n5e4,0.04\n6e4,0.05\n2e4,0.06\n", "falls from 60000 to 20000 Pa and the strain"),
            ("stress_Pa,strain\n1e4,soft\n", "has no column of the strain"),
            ("stress_Pa,strain,eps_v\n1e4,0.1,0.1\n", "'strain', 'eps_v', which may all be the strain"),
            ("stress_Pa,strain\n1e4,-0.02\n5e4,0.04\n", "strain has values of both signs"),
        ):
            self.table.write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(ResultsError, message):
                read_oedometer(self.table)

    def test_tables_of_laboratories_give_the_same_test(self) -> None:
        """The same numbers in the units, signs and dialects of apparatus and programs."""
        wanted = read_oedometer(self.table)
        strain = np.array(wanted.strain)
        stress = np.array(wanted.stress) / 1e3
        void = 0.8 - 1.8 * (strain - strain[0])

        def rows(head: str, separator: str, *columns: object) -> str:
            lines = [head, *(separator.join(f"{v:.12g}" for v in row) for row in zip(*columns))]  # type: ignore[call-overload]
            return "\n".join(lines) + "\n"

        comma = rows("Stress [kPa];Strain (%)", ";", stress, 100 * strain).replace(".", ",")
        for text in (
            rows("sigma_kPa,strain_percent", ",", stress, 100 * strain),
            "\ufeff" + rows("vertical stress [kPa],axial strain [%]", ",", stress, 100 * strain),
            comma,
            rows("stress_kPa\tstrain", "\t", -stress, -strain),
            rows("stress_kPa,strain", ",", stress, strain).replace("\n20,", "\n,\n15,\n20,"),
        ):
            self.table.write_text(text, encoding="utf-8")
            found = read_oedometer(self.table)
            np.testing.assert_allclose(found.stress, wanted.stress, rtol=1e-9, err_msg=text)
            np.testing.assert_allclose(found.strain, wanted.strain, rtol=1e-9, err_msg=text)
        self.table.write_text(rows("stress_kPa,e", ",", stress, void), encoding="utf-8")
        found = read_oedometer(self.table)
        np.testing.assert_allclose(found.strain, strain - strain[0], rtol=1e-9, atol=1e-12)
        self.assertIn("void ratio, 0.8 at the first stress", found.notes[0])

    def test_unloading_gives_the_modulus_of_elasticity(self) -> None:
        """Closed form of confined compression: Hooke's law without lateral strain."""
        unloaded = "stress_kPa,strain\n10,0.02\n20,0.03\n50,0.045\n100,0.06\n25,0.058\n100,0.0601\n300,0.09\n"
        self.table.write_text(unloaded, encoding="utf-8")
        found = read_oedometer(self.table)
        self.assertEqual(found.stress, (1e4, 2e4, 5e4, 1e5, 3e5))
        self.assertAlmostEqual(found.unloading / (75e3 / 0.002), 1, places=9)
        made = from_strength("mine", 500.0, 33.0, 1600.0, found, None)
        self.assertAlmostEqual(float(made.elasticity["E"].value) / (75e3 / 0.002 * 1.25 * 0.5 / 0.75), 1, places=9)
        self.assertNotIn("E", [guess.split(":")[0] for guess in made.guesses()])

    def test_impossible_strengths_are_refused(self) -> None:
        with self.assertRaisesRegex(ResultsError, "no friction angle of 5 to 48 gives a cone index"):
            from_cone("mine", 1.5e7, "SP", None)
        with self.assertRaisesRegex(ResultsError, "there is no soil class 'XX'; allowed: GW, "):
            from_cone("mine", 3e5, "XX", None)
        with self.assertRaisesRegex(ResultsError, "softer than the oedometer"):
            from_strength("mine", 500.0, 33.0, 1600.0, read_oedometer(self.table), 1e5)
        with self.assertRaisesRegex(ResultsError, "--oedometer FILE or --E"):
            compression(None, None)


if __name__ == "__main__":
    unittest.main()
