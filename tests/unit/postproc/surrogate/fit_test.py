# SPDX-License-Identifier: GPL-2.0-or-later
"""A surrogate of a wheel with a closed form: errors, intervals, file, and what is refused."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
from sklearn.gaussian_process import GaussianProcessRegressor, kernels

from furrow_post.errors import ResultsError
from furrow_post.surrogate.gaussian_process import (
    Z_95,
    HeldOut,
    Process,
    calibrate,
    fit_process,
    require_calibrated,
)
from furrow_post.surrogate.model import read_surrogate
from furrow_post.surrogate.training import (
    HUB_DROP,
    PULL,
    RADIUS as WHEEL_RADIUS,
    TORQUE,
    read_training,
)
from support.command import run_post
from support.surrogate import RADIUS, RANGES, wheel, write_sweep_table

RUNS, NOISE = 60, 0.003


class FitTest(unittest.TestCase):
    temporary: tempfile.TemporaryDirectory[str]
    folder: Path
    done: subprocess.CompletedProcess[str]

    @classmethod
    def setUpClass(cls) -> None:
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        write_sweep_table(cls.folder / "sweep.csv", RUNS, NOISE)
        cls.done = run_post("surrogate", cls.folder, "--at", "slip=0.2", "load=600", "phi=30")

    @classmethod
    def tearDownClass(cls) -> None:
        cls.temporary.cleanup()

    def test_file_states_inputs_and_outputs(self) -> None:
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        content = json.loads((self.folder / "surrogate.json").read_text())
        self.assertEqual([one["name"] for one in content["inputs"]], list(RANGES))
        self.assertEqual(content["inputs"][1]["unit"], "N")
        self.assertAlmostEqual(content["constants"][WHEEL_RADIUS], RADIUS, 6)
        for name, one in content["quantities"].items():
            self.assertTrue(0.9 <= one["coverage"] <= 0.98, name)
            self.assertIn("rms_error", one)
        self.assertTrue((self.folder / "surrogate.png").stat().st_size > 10_000)

    def test_band_has_its_stated_coverage_of_new_points(self) -> None:
        surrogate = read_surrogate(self.folder / "surrogate.json")
        random = np.random.default_rng(5)
        new = {
            name: random.uniform(low + 0.02 * (high - low), high - 0.02 * (high - low), 2000)
            for name, (low, high) in RANGES.items()
        }
        truth, inside = wheel(**new), []
        for name in (PULL, TORQUE, HUB_DROP):
            size = np.mean(np.abs(truth[name]))
            mean, deviation = surrogate.processes[name].predict(surrogate.scaled(new))
            self.assertLess(np.sqrt(np.mean((mean - truth[name]) ** 2)), NOISE * size)
            runs = truth[name] + NOISE * size * random.normal(size=2000)
            inside.append(np.abs(mean - runs) <= Z_95 * deviation)
        self.assertTrue(0.9 <= np.mean(inside) <= 0.98, np.mean(inside))

    def test_band_holds_on_the_stored_runs_on_a_continuum(self) -> None:
        folder = Path(os.environ["FURROW_SOURCE"]) / "inputs" / "guide" / "howto" / "surrogate"
        runs = read_training([folder / "snow_strength.csv"])
        x = runs.inputs - runs.inputs.min(0)
        for name, error in ((PULL, 0.05), (HUB_DROP, 0.13)):  # rms, of the spread
            _, held = fit_process(x / x.max(0), runs.quantities[name])
            require_calibrated(name, held)
            self.assertLess(held.rms_error, error * held.spread)

    def test_printed_predictions_equal_those_of_the_file(self) -> None:
        shown = re.search(r"drawbar_pull \[N\] +(\S+) ± (\S+)", self.done.stdout)
        assert shown
        exact = float(wheel(np.array(0.2), np.array(600.0), np.array(30.0))[PULL]) * 600
        self.assertLess(abs(float(shown[1]) - exact), float(shown[2]))
        again = run_post(
            "surrogate", self.folder / "surrogate.json", "--at", "slip=0.2", "load=600", "phi=30"
        )
        self.assertIn(shown[0], again.stdout)

    def test_extrapolation_is_refused(self) -> None:
        file = self.folder / "surrogate.json"
        for words, message in (
            (("slip=0.2", "load=1200", "phi=30"), "load: 1200 lies outside of the training range"),
            (("slip=0.2", "load=600"), "needs a value of 'phi'"),
            (("slip=0.2", "load=600", "phi=30", "n=1"), "has no input 'n'"),
        ):
            done = run_post("surrogate", file, "--at", *words)
            self.assertEqual(done.returncode, 1)
            self.assertIn(message, done.stderr)

    def test_process_equals_that_of_scikit_learn(self) -> None:
        random = np.random.default_rng(0)
        x, y, new = random.random((30, 2)), random.normal(size=30), random.random((5, 2))
        kernel = 1.7 * kernels.Matern([0.4, 0.9], nu=2.5) + kernels.WhiteKernel(0.02)
        model = GaussianProcessRegressor(kernel, optimizer=None, normalize_y=True).fit(x, y)
        own = Process(x, y, np.array([0.4, 0.9]), 1.7, 0.02)
        expected = model.predict(new, return_std=True)
        np.testing.assert_allclose(own.predict(new), expected, rtol=1e-8)
        mean, covariance = own.joint(new)
        np.testing.assert_allclose(mean, expected[0], rtol=1e-8)
        np.testing.assert_allclose(
            covariance, model.predict(new, return_cov=True)[1], rtol=1e-6, atol=1e-9
        )

    def test_few_runs_or_wrong_intervals_are_refused_with_the_number(self) -> None:
        with self.assertRaisesRegex(ResultsError, r"needs 40 runs or more .* \(got 39\)"):
            fit_process(np.zeros((39, 1)), np.zeros(39))
        z = np.tile(
            [-1.0, 1.0], 30
        )  # errors of one size: a 95 % band that misses some does not exist
        factor, coverage = calibrate(z, np.arange(60) % 10)
        self.assertEqual((factor, coverage), (1 / Z_95, 1.0))
        held = HeldOut(z, z, factor, coverage, 0.1, 1.0)
        with self.assertRaisesRegex(ResultsError, "100.0 % of the held-out runs"):
            require_calibrated("pull", held)
        with self.assertRaisesRegex(ResultsError, "is 60 % of the spread"):
            require_calibrated("pull", HeldOut(z, z, 1.0, 0.95, 0.6, 1.0))

    def test_pure_noise_is_refused(self) -> None:
        random = np.random.default_rng(3)
        _, held = fit_process(random.random((50, 1)), random.normal(size=50))
        with self.assertRaisesRegex(ResultsError, "pull: the error of held-out runs is"):
            require_calibrated("pull", held)

    def test_unsuitable_training_tables_are_refused(self) -> None:
        words = self.folder / "words"
        words.mkdir()
        write_sweep_table(words / "sweep.csv", 4, set_material="sand.yaml", set_phi="30")
        self.assertEqual(read_training([words]).names, ("slip", "load"))
        text = (words / "sweep.csv").read_text().replace("sand.yaml", "clay.yaml", 1)
        (words / "sweep.csv").write_text(text)
        with self.assertRaisesRegex(ResultsError, "'material' has values that are no numbers"):
            read_training([words])
        with self.assertRaisesRegex(ResultsError, "not every run sets 'material'"):
            read_training([words, self.folder])
        with self.assertRaisesRegex(ResultsError, "has no sweep.csv"):
            read_training([self.folder / "nothing"])


if __name__ == "__main__":
    unittest.main()
