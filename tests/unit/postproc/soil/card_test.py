# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil cards: the file and its exports hold the same values, and wrong cards are refused."""

import json
import math
import re
import unittest
from dataclasses import replace

import numpy as np

from furrow_post.laws import empirical
from furrow_post.laws.terrain_values import terrain
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.read.soil_card import (
    UNITS,
    Cone,
    Fitted,
    NoResult,
    PressureSinkage,
    Range,
    Shear,
    SoilCard,
    markdown,
    read_card,
    write_card,
)
from furrow_post.soil.exports import EXPORTS, write_altair, write_chrono, write_table
from furrow_post.soil.material import read_contact
from support.command import SOURCE
from support.folder import FolderTest

CARD = SoilCard(
    "Soil card of loose sand",
    "sand.yaml",
    1505.0,
    7.5e7,
    9.80665,
    PressureSinkage(
        Fitted(-1234.5678901234, 321.0),
        Fitted(1.23456789e6, 2.5e4),
        Fitted(0.87654321, 0.02),
        Range(1e-3, 0.06),
        Range(1e3, 6e4),
        Range(0.05, 0.1),
        0.03,
    ),
    Shear(
        Fitted(150.0, 60.0),
        Fitted(29.25, 0.5),
        Fitted(0.0123, 0.0004),
        Fitted(35.0, 12.0),
        Range(3e3, 1.2e4),
        Range(0.0, 0.04),
        0.02,
    ),
    Cone(Fitted(7.1e4, 900.0), Fitted(8e5, 2e4), Range(0.0, 0.15), 0.02027, 30.0),
    ("cells: not in the errors",),
)


PLATE, SHEAR = CARD.bekker_and_shear()
WITHOUT_RING = replace(CARD, shear=NoResult("the ring sank through"))


