# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas by cone index against published and hand-computed values; their refusals."""

import math
import unittest
from dataclasses import replace
from pathlib import Path

from furrow_post.laws.cone_formulas import (
    PSI,
    ConeFormula,
    Tyre,
    WheeledVehicle,
    brixius,
    drove_sand,
    formulas_for,
    gee_clough,
    maclaurin,
    vehicle_cone_index,
    vti_clay,
    weight_factor,
    wismer_luth,
)
from furrow_post.laws.prediction import OutOfRange
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from support.command import run_post

TYRE = Tyre(load=20e3, diameter=1.6, width=0.5, section_height=0.4, deflection=0.08)
CI = 600e3  # [Pa], which makes the clay number 24


class TractionTest(unittest.TestCase):
    def test_gee_clough_has_the_published_values_of_a_farm_tyre(self) -> None:
        # A 9.5 x 24 drive tyre in "bad conditions" of a textbook's table
        tyre = Tyre(7e3, 1.04, 0.24, 0.2, 0.04)
        at_all = gee_clough(200e3, tyre, 1.0)
        self.assertAlmostEqual(at_all.net, 0.47, delta=0.005)
        self.assertAlmostEqual(at_all.resistance, 0.15, delta=0.005)
        self.assertAlmostEqual(gee_clough(200e3, tyre, 1e-6).net / 1e-6, 5.01, delta=0.005)

    def test_wismer_luth_has_hand_computed_values(self) -> None:
        found = wismer_luth(CI, TYRE, 0.2)
        self.assertAlmostEqual(found.numeric, 24, places=12)
        self.assertAlmostEqual(found.resistance, 0.09, places=12)
        self.assertAlmostEqual(found.gross, 0.572305, delta=1e-6)
        self.assertAlmostEqual(found.net, 0.482305, delta=1e-6)

    def test_brixius_has_hand_computed_values(self) -> None:
        # by pocket calculator: the exponential terms and the root of the mobility number
        found = brixius(CI, TYRE, 0.2)
        self.assertAlmostEqual(found.numeric, 24.774194, delta=1e-6)
        self.assertAlmostEqual(found.gross, 0.88 * 0.91604085 * 0.77686984 + 0.04, delta=1e-6)
        self.assertAlmostEqual(found.resistance, 0.040364582 + 0.04 + 0.1 / 4.9773682, delta=1e-6)
        radial = brixius(CI, replace(TYRE, radial=True), 0.2)
        self.assertAlmostEqual(radial.gross, 0.88 * 0.91604085 * 0.85043138 + 0.0325, delta=1e-6)

    def test_vehicle_terrain_interface_on_clay_has_hand_computed_values(self) -> None:
        number = 24 / (0.71554175 * 1.2262375)
        found = vti_clay(CI, TYRE, 0.2)
        self.assertAlmostEqual(found.numeric / number, 1, places=6)
        self.assertAlmostEqual(found.resistance, 5.07 / number**1.71 + 0.011, places=6)
        free = 21 / number**2.5 + 0.005
        just = vti_clay(CI, TYRE, free)
        self.assertAlmostEqual(just.gross, 12 / number**2 + 0.007, places=6)
        # by its meaning the tyre has hardly any pull at the self-propelled slip
        self.assertLess(abs(just.net), 0.01)
        self.assertAlmostEqual(found.gross - just.gross, 0.5 * math.log10(0.2 / free) * 1.3125**0.25, places=6)

    def test_formulas_agree_in_tendency(self) -> None:
        formulas: dict[str, ConeFormula] = {
            "Wismer-Luth": wismer_luth,
            "Brixius": brixius,
            "Gee-Clough": gee_clough,
            "VTI": vti_clay,
        }
        for name, formula in formulas.items():
            soft, firm = formula(CI, TYRE, 0.2), formula(2 * CI, TYRE, 0.2)
            self.assertGreater(firm.net, soft.net, name)
            self.assertLess(firm.resistance, soft.resistance, name)
            self.assertGreater(formula(CI, TYRE, 0.3).net, soft.net, name)

    def test_values_agree_with_a_second_program(self) -> None:
        formulas: dict[str, ConeFormula] = {
            "drove_sand": drove_sand,
            "vti_clay": vti_clay,
            "maclaurin": maclaurin,
            "gee_clough": gee_clough,
            "brixius": brixius,
            "wismer_luth": wismer_luth,
        }
        compared = 0
        for row in read_rows(Path(__file__).with_name("cone_formulas_reference.csv")):
            sizes = (1e3 * float(row["load"]), *(float(row[k]) for k in ("diameter", "width", "section_height", "deflection")))
            found = formulas[row["formula"]](1e3 * float(row["cone_index"]), Tyre(*sizes), float(row["slip"]), extrapolate=True)
            for name in ("gross", "resistance", "net", "towed_resistance", "sinkage", "towed_sinkage"):
                if not row[name]:
                    continue
                unit, printed = (1e3, 0.51) if "sinkage" in name else (1, 0.0011)
                self.assertAlmostEqual(unit * getattr(found, name), max(float(row[name]), 0) if unit > 1 else float(row[name]), delta=printed, msg=f"{row}: {name}")
                compared += 1
        self.assertGreater(compared, 200)

    def test_band_covers_the_formulas_in_their_range(self) -> None:
        passenger = Tyre(6e3, 0.734, 0.235, 0.176, 0.025)
        clay = formulas_for("clay", 300e3, passenger, 0.2)
        self.assertEqual(len(clay.answers), 5)
        mean, least, greatest = clay.band("net") or (0, 0, 0)
        self.assertAlmostEqual(least, 0.124, delta=0.001)
        self.assertAlmostEqual(greatest, 0.413, delta=0.001)
        self.assertAlmostEqual(mean, (0.198 + 0.413 + 0.192 + 0.124 + 0.138) / 5, delta=0.001)
        # Wismer-Luth and Maclaurin are out of their ranges on a wide tyre on soft clay
        wide = formulas_for("clay", 100e3, Tyre(6e3, 0.6, 0.3, 0.15, 0.025), 0.2)
        outside = [answer.method for answer in wide.answers if answer.outside]
        self.assertIn("Wismer-Luth", outside)
        self.assertIn("Maclaurin", outside)
        self.assertIn("! Wismer-Luth: EXTRAPOLATED: width over diameter 0.5, allowed 0.2 to 0.4", wide.report())
        self.assertIn("has no traction", wide.report())
        self.assertNotAlmostEqual((wide.band("net") or (0,))[0], sum(a.net for a in wide.answers) / len(wide.answers), places=2)
        # Maclaurin has a pull at one slip only, and is from memory
        self.assertTrue(math.isnan(formulas_for("clay", 300e3, passenger, 0.3).answers[-1].net))
        self.assertIn("* Maclaurin: traction and resistance from memory", clay.report())

    def test_sand_has_no_largest_traction_on_firm_ground(self) -> None:
        soft = Tyre(2e3, 0.71, 0.22, 0.157, 0.039)
        with self.assertRaisesRegex(OutOfRange, "contact pressure over cone index 0.0197, allowed 0.03 to 1"):
            drove_sand(1000e3, soft, 0.2)
        with self.assertRaisesRegex(ResultsError, "DROVE, sand: has no value here: contact pressure"):
            formulas_for("sand", 1500e3, soft, 0.2)

    def test_faults_are_refused(self) -> None:
        with self.assertRaisesRegex(OutOfRange, "width over diameter 0.625, allowed 0.2 to 0.4"):
            wismer_luth(CI, Tyre(20e3, 0.8, 0.5), 0.2)
        with self.assertRaisesRegex(OutOfRange, "load over width and diameter 1.25e.05 Pa, allowed 15000 to"):
            brixius(CI, Tyre(100e3, 1.6, 0.5, 0.4, 0.08), 0.2)
        with self.assertRaisesRegex(ResultsError, "section_height is nan"):
            brixius(CI, Tyre(20e3, 1.6, 0.5), 0.2)
        with self.assertRaisesRegex(ResultsError, "deflection is 0.5 m, and the section height 0.4 m"):
            gee_clough(CI, Tyre(20e3, 1.6, 0.5, 0.4, 0.5), 0.2)
        with self.assertRaisesRegex(ResultsError, "has no traction"):
            gee_clough(30e3, TYRE, 0.2)
        with self.assertRaisesRegex(OutOfRange, "does not propel itself"):
            vti_clay(CI, TYRE, 0.001)


