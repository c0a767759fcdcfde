# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/snow_wheel: the field snow, accuracy, size zero."""

import contextlib
import importlib.util
import io
import math
import re
import unittest
from pathlib import Path
from typing import Any

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.run.case import Case
from furrow_post.run.tools import Tools
from furrow_post.run.executor import Executor
from furrow_post.study.runs import Runs
from support.command import SOURCE
from support.evaluation import VALIDATION, cases, evaluation

study = evaluation("snow_wheel")
SLOPES = (study.SOFTEST, study.FLOWING, study.CRUSHED)


def number(text: str, key: str) -> float:
    """Of a material file's text."""
    found = re.search(rf"\b{key}: *([-+.e\d]+)", text)
    assert found, key
    return float(found[1])


def column(text: str, key: str) -> list[float]:
    found = re.search(rf"\b{key}: *\[([^]]*)\]", text)
    assert found, key
    return [float(word) for word in found[1].split(",")]


class FieldSnowTest(unittest.TestCase):
    def test_strength_is_one_function_of_density(self) -> None:
        """Whatever the initial density; from 525 kg/m3 on the final densities under wheels."""
        first, second = study.field_snow(110.0), study.field_snow(220.0)
        self.assertEqual((number(first, "density"), number(second, "density")), (110, 220))
        rho, p = column(first, "rho"), column(first, "p")
        self.assertEqual((rho, p), (column(second, "rho"), column(second, "p")))
        self.assertAlmostEqual(p[rho.index(525)] / (0.594 * 210e3), 1.0, places=5)
        self.assertTrue(np.all(np.diff(p) > 0))

    def test_the_preset_is_what_was_identified(self) -> None:
        preset = (SOURCE / "inputs/materials/field_snow.yaml").read_text()
        found = study.field_snow(220.0)
        for key in ("rho", "p"):
            np.testing.assert_allclose(column(preset, key), column(found, key), rtol=1e-3)
        for key in ("M", "tension_ratio", "E", "nu"):
            self.assertEqual(number(preset, key), number(found, key), key)

    def test_the_preset_of_the_rut_reading_is_the_snow_of_its_runs(self) -> None:
        preset = (SOURCE / "inputs/materials/variants/field_snow_rut.yaml").read_text()
        found = study.field_snow(220.0, study.TWO_STRESSES, slope=study.FINE)
        for key in ("rho", "p"):
            self.assertEqual(column(preset, key), column(found, key))
        self.assertEqual(number(preset, "M"), number(found, "M"))

    def test_runs_have_the_field_snow_of_their_density_and_slope(self) -> None:
        """Their texts in study.yaml are those that field_snow() writes."""
        for name, case in cases("snow_wheel").items():
            text = case.files.get("material.yaml", "")
            if "cohesive_cam_clay" not in text:
                continue
            density, m = number(text, "density"), number(text, "M")
            beginning = study.TWO_STRESSES if case.stage in ("spreading", "fine") else study.FIELD_SNOW
            title = f"field snow of {density:g} kg/m3"
            self.assertEqual(text, study.field_snow(density, beginning, title, m), name)
            self.assertEqual(case.fallback, {} if name == "passes" else {"remap_interval": 8})

class SlopeTest(unittest.TestCase):
    def test_k0_and_strength_are_those_of_confined_compression(self) -> None:
        """K0 as src/material/snow.md has it; p and q under an axial stress of 1 on the ellipse."""
        beta = study.TENSION_RATIO
        for slope, k0 in ((study.CRUSHED, 0.12), (study.FLOWING, 0.41), (1.5, 0.57)):
            found, p0 = study.confined(slope)
            self.assertAlmostEqual(found, k0, delta=0.005)
            p, q = (1 + 2 * found) / 3, 1 - found
            on_ellipse = q * q * (1 + 2 * beta) / slope**2
            self.assertAlmostEqual((p + beta * p0) * (p0 - p), on_ellipse, delta=1e-3)

    def test_flowing_snow_differs_in_that_alone(self) -> None:
        first, second = (study.field_snow(220.0, slope=m) for m in (study.CRUSHED, study.FLOWING))
        self.assertEqual(number(second, "M"), 2.0)
        self.assertEqual(column(first, "rho"), column(second, "rho"))
        axial = [
            np.array(column(text, "p")[1:]) / study.confined(slope)[1]
            for text, slope in ((first, study.CRUSHED), (second, study.FLOWING))
        ]
        np.testing.assert_allclose(axial[0], axial[1], rtol=1e-5)


