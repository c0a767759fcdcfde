# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/snow_wheel: the field snow of its runs and presets, and the identification of its beginning."""

import contextlib
import importlib.util
import io
import re
import unittest
from typing import Any

import numpy as np

from furrow_post.laws.compressed_snow import cam_clay_confined
from furrow_post.run.case import Case
from support.command import SOURCE
from support.evaluation import VALIDATION, cases, evaluation

# Not by its name: inputs/laboratory has an identify.py, too
specification = importlib.util.spec_from_file_location("snow_wheel_identify", VALIDATION / "snow_wheel" / "identify.py")
assert specification and specification.loader
program: Any = importlib.util.module_from_spec(specification)
specification.loader.exec_module(program)
field_snow = program.field_snow
study = evaluation("snow_wheel")
CRUSHED, RUT = 3.3, 1.4  # slopes M
TWO_STRESSES = study.STRESSES[1:3]


def number(text: str, key: str) -> float:
    """Number of a key in the text of a material file."""
    found = re.search(rf"\b{key}: *([-+.e\d]+)", text)
    assert found, key
    return float(found[1])


def column(text: str, key: str) -> list[float]:
    found = re.search(rf"\b{key}: *\[([^]]*)\]", text)
    assert found, key
    return [float(word) for word in found[1].split(",")]


class FieldSnowTest(unittest.TestCase):
    def test_strength_is_one_function_of_density(self) -> None:
        """For any initial density; from 525 kg/m3 on the final densities under wheels."""
        first, second = field_snow(110.0), field_snow(220.0)
        self.assertEqual((number(first, "density"), number(second, "density")), (110, 220))
        rho, p = column(first, "rho"), column(first, "p")
        self.assertEqual((rho, p), (column(second, "rho"), column(second, "p")))
        self.assertAlmostEqual(p[rho.index(525)] / (0.594 * 210e3), 1.0, places=5)
        self.assertTrue(np.all(np.diff(p) > 0))

    def test_presets_are_the_identified_ones(self) -> None:
        preset = (SOURCE / "inputs/materials/field_snow.yaml").read_text()
        found = field_snow(220.0)
        for key in ("rho", "p"):
            np.testing.assert_allclose(column(preset, key), column(found, key), rtol=1e-3)
        for key in ("M", "tension_ratio", "E", "nu"):
            self.assertEqual(number(preset, key), number(found, key), key)
        preset = (SOURCE / "inputs/materials/variants/field_snow_rut.yaml").read_text()
        found = field_snow(220.0, TWO_STRESSES, slope=RUT)
        for key in ("rho", "p"):
            self.assertEqual(column(preset, key), column(found, key))
        self.assertEqual(number(preset, "M"), number(found, "M"))

    def test_runs_use_the_field_snow_of_their_density_and_slope(self) -> None:
        """Their texts in study.yaml are those that field_snow() writes."""
        for name, case in cases("snow_wheel").items():
            text = case.files.get("material.yaml", "")
            if "cohesive_cam_clay" not in text:
                continue
            density, m = number(text, "density"), number(text, "M")
            beginning = TWO_STRESSES if case.stage in ("fine", "refit") else study.STRESSES[1:4]
            self.assertEqual(text, field_snow(density, beginning, f"field snow of {density:g} kg/m3", m), name)
            self.assertEqual(case.fallback, {} if name == "passes" else {"remap_interval": 8})

    def test_closed_form_pressure_equals_confined_compression(self) -> None:
        text = field_snow(220.0)
        rho, p = column(text, "rho"), column(text, "p")
        stress = study.field_stress(np.log(np.array(rho[1:]) / 220.0))
        np.testing.assert_allclose(stress, np.array(p[1:]) / cam_clay_confined(CRUSHED, 0.1)[1], rtol=1e-3)


class IdentifyTest(unittest.TestCase):
    def test_stresses_of_synthetic_runs_are_recovered(self) -> None:
        """Sinkage, resistance and density are straight in the logarithms of the three stresses."""
        share = cam_clay_confined(CRUSHED, 0.1)[1]
        wanted = np.log([5e3, 20e3, 90e3])

        def make(case: Case) -> dict[str, float]:
            apart = np.log(np.array(column(case.files["material.yaml"], "p")[1:4]) / share) - wanted
            sinkage = 0.1583 + 0.8 * (float(str(case.variables["depth"])) - 0.2) + 0.02 * apart[0] + 0.01 * apart[1]
            resistance = 0.0717 + 0.03 * apart[1] - 0.02 * apart[0]
            return {"sinkage_m": sinkage, "resistance": resistance, "density_under": 510.0 + 60.0 * apart[2]}

        with contextlib.redirect_stdout(io.StringIO()):
            trials = program.identify(study.STRESSES[1:4], make, 8)
        best = min(trials, key=lambda trial: float(trial["sum_of_squares"]))
        for name, stress in zip(program.SEARCHED, (5e3, 20e3, 90e3)):
            self.assertAlmostEqual(best[name] / stress, 1.0, delta=0.15, msg=name)


if __name__ == "__main__":
    unittest.main()
