# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil parameters from made wheel tests: recovered with the coverage that the intervals state."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.csv_table import write_rows
from furrow_post.surrogate.posterior import Posterior, Tests, identify
from furrow_post.surrogate.training import HUB_DROP, PULL, TORQUE
from support.command import run_post
from support.surrogate import RANGES, made_surrogate, wheel

SOIL = {"phi": (24.0, 38.0), "k": (0.5, 2.0)}
ERRORS = {PULL: 0.02, TORQUE: 0.02, HUB_DROP: 0.001}
SLIP, LOAD = np.array([0.0, 0.15, 0.3, 0.5]), np.array([400.0, 600.0, 600.0, 800.0])
REPETITIONS = 20
SURROGATE = made_surrogate(50, {**RANGES, **SOIL})


def tests_of(phi: float, k: float, random: np.random.Generator, names: tuple[str, ...]) -> Tests:
    """Tests of this soil, with noise of the errors that they state."""
    exact = wheel(SLIP, LOAD, np.array(phi), k)
    measured = {
        name: (
            exact[name] + ERRORS[name] * random.normal(size=len(SLIP)),
            np.full(len(SLIP), ERRORS[name]),
        )
        for name in names
    }
    return Tests({"slip": SLIP, "load": LOAD}, measured)


class IdentifyTest(unittest.TestCase):
    def test_intervals_have_their_stated_coverage_of_the_hidden_soil(self) -> None:
        random = np.random.default_rng(7)
        inside: dict[str, list[bool]] = {name: [] for name in SOIL}
        ratios: list[Floats] = []
        for repetition in range(REPETITIONS):
            hidden = {name: float(random.uniform(low, high)) for name, (low, high) in SOIL.items()}
            tests = tests_of(hidden["phi"], hidden["k"], random, tuple(ERRORS))
            posterior = identify(SURROGATE, tests, repetition, steps=100)
            ratios.append(posterior.ratio)
            for name, samples in zip(posterior.names, posterior.samples.T):
                low, high = np.percentile(samples, (10, 90))
                inside[name].append(bool(low <= hidden[name] <= high))
        # 80 % of 40: 32 +- 2.5; the bounds are three standard deviations away
        self.assertTrue(24 <= sum(map(sum, inside.values())) <= 39, inside)
        self.assertLess(np.mean(ratios), 0.3)

    def test_width_equals_linear_theory(self) -> None:
        exact = tests_of(31.0, 1.0, np.random.default_rng(0), tuple(ERRORS))
        posterior = identify(SURROGATE, exact, steps=300)
        step = {"phi": 0.1, "k": 0.01}
        columns = []
        for name, h in step.items():
            change = [
                wheel(
                    SLIP,
                    LOAD,
                    np.array(31.0 + s * h * (name == "phi")),
                    1.0 + s * h * (name == "k"),
                )
                for s in (1, -1)
            ]
            columns.append(
                np.concatenate(
                    [(change[0][q] - change[1][q]) / (2 * h * ERRORS[q]) for q in ERRORS]
                )
            )
        expected = np.sqrt(np.diag(np.linalg.inv(np.array(columns) @ np.array(columns).T)))
        np.testing.assert_allclose(np.std(posterior.samples, axis=0), expected, rtol=0.25)

    def test_parameters_that_torque_cannot_identify_are_stated(self) -> None:
        posterior = identify(
            SURROGATE, tests_of(31.0, 1.0, np.random.default_rng(1), (TORQUE,)), steps=100
        )
        self.assertIn("k is not identified", " ".join(posterior.remarks()))
        self.assertNotIn("phi is not", " ".join(posterior.remarks()))

    def test_contradiction_and_combination_are_stated(self) -> None:
        line = np.random.default_rng(0).random(500)
        scaled = 0.5 + 0.1 * np.column_stack([line, line])
        remarks = Posterior(("c", "phi"), scaled, scaled, 1.0, 80.0, 12).remarks()
        self.assertIn(
            "c and phi are identified in combination only: their correlation is 1.00", remarks
        )
        self.assertIn("contradict the surrogate: chi squared is 80 for 10", remarks[-1])

    def test_command_identifies_and_refuses_faults(self) -> None:
        with tempfile.TemporaryDirectory() as temporary:
            folder = Path(temporary)
            SURROGATE.write(folder / "wheel.json")
            exact = wheel(SLIP, LOAD, np.array(31.0), 1.0)
            whole: list[dict[str, float]] = [
                {
                    "slip": SLIP[i],
                    "load": LOAD[i],
                    TORQUE: exact[TORQUE][i],
                    f"{TORQUE}_error": 0.01,
                    HUB_DROP: exact[HUB_DROP][i],
                    f"{HUB_DROP}_error": 0.001,
                }
                for i in range(len(SLIP))
            ]
            write_rows(folder / "tests.csv", whole)
            done = run_post(
                "identify", folder / "wheel.json", folder / "tests.csv", "-o", folder / "out"
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"phi +3[01]\.\d")
            self.assertTrue((folder / "out" / "posterior.png").is_file())
            faults: tuple[tuple[dict[str, float], tuple[str, ...], str], ...] = (
                ({f"{TORQUE}_error": 0.0}, (), "torque_coefficient_error must be above 0"),
                ({"load": 2000.0}, (), "load: 2000 lies outside of the training range"),
                ({"n": 1.0}, (), "the surrogate has no input 'n'"),
                ({}, ("--set", "phi=30", "k=1"), "gives all inputs of the surrogate"),
            )
            for change, words, message in faults:
                write_rows(folder / "wrong.csv", [{**row, **change} for row in whole])
                done = run_post(
                    "identify",
                    folder / "wheel.json",
                    folder / "wrong.csv",
                    "-o",
                    folder / "out",
                    *words,
                )
                self.assertIn(message, done.stderr)
                self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