class IdentifiedSlopeTest(unittest.TestCase):
    """Runs and tests in which quantities are parabolas in 1/M^2 and straight in the depth."""

    depths = (0.18, 0.22, 0.38)  # [m]

    @staticmethod
    def sinkage(m: float, depth: float) -> float:
        return 0.7 * depth + 0.1 * m**-2 + 0.02 * m**-4

    def computed(self) -> Any:
        z = np.array([[self.sinkage(m, h) for h in self.depths] for m in SLOPES])
        values = {"sinkage_m": z, "resistance": 0.1 + z, "density_under": 510.0 + 0 * z}
        return study.Computed(SLOPES, self.depths, values)

    def readings(self) -> list[Any]:
        models = {study.FLOWING: "flowing", study.CRUSHED: "tyre"}
        shallow = self.computed()._replace(depths=(0.18, 0.20, 0.22))
        return [
            study.Reading("hub", self.computed(), models, "sinkage_m"),
            study.Reading("rut", shallow, {study.FLOWING: "flowing"}, "rut_depth_m"),
        ]

    def rows(self, m: float, scatter: float = 0.0) -> list[dict[str, float]]:
        return [
            {"depth_m": depth, "sinkage_m": z, "resistance": 0.1 + z}
            for depth in (0.18, 0.20, 0.30)
            for sign in (-1, 1)
            for z in (self.sinkage(m, depth) + sign * scatter,)
        ]

    def test_the_slope_of_the_tests_is_found(self) -> None:
        found = study.identify(self.rows(2.4), self.computed())
        self.assertAlmostEqual(found.slope, 2.4, delta=0.001)
        self.assertAlmostEqual(found.left["sinkage_m"], 0.0, places=4)

    def test_scatter_widens_the_range_as_the_standard_error_does(self) -> None:
        """Of z alone: its error over dz/dM, from N = 6 tests; here z and c say the same, and the
        density is a thirteenth term, without scatter."""
        for scatter in (0.002, 0.003):
            found = study.identify(self.rows(2.4, scatter), self.computed())
            expected = scatter / math.sqrt(12) / (0.2 * 2.4**-3 + 0.08 * 2.4**-5)
            self.assertAlmostEqual(found.slope, 2.4, delta=0.01)
            self.assertAlmostEqual((found.high - found.low) / (2 * expected), 1.0, delta=0.05)

    def test_a_slope_beyond_the_runs_is_a_bound(self) -> None:
        found = study.identify(self.rows(4.0), self.computed())
        self.assertEqual((found.slope, found.high), (study.CRUSHED, study.CRUSHED))
        self.assertLess(found.low, study.CRUSHED)

    def test_both_choices_of_rows_predict_the_others(self) -> None:
        """Shallow tests say M = 2.6, deep ones 2.2: the choice with both lies between."""
        measured = [
            {
                "depth_m": depth,
                "density_kgm3": density,
                "sinkage_m": self.sinkage(m, depth),
                "resistance": 0.1 + self.sinkage(m, depth),
                **{
                    f"{model}_{what}": self.sinkage(s, depth) + plus
                    for model, s in (("flowing", study.FLOWING), ("tyre", study.CRUSHED))
                    for what, plus in (("sinkage_m", 0.0), ("rut_depth_m", 0.0), ("resistance", 0.1))
                },
            }
            for depth, density, m in (
                (0.2, 220, 2.6),
                (0.22, 220, 2.6),
                (0.38, 220, 2.2),
                (0.2, 110, 2.2),
            )
        ]
        lines = study.slope_lines(measured, self.readings())
        self.assertEqual(len(lines), 5)  # the ruts' runs do not reach 0.38 m
        (_, shallow, both), rut = lines[:3], lines[4]
        self.assertEqual((shallow["reading"], rut["reading"]), ("hub", "rut"))
        self.assertEqual(rut["others_slope"], study.FLOWING)
        self.assertEqual(shallow["slope"], 2.6)
        self.assertTrue(2.2 < both["slope"] < 2.6)
        self.assertLess(both["others_sinkage_m_rms"], shallow["others_sinkage_m_rms"])
        self.assertEqual(shallow["k0"], round(study.confined(2.6)[0], 2))


