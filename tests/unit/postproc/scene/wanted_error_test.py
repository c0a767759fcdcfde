# SPDX-License-Identifier: GPL-2.0-or-later
"""Plans for a wanted error or a time: what is chosen, what a forecast promises, what limits it."""

import math
import unittest
from dataclasses import replace
from unittest import mock

from furrow_post.uncertainty.budget import Budget
from furrow_post.uncertainty.whole_error import RunErrors
from furrow_post.read.wheel_run import Condition, WheelRun, read_wheel_run
from furrow_post.scene import wanted_error
from furrow_post.scene.wanted_error import ErrorPlan, Forecast, outcome
from support.folder import FolderTest
from support.runs import write_run


def forecast(cells: float, cost: float, model: float = 0.01, size: float = 1.0) -> Forecast:
    """Forecast of a hub drop of 0.1 m and a coefficient that is known."""
    parts = {"hub_drop": Budget(1e-4, cells, model=model, sources={"model": "made tests"}), "resistance_coefficient": Budget(1e-4)}
    return Forecast([("cell", f"{cells:g}")], size, cost, parts, {"hub_drop": 0.1, "resistance_coefficient": 0.25})


SERIES = [forecast(0.02, 10.0), forecast(0.01, 100.0), forecast(0.005, 1000.0), forecast(0.0025, 1e4)]


class ChoiceTest(unittest.TestCase):
    def test_cheapest_run_within_the_error_is_chosen(self) -> None:
        self.assertIs(wanted_error._chosen(SERIES, 0.15, math.inf), SERIES[1])

    def test_smallest_error_within_the_time_is_chosen(self) -> None:
        self.assertIs(wanted_error._chosen(SERIES, math.inf, 2000.0), SERIES[2])
        self.assertIs(wanted_error._chosen(SERIES, math.inf, 1.0), SERIES[0])

    def test_unreachable_error_takes_no_extra_time(self) -> None:
        """The model leaves 10 %: cells of 2.5 mm would gain 1 % of it for ten times the cost."""
        by_model = [forecast(0.005, 100.0), forecast(0.0025, 1e4)]
        self.assertAlmostEqual(by_model[0].error, math.hypot(1e-4, 0.005, 0.01) / 0.1)
        self.assertIs(wanted_error._chosen([forecast(0.003, 100.0), forecast(0.0025, 1e4)], 0.05, math.inf).cpu_time, 100.0)

    def test_unreachable_error_keeps_the_sizes_of_the_scene(self) -> None:
        found = [forecast(0.001, 10.0, 0.1, 2.0), forecast(0.0005, 100.0, 0.1), forecast(0.0002, 1e4, 0.1, 0.5)]
        self.assertIs(wanted_error._chosen(found, 0.05, math.inf), found[1])
        self.assertIs(wanted_error._chosen(found, 0.05, 50.0), found[0])


class PlanTest(FolderTest):
    def pilot(self, size: float = 0.06) -> WheelRun:
        write_run(self.folder / "pilot", torque=50.0)
        run = read_wheel_run(self.folder / "pilot")
        run.ground, run.size, run.cpu_time = "continuum", size, 8.0
        run.conditions["density"] = Condition(1600.0, "kg/m3")
        return run

    def test_forecast_equals_the_budget_of_a_run_of_that_size(self) -> None:
        pilot = self.pilot()
        variables = mock.Mock(defaults={"distance": "1.5"})
        with mock.patch.object(wanted_error, "script_variables", return_value=variables):
            made = wanted_error._forecast(pilot, self.folder, {"cell": 0.0375}, "distance", 1.0, 4.0)
        self.assertEqual(made.variables, [("distance", "6")])
        fine = RunErrors(replace(pilot, size=0.0375)).all()["hub_drop"]
        self.assertAlmostEqual(made.budgets["hub_drop"].total, replace(fine, time=fine.time / 2).total, 9)
        self.assertAlmostEqual(made.budgets["hub_drop"].time, fine.time / 2)
        self.assertAlmostEqual(made.cpu_time, 8.0 * 4 * 1.6**3.5)

    def test_limit_lists_part_tests_and_measurement(self) -> None:
        lines = ErrorPlan(SERIES[3], self.pilot(), 0.05, math.inf).lines()
        self.assertIn("  hub drop: 10 % (cells 2, model 10; ground, packing, step, contact, held, material unknown)", lines)
        self.assertEqual(
            lines[-1],
            "5 % is not within reach: the part 'model' leaves 10 % of the hub drop (nearest tests: made tests); measure the pull "
            "at one slip, or ring shear at your pressure",
        )
        self.assertEqual(len(ErrorPlan(SERIES[3], self.pilot(), 0.2, math.inf).why_not()), 0)
        self.assertIn("Nothing fits into 5 s", ErrorPlan(SERIES[0], self.pilot(), math.inf, 5.0).lines()[-1])

    def test_outcome_equals_that_of_the_run(self) -> None:
        write_run(self.folder / "run", torque=50.0)
        for wanted, state in ((0.9, "within 90 %"), (0.01, "above 1 %: the part 'model' leaves 82 %"), (math.inf, " of one core.")):
            text = outcome(ErrorPlan(SERIES[0], self.pilot(), wanted, math.inf), self.folder / "run")[0]
            self.assertIn(state, text)


if __name__ == "__main__":
    unittest.main()
