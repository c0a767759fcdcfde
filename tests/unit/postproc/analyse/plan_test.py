# SPDX-License-Identifier: GPL-2.0-or-later
"""Plans of runs: the promised errors are those that the fit then has; the cheapest way is taken."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from furrow_post.analyse import cost_table
from furrow_post.analyse.grid_convergence import grid_convergence
from furrow_post.analyse.plan import Plan, plan
from furrow_post.errors import ResultsError
from support.command import run_post
from support.tables import row

Z, C = 0.1, 0.2  # values at zero size


def line(h: float, error: float, cpu: float, name: str = "", **options: str) -> cost_table.Row:
    """A run whose value is on the line Z (1 + 2 h), C (1 - h)."""
    ground = "grains" if "seed" in options else "continuum"
    options.setdefault("seed", "")
    return row(
        name or f"{h}", ground, h, Z * (1 + 2 * h), C * (1 - h), cpu, error=error, **options
    )


def planned(rows: list[cost_table.Row], sinkage: float, coefficient: float) -> Plan:
    (family,) = cost_table.families(rows).values()
    return plan(family, {"sinkage": sinkage}, {"coefficient": coefficient})


class PlanTest(unittest.TestCase):
    def test_the_promise_is_the_scatter_of_fits_to_such_runs(self) -> None:
        rows = [line(h, 2e-4, 1e-4 / h**3) for h in (0.08, 0.04, 0.02)]
        present = planned(rows, 1.0, 1.0).present["sinkage"]
        made = planned(rows, 0.9 * present / Z, 1.0)
        self.assertTrue(made.reached)
        self.assertGreater(len(made.steps), 0)
        sizes = np.array([point.size for point in made.points])
        scatter = np.array([point.errors[0] for point in made.points])
        random = np.random.default_rng(1)
        at_zero = []
        for _ in range(400):
            values = random.normal(Z * (1 + 2 * sizes), scatter)
            found = grid_convergence(list(sizes), list(values), list(scatter))
            if found.extrapolated and found.order < 2.0:
                at_zero.append(found.value)
        self.assertGreater(len(at_zero), 350)
        # beside the scatter half of the grid convergence index of the finest size
        index = 0.5 * 1.25 * 2 * Z * sizes.min()
        expected = np.hypot(np.std(at_zero), index)
        self.assertAlmostEqual(made.errors["sinkage"] / expected, 1.0, delta=0.1)

    def test_a_noisy_coarse_run_is_made_longer_first(self) -> None:
        rows = [line(0.08, 5e-3, 1.0, "coarse"), line(0.02, 1e-4, 100.0), line(0.01, 1e-4, 900.0)]
        made = planned(rows, 0.0135, 0.0015)
        self.assertEqual(made.steps[0].action, "coarse 4 times as long")
        self.assertAlmostEqual(made.steps[0].cpu_time, 3.0)

    def test_packings_that_scatter_are_repeated(self) -> None:
        rows = [line(h, 1e-5, 4e-4 / h**2, f"g{h}", seed="1") for h in (0.08, 0.04, 0.02)]
        other = line(0.04, 1e-5, 0.25, "other", seed="2")
        other.sinkage += 1.5e-3
        made = planned([*rows, other], 0.12, 0.02)
        self.assertTrue(made.reached)
        self.assertTrue(all("another packing" in step.action for step in made.steps), made.steps)
        unknown = "domain: a run like g0.08 on a wider and longer ground (0.06 s)"
        self.assertEqual(made.unknown, [unknown])

    def test_nothing_is_planned_where_the_goal_is_reached(self) -> None:
        rows = [line(h, 1e-5, 1.0 / h) for h in (0.04, 0.02, 0.01)]
        made = planned(rows, 0.03, 0.01)
        self.assertTrue(made.reached)
        self.assertEqual(made.steps, [])

    def test_sizes_without_an_order_are_refused(self) -> None:
        two = [line(0.04, 1e-5, 1.0), line(0.02, 1e-5, 10.0)]
        bent = [*two, line(0.01, 1e-5, 90.0)]
        bent[1].sinkage = 1.1 * Z * 1.08
        for rows, reason in ((two[:1], "only one size"), (two, "fewer than three"), (bent, "monoton")):
            with self.assertRaisesRegex(ResultsError, f"{reason}.*add a run with finer cells"):
                planned(rows, 0.03, 0.01)

    def test_as_a_command(self) -> None:
        with tempfile.TemporaryDirectory() as scratch:
            table = Path(scratch) / "runs.csv"
            rows = [line(h, 1e-3, 4.0 / h) for h in (0.08, 0.04, 0.02)]
            rows.append(line(0.04, 1e-3, 100.0, "wide", domain="2x2"))
            rows[-1].sinkage += 0.01
            cost_table.write_table(table, rows)
            done = run_post("plan", table, "--sinkage", "5%")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("continuum half rigid wheel, at zero size: sinkage 100 mm", done.stdout)
            self.assertIn("The goal is not reached", done.stdout)
            self.assertIn("the domain alone leaves more in the sinkage", done.stdout)
            done = run_post("plan", table, "--sinkage", "50%", "--coefficient", "0.1")
            self.assertNotIn("not reached", done.stdout)
            done = run_post("plan", table, "--ground", "grains")
            self.assertEqual(done.returncode, 1)
            self.assertIn("the table has no runs on grains; it has continuum", done.stderr)


if __name__ == "__main__":
    unittest.main()