class MassBalanceTest(unittest.TestCase):
    def rows(self, density_left: float, deflection: float) -> list[dict[str, float]]:
        """Sinkages of snow that is all left at one density."""
        return [
            {
                "depth_m": depth,
                "density_kgm3": density,
                "sinkage_m": depth * (1 - density / density_left) + deflection,
            }
            for depth, density in ((0.13, 110.0), (0.2, 220.0), (0.38, 160.0))
        ]

    def test_rows_that_keep_mass_leave_no_error(self) -> None:
        rows = self.rows(510.0, 0.03)
        np.testing.assert_allclose(study.least_error(rows, 510.0, 1.0), 0.0, atol=1e-12)

    def test_other_rows_leave_what_no_deflection_takes_away(self) -> None:
        rows = self.rows(510.0, 0.065)  # 2 cm more than the largest deflection
        single, own = study.least_error(rows, 510.0, 1.0)
        self.assertAlmostEqual(own, 0.02)
        self.assertAlmostEqual(single, 0.02)
        rows = self.rows(1020.0, 0.03)  # twice as dense as it is said to be
        single, own = study.least_error(rows, 510.0, 1.0)
        self.assertGreater(single, own)
        self.assertGreater(own, 0.01)


class RigidWheelTest(unittest.TestCase):
    """The integrals along the rim."""

    def test_steep_pressure_gives_the_page_s_formula(self) -> None:
        """p = p_m exp(-(z_m - z)/lambda): W = b p_m sqrt(pi r lambda/2), c by the page."""
        depth, density, radius, width, length = 0.2, 220.0, 0.37, 0.272, 5e-4
        sinkage, greatest = 0.12, 1e6
        load = width * greatest * math.sqrt(0.5 * math.pi * radius * length)

        def stress(rho: Floats) -> Floats:
            z = depth * (1 - density / rho)
            return np.asarray(greatest * np.exp((z - sinkage) / length))

        found = study.compacted(2 * radius, width, depth, density, load, stress)
        self.assertAlmostEqual(found.sinkage, sinkage, delta=1e-5)
        expected = math.sqrt(2 * length / (math.pi * radius))
        self.assertAlmostEqual(found.resistance / expected, 1.0, delta=0.01)

    def test_pressure_is_the_material_s_in_confined_compression(self) -> None:
        text = study.field_snow(220.0)
        rho, p = column(text, "rho"), column(text, "p")
        stress = study.axial_stress(np.array(rho[1:]))
        _, share = study.confined(study.CRUSHED)
        np.testing.assert_allclose(stress, np.array(p[1:]) / share, rtol=1e-5)


class IdentifyTest(unittest.TestCase):
    def test_the_stresses_of_made_up_runs_are_found(self) -> None:
        """Sinkage, resistance and density are straight in the logarithms of the three stresses."""
        file = VALIDATION / "snow_wheel" / "identify.py"
        spec = importlib.util.spec_from_file_location("identify_field_snow", file)
        assert spec and spec.loader
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        _, share = study.confined(study.CRUSHED)
        wanted = np.log([5e3, 20e3, 90e3])

        def make(case: Case) -> dict[str, object]:
            p = np.array(column(case.files["material.yaml"], "p")[1:4]) / share
            off = np.log(p) - wanted
            depth = float(str(case.variables["depth"]))
            sinkage = 0.1583 + 0.8 * (depth - 0.2) + 0.02 * off[0] + 0.01 * off[1]
            return {
                "failure": "",
                "run": case.name,
                "sinkage_m": sinkage,
                "resistance": 0.0717 + 0.03 * off[1] - 0.02 * off[0],
                "density_under": 510.0 + 60.0 * off[2],
            }

        with contextlib.redirect_stdout(io.StringIO()):
            best = module.Search(module.START, make).run(8)
        for name, stress in zip(module.SEARCHED, (5e3, 20e3, 90e3)):
            self.assertAlmostEqual(best[name] / stress, 1.0, delta=0.15, msg=name)