class SoilCardTest(FolderTest):
    def test_strength_of_resistive_force_theory_is_the_best_line_through_zero(self) -> None:
        plates = CARD.pressure_sinkage
        assert isinstance(plates, PressureSinkage)
        depth = (np.arange(20000) + 0.5) / 20000 * 0.03
        pressure = plates.at(depth, 0.07)
        slope = float(depth @ pressure / (depth @ depth))
        xi, deviation = plates.rft_strength(0.03, 0.07)
        self.assertAlmostEqual(0.875 * xi / slope, 1, places=6)
        rms = float(np.sqrt(np.mean((pressure - slope * depth) ** 2)))
        self.assertAlmostEqual(deviation / (rms / pressure[-1]), 1, places=3)

    def setUp(self) -> None:
        super().setUp()
        self.path = self.folder / "card.yaml"
        write_card(CARD, self.path)

    def test_card_has_the_contact_of_its_ground(self) -> None:
        contact = read_contact(SOURCE / "inputs/materials/norsand_dense.yaml")
        assert contact
        self.assertEqual(contact["rubber"]["friction"], 0.41)
        write_card(replace(CARD, contact=contact), self.path)
        self.assertEqual(read_card(self.path).contact, contact)
        self.path.write_text(self.path.read_text().split("contact:")[0] + f"contact: {SOURCE}/inputs/materials/contact/sand.yaml\n")
        self.assertEqual(read_card(self.path).contact, contact)

    def test_written_card_is_read_back(self) -> None:
        self.assertEqual(read_card(self.path), CARD)
        self.assertEqual(set(CARD.parameters()), set(UNITS))

    def test_values_have_two_digits_of_the_error(self) -> None:
        self.assertEqual(CARD.texts()["c"], "150 ± 60")
        self.assertIn("| 150 ± 60 |", markdown([CARD]))
        self.assertEqual(CARD.texts()["phi"], "29.25 ± 0.5")

    def test_cone_index_states_depth_and_spread(self) -> None:
        assert isinstance(CARD.cone, Cone)
        spread = 8e5 * 0.15 / math.sqrt(12)  # of a straight line
        self.assertAlmostEqual(CARD.cone.spread, spread)
        self.assertIn("cone index: mean over 0 to 150 mm, spread over the depth 3.5e+04 Pa", CARD.report())
        self.assertNotIn("push the cone deeper", CARD.report())
        short = replace(CARD, cone=replace(CARD.cone, depth=Range(0.0, 0.04)))
        self.assertIn("formulas need the mean over 0 to 150 mm: push the cone deeper", short.report())

    def test_export_to_chrono_has_the_keys_of_chrono(self) -> None:
        target = self.folder / "scm.json"
        write_chrono(CARD, target)
        soil = json.loads(target.read_text())["Soil parameters"]
        self.assertEqual(soil["Bekker Kphi"], PLATE.k_phi.value)
        self.assertEqual(soil["Bekker Kc"], PLATE.k_c.value)
        self.assertEqual(soil["Bekker n exponent"], PLATE.n.value)
        self.assertEqual(soil["Mohr cohesive limit"], SHEAR.c.value)
        self.assertEqual(soil["Mohr friction limit"], SHEAR.phi.value)
        self.assertEqual(soil["Janosi shear coefficient"], SHEAR.K.value)
        self.assertGreater(soil["Elastic stiffness"], soil["Bekker Kphi"])

    def test_every_export_states_the_gravity_of_the_tests(self) -> None:
        card, target = replace(CARD, gravity=1.62), self.folder / "export"
        for _, write in EXPORTS.values():
            write(card, target)
            self.assertIn("holds in a gravity of 1.62 m/s2 only", target.read_text())
        self.assertIn("holds in a gravity of 1.62 m/s2 only", card.report())
        write_card(card, target)
        self.assertEqual(read_card(target).gravity, 1.62)

    def test_hand_written_card_has_plain_values_in_other_units(self) -> None:
        self.path.write_text(
            "gravity: 9.80665\npressure_sinkage: {k_c: 0, k_phi: {value: 3200, unit: kN/m^(n+2)}, n: 1.4}\n"
            "shear: {c: {value: 0.14, unit: kPa}, phi: 35, K: {value: 1, unit: cm}}\nc1: 0.43\nc2: 0.32\n",
            encoding="utf-8",
        )
        ground = terrain(str(self.path))
        self.assertEqual(
            [ground.k_1, ground.k_2, ground.n, ground.c, ground.phi, ground.K, ground.c1, ground.c2],
            [0.0, 3.2e6, 1.4, 140.0, 35.0, 0.01, 0.43, 0.32],
        )
        self.assertEqual(ground.assumed, ())
        text = self.path.read_text()
        for old, new, message in (
            ("c1:", "c_1:", "the card has the key 'c_1', which no program of Furrow uses"),
            ("phi: 35", "phi: 35, psi: 5", "shear has the key 'psi'"),
            ("unit: cm", "unit: furlong", "shear.K has the unit 'furlong'; allowed: 'm', 'cm', 'mm'"),
            ("n: 1.4", "m: 1.4", "pressure_sinkage has the key 'm'"),
        ):
            self.path.write_text(text.replace(old, new), encoding="utf-8")
            with self.assertRaisesRegex(ResultsError, re.escape(message)):
                read_card(self.path)

    def test_chrono_file_is_read_back_as_a_card(self) -> None:
        target = self.folder / "scm.json"
        write_chrono(CARD, target)
        target.write_text("// a comment of Chrono\n" + target.read_text(), encoding="utf-8")
        back = read_card(target)
        plate, shear = back.bekker_and_shear()
        self.assertEqual([plate.k_c.value, plate.k_phi.value, plate.n.value], [PLATE.k_c.value, PLATE.k_phi.value, PLATE.n.value])
        self.assertEqual([shear.c.value, shear.phi.value, shear.K.value], [SHEAR.c.value, SHEAR.phi.value, SHEAR.K.value])
        self.assertEqual(terrain(str(target)).assumed[0], "c1 0.18, that of Wong-Reece loose sand; give --c1")
        target.write_text('{"Soil parameters": {"Bekker Kc": 0}}', encoding="utf-8")
        with self.assertRaisesRegex(ResultsError, '"Soil parameters" have no "Bekker Kphi"'):
            read_card(target)

    def test_unusable_parameters_are_not_exported(self) -> None:
        small = replace(CARD, shear=replace(SHEAR, K=Fitted(4e-5, 9e-6)))
        target = self.folder / "export"
        for write in (write_chrono, write_altair):
            with self.assertRaisesRegex(ResultsError, "K is 0.04 mm, .*A shear ring on grains determines it"):
                write(small, target)
        self.assertFalse(target.exists())
        write_table(small, target)
        self.assertNotIn("K", [row["name"] for row in read_rows(target)])
        self.assertIn("# K left out: ", target.read_text())

    def test_negative_k_c_states_the_width_without_bearing_capacity(self) -> None:
        """k_c/b + k_phi is zero there."""

        def warnings(k_c: float) -> list[str]:
            return replace(CARD, pressure_sinkage=replace(PLATE, k_c=Fitted(k_c, 1.0))).warnings()

        self.assertEqual(warnings(1.0), [])
        (warning,) = warnings(-0.02 * PLATE.k_phi.value)
        self.assertIn("a contact of b = 0.02 m or less carries nothing", warning)

    def test_export_to_altair_has_the_angle_in_radians(self) -> None:
        target = self.folder / "road.rdf"
        write_altair(CARD, target)
        text = target.read_text()
        self.assertIn("ANGLE = 'radians'", text)
        found = {name: float(value) for name, value in re.findall(r"^(\w+) = ([-+.\de]+) \$", text, re.M)}
        plate, shear = PLATE, SHEAR
        for key, value in (
            ("KC", plate.k_c.value),
            ("KPHI", plate.k_phi.value),
            ("SINKAGE_EXPONENT", plate.n.value),
            ("C", shear.c.value),
            ("PHI", math.radians(shear.phi.value)),
            ("KX1", shear.K.value),
            ("SOIL_DENSITY", CARD.density),
        ):
            self.assertEqual(found[key], value, key)

    def test_table_has_every_parameter_with_error_and_unit(self) -> None:
        target = self.folder / "card.csv"
        write_table(CARD, target)
        rows = {row["name"]: row for row in read_rows(target)}
        for name, fitted in CARD.parameters().items():
            self.assertEqual(float(rows[name]["value"]), fitted.value)
            self.assertEqual(float(rows[name]["error"]), fitted.error)
            self.assertEqual(rows[name]["unit"], UNITS[name])

    def test_bekker_formula_reads_a_card_as_terrain(self) -> None:
        ground = terrain(str(self.path))
        plate, shear = PLATE, SHEAR
        found = (ground.k_1, ground.k_2, ground.n, ground.c, ground.phi, ground.K)
        card = (plate.k_c, plate.k_phi, plate.n, shear.c, shear.phi, shear.K)
        self.assertEqual(found, tuple(fitted.value for fitted in card))
        self.assertEqual((ground.c1, ground.c2), (0.18, 0.32))  # of loose sand
        # Bekker: W = b k sqrt(D) z^(n + 1/2) (3 - n)/3
        z = empirical.bekker(1000, 0.6, 0.2, ground).sinkage
        k, n = plate.k_c.value / 0.2 + plate.k_phi.value, plate.n.value
        self.assertAlmostEqual(0.2 * k * math.sqrt(0.6) * z ** (n + 0.5) * (3 - n) / 3000, 1, places=9)

    def test_failed_instrument_gives_a_reason_and_no_number(self) -> None:
        write_card(WITHOUT_RING, self.path)
        self.assertEqual(read_card(self.path), WITHOUT_RING)
        self.assertEqual(WITHOUT_RING.failures(), {"ring": "the ring sank through"})
        self.assertIn("ring: no result, the ring sank through", WITHOUT_RING.report())
        self.assertEqual(markdown([WITHOUT_RING]).splitlines()[-1].count("| none"), 3)
        target = self.folder / "card.csv"
        write_table(WITHOUT_RING, target)
        self.assertIn("# ring: no result, the ring sank through", target.read_text())
        self.assertEqual(
            {row["name"] for row in read_rows(target)}, {"k_c", "k_phi", "n", "index", "gradient"}
        )
        for write in (write_chrono, write_altair):
            with self.assertRaisesRegex(ResultsError, "no values of the ring .the ring sank through"):
                write(WITHOUT_RING, target)
        with self.assertRaisesRegex(ResultsError, "no values of the ring .the ring sank through"):
            terrain(str(self.path))

    def test_wrong_cards_are_refused_with_the_key(self) -> None:
        text = self.path.read_text()
        for change, message in (
            (("unit: degree", "unit: gon"), "shear.phi has the unit 'gon'; allowed: 'degree'"),
            (("value: 150.0", "value: .nan"), "shear.c is nan, a finite number is needed"),
            (("cone:", "kone:"), "has the key 'kone'"),
            (("gravity: 9.80665\n", ""), "has no 'gravity'"),
            (("gravity: 9.80665", "gravity: -1.62"), "gravity is -1.62; allowed: a number > 0 [m/s2]"),
            (("title:", "- title:"), "is no YAML"),
        ):
            self.assertIn(change[0], text)
            self.path.write_text(text.replace(*change), encoding="utf-8")
            with self.assertRaisesRegex(ResultsError, re.escape(message)):
                read_card(self.path)


if __name__ == "__main__":
    unittest.main()