class VehicleConeIndexTest(unittest.TestCase):
    """By hand, in pounds and inches: a heavy truck of four axles."""

    LB, IN, HP = 4.4482216152605, 0.0254, 745.69987

    def vehicle(self, deflection: float = math.nan, power: float = 400, manual: bool = False) -> WheeledVehicle:
        tyre = Tyre(math.nan, 48 * self.IN, 16 * self.IN, 12 * self.IN, deflection * 12 * self.IN)
        return WheeledVehicle(40e3 * self.LB, 4, 8, tyre, 18 * self.IN, power * self.HP, manual)

    def test_mobility_index_and_one_pass_have_published_values(self) -> None:
        found = vehicle_cone_index(self.vehicle())
        index = 40000 / (16 * 24 * 8) * 1.38 / 0.26 + 5 - 1.8
        self.assertAlmostEqual(found.mobility_index, index, places=6)
        self.assertAlmostEqual(index, 72.3106, delta=1e-4)
        psi = 11.48 + 0.2 * index - 39.2 / (index + 3.74)
        self.assertAlmostEqual(found.one_pass / PSI, psi, places=6)
        self.assertAlmostEqual(psi, 25.4267, delta=1e-4)

    def test_factors_of_deflection_engine_and_transmission_are_published_ones(self) -> None:
        plain = vehicle_cone_index(self.vehicle())
        soft = vehicle_cone_index(self.vehicle(deflection=0.3))
        self.assertAlmostEqual(soft.one_pass / plain.one_pass, 0.5**0.25, places=9)
        weak = vehicle_cone_index(self.vehicle(power=150, manual=True))
        self.assertAlmostEqual(weak.mobility_index / plain.mobility_index, 1.05**2, places=9)

    def test_weight_factor_is_nearly_continuous(self) -> None:
        for kips in (2.0, 13.5, 20.0):
            below, above = weight_factor(kips), weight_factor(kips + 1e-9)
            self.assertAlmostEqual(below / above, 1, delta=0.011)