class CellsTest(unittest.TestCase):
    """The grid's loss is a tenth of the resistance."""

    def run_row(self, rut: float, resistance: float) -> dict[str, Any]:
        names = {**dict.fromkeys(study.CELL_COLUMNS, 1.0), "rut_depth_m": rut}
        return {**names, "resistance": resistance, "numerical": 0.1 * resistance, "failure": ""}

    def test_the_loss_is_a_share_of_the_resistance(self) -> None:
        name, (coarse, _, fine, _) = next(
            (name, runs) for name, runs in study.CELL_SERIES.items() if len(runs) == 4
        )
        known = {coarse: self.run_row(0.15, 0.08), fine: self.run_row(0.165, 0.06)}
        first, second = study.cell_table(dict.fromkeys(known, 0.05), known)
        self.assertEqual((first["loss_share"], second["without_loss"]), (0.1, 0.054))
        self.assertEqual(first["case"], f"{name}, 5 cm")

    def test_the_loss_is_subtracted_row_by_row(self) -> None:
        row: dict[str, Any] = {"used": "prediction", "depth_m": 0.2, "density_kgm3": 220}
        row |= {"resistance": 0.06, "spreading_resistance": 0.08, "fine_resistance": ""}
        found = {"m_1.1_220_20cm": self.run_row(0.15, 0.08)}
        prediction, everything = study.numerical_table([row], lambda name: found[name])
        self.assertEqual(prediction["case"], "M = 1.1, prediction: 1")
        self.assertEqual((prediction["resistance_rms"], prediction["without_loss_mean"]), (0.02, 0.012))
        self.assertEqual((everything["least_loss_share"], everything["greatest_loss_share"]), (0.1, 0.1))


class StoredTest(unittest.TestCase):
    def runs(self) -> Runs:
        """None was made."""
        return Runs([], Executor(Path("none"), Tools.of(SOURCE / "inputs", SOURCE / "build")))

    def test_a_stored_row_stands_for_a_run_that_is_not_there(self) -> None:
        stored = {"run": "a", "what": "5", "failure": "", "resistance": "0.07", "slip": ""}
        found = study.Found(self.runs(), [stored])
        self.assertEqual(found("a"), {**stored, "resistance": 0.07})
        self.assertEqual(found("b"), {})


class AccuracyTest(unittest.TestCase):
    def test_rms_and_mean_over_the_rows_that_were_run(self) -> None:
        table = [
            {
                "used": "prediction",
                "sinkage_m": 0.1,
                "resistance": 0.1,
                "tyre_sinkage_m": 0.13,
                "tyre_rut_depth_m": 0.1,
                "tyre_resistance": 0.1,
            },
            {
                "used": "prediction",
                "sinkage_m": 0.1,
                "resistance": 0.1,
                "tyre_sinkage_m": 0.06,
                "tyre_rut_depth_m": 0.04,
                "tyre_resistance": 0.2,
            },
            {
                "used": "prediction",
                "sinkage_m": 0.1,
                "resistance": 0.1,
                "tyre_sinkage_m": "",
                "tyre_rut_depth_m": "",
                "tyre_resistance": "",
            },
        ]
        found = study.accuracy(table, "prediction", "tyre")
        self.assertEqual(found["rows"], "prediction: 2")
        self.assertAlmostEqual(found["sinkage_m_rms"], math.sqrt((9 + 16) / 2) / 100, places=4)
        self.assertAlmostEqual(found["sinkage_m_mean"], -0.005)
        self.assertAlmostEqual(found["resistance_mean"], 0.05)
        self.assertAlmostEqual(found["rut_m_mean"], -0.03)
        self.assertTrue(math.isnan(study.accuracy(table, "calibration", "tyre")["sinkage_m_rms"]))

if __name__ == "__main__":
    unittest.main()
