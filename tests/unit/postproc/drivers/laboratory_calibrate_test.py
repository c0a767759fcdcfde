# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/laboratory/calibrate.py finds the parameters of a made ground from two tests at once, and
says which one they do not determine."""

import contextlib
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

from support.command import SOURCE
from support.laboratory import cell_rows, triaxial_stress, write_test

sys.path.insert(0, str(SOURCE / "inputs" / "laboratory"))

import calibrate
from task import read_task

INITIAL = 200.0  # kg/m3
CRUSH, TENSILE = 2e3, 0.5  # true values; shear_strength has no influence

TASK: dict[str, Any] = {
    "ground": "snow_bonded",
    "variables": {"grains": 100},
    "parameters": {
        "crush_strength": [1.6e3, 1e2, 1e5],
        "tensile_strength": [0.7, 0.1, 10],
        "shear_strength": [0.7, 0.1, 10],
    },
    "seeds": [86028121],
    "tests": [
        {
            "test": "oedometer",
            "variables": {"stress": 1.1e6},
            "reference": "reference.csv",
            "lowest": 1e3,
            "highest": 1e6,
            "deviation": 0.1,
        },
        {"test": "tension", "quantities": {"tensile_strength": [CRUSH * TENSILE, 200]}},
    ],
    "iterations": 8,
}


def axial(crush: float, strain: Any) -> Any:
    return crush * np.exp(5 * strain)


def made_run(case: Any, folder: Path, _: object) -> mock.Mock:
    """In the place of a run: curves in closed form."""
    values = {name: float(text) for name, text in case.variables.items() if name in TASK["parameters"]}
    crush, tensile = values["crush_strength"], values["tensile_strength"]
    if folder.name.endswith("1"):
        strain = np.linspace(0, 1.2, 400)
        stress = triaxial_stress(0.0, axial(crush, strain))
    else:
        strain = -np.linspace(0, 0.02, 400)
        stress = triaxial_stress(0.0, -crush * tensile * np.minimum(-strain / 0.01, 1.0))
    cell = np.column_stack((0 * strain, 0 * strain, strain))
    test = "oedometer" if folder.name.endswith("1") else "tension"
    write_test(folder, f"test {test} ground made", cell_rows(cell, stress, INITIAL * np.exp(strain)))
    return mock.Mock(error="")


class CalibrateTest(unittest.TestCase):
    def test_two_tests_at_once(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            strain = np.array([0.4, 0.8])
            rows = zip(axial(CRUSH, strain), INITIAL * np.exp(strain))
            text = "sigma1_Pa,rho_kgm3\n" + "".join(f"{s:.6g},{r:.8g}\n" for s, r in rows)
            (folder / "reference.csv").write_text(text)
            task = json.loads(json.dumps(TASK))
            task["tests"][0]["reference"] = str(folder / "reference.csv")
            (folder / "task.json").write_text(json.dumps(task))
            with mock.patch.object(calibrate, "launch", made_run):
                with contextlib.redirect_stdout(io.StringIO()):
                    runs = calibrate.Runs(read_task(folder / "task.json"), folder, 99, mock.Mock())
                    result = calibrate.calibrate(runs.task, runs)
        found = result["parameters"]
        self.assertAlmostEqual(found["crush_strength"]["value"] / CRUSH, 1.0, delta=0.08)
        self.assertAlmostEqual(found["tensile_strength"]["value"] / TENSILE, 1.0, delta=0.08)
        names = [f"oedometer at {INITIAL * np.exp(e):g} kg/m3" for e in strain]
        self.assertEqual(result["targets"], [*names, "tension tensile_strength"])
        # ln(stress) over 0.1: a tenth more strength is one deviation
        np.testing.assert_allclose(result["sensitivity"]["crush_strength"][:2], 10.0, rtol=1e-2)
        undetermined = " ".join(result["not_determined"])
        self.assertIn("shear_strength^", undetermined)
        self.assertIn("shear_strength is known no better than a factor of e", undetermined)
        self.assertNotIn("tensile_strength is known", undetermined)


if __name__ == "__main__":
    unittest.main()