class CommandTest(unittest.TestCase):
    def test_options_of_a_formula_are_listed(self) -> None:
        words = "--load 20e3 --diameter 1.6 --width 0.5 --slip 0.2 --cone_index 600e3".split()
        found = run_post("empirical", "wismer_luth", *words)
        self.assertIn("net traction coefficient    0.4823", found.stdout)
        self.assertIn("empirical brixius needs --section_height, --deflection", run_post("empirical", "brixius", *words).stderr)
        wrong = run_post("empirical", "wismer_luth", *words, "--radial")
        self.assertIn("empirical wismer_luth does not read --radial", wrong.stderr)
        inner = [*words, "--section_height", "0.4", "--deflection", "0.08"]
        table = run_post("empirical", "by_cone_index", "--soil", "clay", *inner).stdout
        self.assertRegex(table, r"Wismer-Luth +0\.572 +0\.090 +0\.482")
        self.assertRegex(table, r"mean +0\.\d+ +0\.\d+ +0\.\d+ +\d+")
        self.assertIn("by_cone_index needs --soil", run_post("empirical", "by_cone_index", *inner).stderr)
        vehicle = "--weight 178e3 --axles 4 --tyres 8 --diameter 1.22 --width 0.41 --clearance 0.46 --power 3e5"
        self.assertRegex(run_post("empirical", "vci", *vehicle.split()).stdout, r"VCI of one pass +2\d\.\d\d psi")


if __name__ == "__main__":
    unittest.main()
