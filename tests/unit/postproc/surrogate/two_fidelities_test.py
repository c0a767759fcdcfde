# SPDX-License-Identifier: GPL-2.0-or-later
"""A fast ground corrected by few better runs, on closed forms: error, band, file, and what is refused."""

import unittest
from dataclasses import replace

import numpy as np
from scipy.stats import qmc

from furrow_post.arrays import Floats
from furrow_post.csv_table import read_rows, write_rows
from furrow_post.errors import ResultsError
from furrow_post.surrogate.gaussian_process import Z_95, Process, fit_process, likeliest
from furrow_post.surrogate.model import fit, read_surrogate
from furrow_post.surrogate.training import HUB_DROP, PULL, RADIUS, TORQUE, Training, read_training, require_alike
from furrow_post.surrogate.two_fidelities import Corrected, correct
from support.command import SOURCE, run_post
from support.folder import FolderTest
from support.surrogate import RANGES, write_sweep_table

DESIGNS = 6
NEW = np.random.default_rng(0).random((1000, 2))


def rms(errors: Floats) -> float:
    return float(np.sqrt(np.mean(errors**2)))


def forrester(x: Floats) -> Floats:
    """The function of [Forrester2007]; its fast version is half of it plus a line."""
    values: Floats = (6 * x[:, 0] - 2) ** 2 * np.sin(12 * x[:, 0] - 4)
    return values


def pull(x: Floats) -> tuple[Floats, Floats]:
    """Pull on a fast and on a better ground, over slip and load in [0, 1]."""
    slip, load = 0.8 * x[:, 0], 0.5 + x[:, 1]
    fast = 0.7 * (1 - np.exp(-4 * (slip + 0.05))) - 0.1 * np.sqrt(load)
    better = 0.8 * (1 - np.exp(-3 * (slip + 0.02))) - 0.14 * load
    return fast, better


class CorrectTest(FolderTest):
    def test_few_runs_correct_the_fast_function(self) -> None:
        x = qmc.Halton(1, seed=1).random(50)
        fast, _ = fit_process(x, 0.5 * forrester(x) + 10 * (x[:, 0] - 0.5) - 5)
        few, new = np.linspace(0, 1, 8)[:, None], np.linspace(0, 1, 201)[:, None]
        both, held, gain = correct(fast, few, forrester(few))
        self.assertAlmostEqual(both.rho, 2.0, delta=0.3)  # its prior is 1 ± 1
        self.assertLess(held.rms_error, 0.05 * min(gain.fast, gain.better))
        alone = rms(likeliest(few, forrester(few), None).mean_at(new) - forrester(new))
        self.assertLess(rms(both.mean_at(new) - forrester(new)), 0.4 * alone)
        self.assertAlmostEqual(gain.fast, rms(fast.mean_at(few) - forrester(few)), 12)

    def test_band_holds_its_share_of_new_points(self) -> None:
        x = qmc.Halton(2, seed=1).random(60)
        fast, _ = fit_process(x, pull(x)[0])
        shares, fits = [], []
        for design in range(DESIGNS):
            few = qmc.Halton(2, seed=100 + design).random(8)
            noise = 0.005 * np.random.default_rng(design).normal(size=8)
            both, _, _ = correct(fast, few, pull(few)[1] + noise)
            new = NEW[np.all((NEW >= few.min(0)) & (NEW <= few.max(0)), axis=1)]
            mean, deviation = both.predict(new)
            errors = np.abs(mean - pull(new)[1])
            shares.append(np.mean(errors <= Z_95 * deviation))
            fits.append(np.mean(errors <= Z_95 * deviation / both.factor))
        self.assertGreater(np.mean(shares), 0.9, shares)
        self.assertLess(np.mean(fits), 0.85, fits)  # the widening matters

    def test_equal_tables_need_no_correction(self) -> None:
        x = qmc.Halton(2, seed=1).random(60)
        y = pull(x)[1]
        fast, _ = fit_process(x, y)
        both, held, gain = correct(fast, x[:8], y[:8])
        self.assertAlmostEqual(both.rho, 1.0, delta=1e-3)
        self.assertLess(rms(both.mean_at(NEW) - fast.mean_at(NEW)), 1e-3 * np.std(y))
        self.assertLess(held.rms_error, 0.01 * gain.better)

    def test_error_has_both_processes(self) -> None:
        x = qmc.Halton(2, seed=1).random(60)
        fast = Process(x, pull(x)[0], np.ones(2), 1.0, 1e-2)
        delta = Process(x[:8], pull(x)[1][:8], np.ones(2), 1.0, 1e-4)
        both = Corrected(fast, 1.3, delta, 2.0)
        parts = fast.predict(NEW[:9])[1], delta.predict(NEW[:9])[1]
        mean, deviation = both.predict(NEW[:9])
        np.testing.assert_allclose(deviation, 2.0 * np.hypot(1.3 * parts[0], parts[1]))
        joint_mean, covariance = both.joint(NEW[:9])
        np.testing.assert_allclose(joint_mean, mean)
        np.testing.assert_allclose(np.diag(covariance), deviation**2)

    def test_too_few_better_runs_are_refused(self) -> None:
        x = qmc.Halton(2, seed=1).random(60)
        fast = Process(x, pull(x)[0], np.ones(2), 1.0, 1e-4)
        with self.assertRaisesRegex(ResultsError, r"over 2 inputs needs 5 better runs or more \(got 4\)"):
            correct(fast, x[:4], pull(x)[1][:4])


class TablesTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        write_sweep_table(self.folder / "fast.csv", 60, 0.003)
        self.rows = read_rows(self.folder / "fast.csv")

    def better(self, count: int) -> None:
        """Some of the runs, with a pull of 0.9 of theirs minus 0.05."""
        rows = [{**row, PULL: f"{0.9 * float(row[PULL]) - 0.05:.8g}"} for row in self.rows[:count]]
        write_rows(self.folder / "better.csv", rows)

    def test_file_of_the_command_predicts_the_better_runs(self) -> None:
        self.better(9)
        file = self.folder / "wheel.json"
        done = run_post("surrogate", self.folder / "fast.csv", "--better", self.folder / "better.csv", "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"60 runs, corrected by 9 better ones, each held out\n")
        self.assertRegex(done.stdout, r"rms error at the better runs +fast alone +better alone +both\n")
        found = read_surrogate(file)
        runs = read_training([self.folder / "better.csv"])
        made, held, _ = fit(read_training([self.folder / "fast.csv"]), {}, runs)
        x = found.scaled(dict(zip(found.names, runs.inputs.T)))
        for name in (PULL, HUB_DROP):
            ours, theirs = made.processes[name], found.processes[name]
            np.testing.assert_allclose(theirs.predict(x), ours.predict(x), rtol=1e-6, atol=1e-9)
            np.testing.assert_allclose(theirs.joint(x)[1], ours.joint(x)[1], rtol=1e-5, atol=1e-9)
            self.assertEqual(found.checks[name]["rms_error"], held[name].rms_error)
        mean, deviation = found.processes[PULL].predict(x)
        self.assertTrue(np.all(np.abs(mean - runs.quantities[PULL]) <= Z_95 * deviation))
        shown = run_post("surrogate", file, "--at", *(f"{name}={value}" for name, value in zip(found.names, runs.inputs[0])))
        self.assertIn(PULL, shown.stdout)
        low = [one.low for one in found.inputs]  # of the better runs
        np.testing.assert_allclose(low, runs.inputs.min(0))

    def test_stored_runs_have_the_errors_of_the_page(self) -> None:
        folder = SOURCE / "inputs" / "guide" / "howto" / "surrogate"
        fast, better = (read_training([folder / f"grc1_{ground}.csv"]) for ground in ("fast", "better"))
        low, high = better.inputs.min(0), better.inputs.max(0)
        x, few = ((runs.inputs - low) / (high - low) for runs in (fast, better))
        process, _ = fit_process(x, fast.quantities[PULL])
        _, held, gain = correct(process, few, better.quantities[PULL])
        np.testing.assert_allclose((gain.fast, gain.better, held.rms_error), (0.13, 0.088, 0.039), rtol=0.05)

    def test_tables_that_differ_are_refused(self) -> None:
        fast = read_training([self.folder / "fast.csv"])
        constants = {**fast.constants, "speed": 2.0}
        outside = fast.inputs.copy()
        outside[0, 0] = 0.9
        for other, message in (
            (replace(fast, names=("slip", "load", "n")), "the better runs slip, load, n; vary the same"),
            (replace(fast, constants=constants), "speed is 0.5 in the runs and 2 in the better runs"),
            (replace(fast, constants={**fast.constants, RADIUS: 0.3}), "wheel_radius is 0.25 in the runs and 0.3"),
            (replace(fast, inputs=outside), "slip: the better runs reach from .* to 0.9, the runs"),
        ):
            with self.assertRaisesRegex(ResultsError, message):
                require_alike(fast, other)
        turned = replace(fast, names=fast.names[::-1], inputs=fast.inputs[:, ::-1])
        np.testing.assert_array_equal(require_alike(fast, turned).inputs, fast.inputs)

    def test_torque_has_the_radius_of_the_slip(self) -> None:
        def read(**more: str) -> Training:
            write_rows(self.folder / "tips.csv", [{**row, **more} for row in self.rows])
            return read_training([self.folder / "tips.csv"])

        bare, tips = read(), read(slip_radius="0.3")
        self.assertAlmostEqual(bare.constants[RADIUS], 0.25, 6)
        self.assertEqual(tips.constants[RADIUS], 0.3)
        np.testing.assert_allclose(tips.quantities[TORQUE], bare.quantities[TORQUE] * 0.25 / 0.3, rtol=1e-5)
        self.assertEqual(set(RANGES), set(tips.names))


if __name__ == "__main__":
    unittest.main()
