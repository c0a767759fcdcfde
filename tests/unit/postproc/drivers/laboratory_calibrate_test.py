# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/laboratory/calibrate.py finds the parameters of a made ground from two tests at once, also
where every packing scatters, and names the one that they do not determine, and whether it has ended."""

import contextlib
import io
import json
import sys
import tempfile
import unittest
import zlib
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np

from support.command import SOURCE
from support.laboratory import axisymmetric, write_cell

sys.path.insert(0, str(SOURCE / "inputs" / "laboratory"))

import calibrate
from task import read_task

INITIAL = 200.0  # kg/m3
CRUSH, TENSILE = 2e3, 0.5  # true values; shear_strength has no influence

TASK: dict[str, Any] = {
    "ground": "snow_bonded",
    "variables": {"grains": 100},
    "parameters": {
        "crush_strength": [1.6e3, 1e2, 1e5], "tensile_strength": [0.7, 0.1, 10], "shear_strength": [0.7, 0.1, 10],
    },
    "seeds": [86028121],
    "tests": [
        {
            "test": "oedometer", "variables": {"stress": 1.1e6}, "reference": "reference.csv",
            "lowest": 1e3, "highest": 1e6, "deviation": 0.1,
        },
        {"test": "tension", "quantities": {"tensile_strength": [CRUSH * TENSILE, 200]}},
    ],
    "iterations": 8,
}


def axial(crush: float, strain: Any) -> Any:
    return crush * np.exp(5 * strain)


def scatter_of(values: dict[str, float], seed: str) -> float:
    """A strength over its mean, of one run: 5 %, and another one for each set of parameters."""
    digits = zlib.crc32(f"{values} {seed}".encode())
    return float(np.exp(0.05 * np.random.default_rng(digits).standard_normal()))


def make_run(case: Any, folder: Path, scatters: bool) -> None:
    """Stands for a run: curves in closed form."""
    values = {name: float(case.variables[name]) for name in TASK["parameters"]}
    crush, tensile = values["crush_strength"], values["tensile_strength"]
    crush *= scatter_of(values, case.variables["seed"]) if scatters else 1.0
    if folder.name.endswith("1"):
        test, strain = "oedometer", np.linspace(0, 1.2, 400)
        stress = axial(crush, strain)
    else:
        test, strain = "tension", -np.linspace(0, 0.02, 400)
        stress = -crush * tensile * np.minimum(-strain / 0.01, 1.0)
    write_cell(folder, test, axisymmetric(0, strain), axisymmetric(0, stress), INITIAL * np.exp(strain))


class Made:
    """Stands for the Executor."""

    scatters = False

    def __init__(self, results: Path, *_: object, **__: object) -> None:
        self.results = results

    def missing(self, cases: list[Any]) -> list[Any]:
        return [case for case in cases if not (self.results / case.name).is_dir()]

    def completed(self, cases: list[Any]) -> list[mock.Mock]:
        folders = [self.results / case.name for case in cases]
        for case, folder in zip(cases, folders):
            make_run(case, folder, self.scatters)
        return [mock.Mock(folder=folder) for folder in folders]


class Scattering(Made):
    """Stands for the Executor of runs that scatter."""

    scatters = True


STRAINS = np.array([0.4, 0.8])  # of the reference


def calibrated(changes: dict[str, Any], executor: type[Made] = Made) -> dict[str, Any]:
    """The result of TASK with these changes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = zip(axial(CRUSH, STRAINS), INITIAL * np.exp(STRAINS))
        text = "sigma1_Pa,rho_kgm3\n" + "".join(f"{s:.6g},{r:.8g}\n" for s, r in rows)
        (folder / "reference.csv").write_text(text)
        task = {**json.loads(json.dumps(TASK)), **changes}
        task["tests"][0]["reference"] = str(folder / "reference.csv")
        (folder / "task.json").write_text(json.dumps(task))
        with mock.patch.object(calibrate, "Executor", executor):
            with contextlib.redirect_stdout(io.StringIO()):
                trials = calibrate.Trials(read_task(folder / "task.json"), folder, 99, mock.Mock())
                return calibrate.calibrate(trials.task, trials)


def with_tension(target: list[Any]) -> list[dict[str, Any]]:
    oedometer, tension = json.loads(json.dumps(TASK["tests"]))
    return [oedometer, {**tension, "quantities": {"tensile_strength": target}}]


def far_start() -> dict[str, Any]:
    parameters = {**TASK["parameters"], "tensile_strength": [0.05, 0.01, 10]}
    return {"parameters": parameters, "tests": with_tension([CRUSH * TENSILE, "20%"])}


class CalibrateTest(unittest.TestCase):
    def require_found(self, result: dict[str, Any], within: float) -> None:
        found = result["parameters"]
        self.assertAlmostEqual(found["crush_strength"]["value"] / CRUSH, 1.0, delta=within)
        self.assertAlmostEqual(found["tensile_strength"]["value"] / TENSILE, 1.0, delta=within)

    def test_two_tests_are_calibrated_together(self) -> None:
        result = calibrated({})
        self.require_found(result, 0.08)
        self.assertTrue(result["converged"], result)
        names = [f"oedometer at {INITIAL * np.exp(e):g} kg/m3" for e in STRAINS]
        self.assertEqual(result["targets"], [*names, "tension tensile_strength"])
        # ln(stress) over 0.1: a tenth more strength is one deviation
        np.testing.assert_allclose(result["sensitivity"]["crush_strength"][:2], 10.0, rtol=1e-2)
        undetermined = " ".join(result["not_determined"])
        self.assertIn("shear_strength^", undetermined)
        self.assertIn("shear_strength: the curves do not depend on it", undetermined)
        self.assertNotIn("tensile_strength^", undetermined)

    def test_distant_start_converges_by_logarithms(self) -> None:
        """A tenth of the strength that is wanted: differences lead there slowly, logarithms at
        once, for the strength is a power of the parameter."""
        result = calibrated({**far_start(), "iterations": 6})
        self.require_found(result, 0.02)
        self.assertTrue(result["converged"], result)

    def test_early_stop_is_reported(self) -> None:
        result = calibrated({**far_start(), "iterations": 1})
        self.assertFalse(result["converged"])
        self.assertEqual(result["ended"], "1 evaluations were not enough")
        self.assertGreater(result["next_factor"]["tensile_strength"], 1.5)

    def test_scatter_of_packings_widens_the_error(self) -> None:
        changes = {"seeds": [86028121, 67867967], "tests": with_tension([CRUSH * TENSILE, "20%"])}
        result = calibrated(changes, Scattering)
        self.require_found(result, 0.2)  # four times the scatter
        self.assertTrue(result["converged"], result)
        self.assertGreater(result["scatter_of_seeds"], 0.05)


if __name__ == "__main__":
    unittest.main()
