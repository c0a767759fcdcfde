# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of runs with exact lines to zero size: errors, costs, recommendations."""

import dataclasses
import math
import tempfile
import unittest
from pathlib import Path

from furrow_post.analyse import cost, cost_table, extrapolation
from furrow_post.analyse.cost_table import FamilyKey
from furrow_post.errors import ResultsError
from support.tables import CONTINUUM, GRAINS, made_runs, row


class TableTest(unittest.TestCase):
    def test_components_are_those_of_the_series(self) -> None:
        families = cost_table.families(made_runs())
        series = families[CONTINUUM].convergence("sinkage")
        assert series
        self.assertAlmostEqual(series.value, 0.1, places=5)
        self.assertAlmostEqual(series.slope, 0.2, places=4)
        family = families[GRAINS]
        best = family.convergence("sinkage") or self.fail()
        parts = family.components("sinkage", 0.03, 1e-4)
        # the distance from the best estimate, and the error of that
        expected = math.hypot(best.at(0.03) - best.value, best.error)
        self.assertAlmostEqual(parts.size, expected, places=9)
        self.assertAlmostEqual(parts.packing, 0.002 / math.sqrt(2), places=9)
        # the wider one is 5 mm below one packing and 7 mm below the other
        self.assertAlmostEqual(parts.domain, 0.006, places=9)
        squares = 1e-8 + expected**2 + 0.002**2 / 2 + 0.006**2
        self.assertAlmostEqual(parts.total, math.sqrt(squares), places=9)

    def test_the_domain_s_error_is_the_mean_difference_from_all_packings_of_the_size(self) -> None:
        mean = 0.12 * 1.12 + 0.001  # of the two packings of 40 mm
        wider = row("wider", "grains", 0.04, mean + 0.002, 0.26, 1.0, domain="2x2", seed="2")
        longer = row("longer", "grains", 0.04, mean + 0.003, 0.26, 1.0, domain="3x1")
        family = cost_table.families([*made_runs(), wider])[GRAINS]
        self.assertAlmostEqual(family.domain_error("sinkage"), (0.006 - 0.002) / 2, places=9)
        family = cost_table.families([*made_runs(), wider, longer])[GRAINS]
        self.assertAlmostEqual(family.domain_error("sinkage"), 0.003, places=9)  # the largest

    def test_packings_of_several_sizes_have_one_scatter(self) -> None:
        third = row("third", "grains", 0.04, 0.12 * 1.12 + 0.004, 0.25, 1.0, seed="3")
        other = row("other", "grains", 0.02, 0.12 * 1.06 + 0.006, 0.25, 1.0, seed="2")
        family = cost_table.families([*made_runs(), third, other])[GRAINS]
        squares = 2 * 0.002**2 + 2 * 0.003**2  # about the means of three and of two
        self.assertAlmostEqual(family.packing("sinkage"), math.sqrt(squares / 3), places=9)

    def test_a_run_of_the_table_comes_to_the_value_of_all_its_runs(self) -> None:
        family = cost_table.families(made_runs())[GRAINS]
        value, parts = family.best_estimate("sinkage", 0.04, 0.12 * 1.12, 1e-4) or self.fail()
        zero, error = family.reference("sinkage")
        self.assertEqual((value, parts.numerical()), (zero, [0.0, error, family.domain_error("sinkage"), 0.0]))

    def test_a_run_of_another_load_moves_as_its_family_does(self) -> None:
        family = cost_table.families(made_runs())[CONTINUUM]
        value, parts = family.best_estimate("sinkage", 0.03, 0.5, 1e-4) or self.fail()
        self.assertAlmostEqual(value, 0.5 - 0.2 * 0.03, places=5)
        series = family.convergence("sinkage") or self.fail()
        self.assertEqual((parts.time, parts.size), (1e-4, series.error))

    def test_a_series_without_order_errs_by_its_range(self) -> None:
        values = {0.05: 0.190, 0.04: 0.184, 0.03: 0.184, 0.02: 0.183}  # no curve
        rows = [
            row(f"{h}", "continuum", h, 0.1, c, 1.0, seed="", error=1e-3) for h, c in values.items()
        ]
        family = cost_table.families(rows)[CONTINUUM]
        best, error = family.reference("coefficient")
        self.assertEqual(best, 0.183)
        self.assertAlmostEqual(error, math.hypot(1.5 * 0.007, 1e-3), places=9)
        of_size = {h: family.components("coefficient", h).size for h in (*values, 0.045)}
        self.assertAlmostEqual(of_size[0.02], error, places=9)
        for h, off in ((0.05, 0.007), (0.04, 0.001), (0.045, 0.004)):  # the last between two
            self.assertAlmostEqual(of_size[h], math.hypot(off, error), places=9)

    def test_one_size_gives_no_error(self) -> None:
        rows = [row("a", "grains", 0.04, 0.1, 0.2, 1.0)]
        family = cost_table.families(rows)[GRAINS]
        self.assertIsNone(family.convergence("sinkage"))
        self.assertEqual(family.components("sinkage", 0.04).known, [])
        with self.assertRaisesRegex(ResultsError, "add a run of another size, or longer runs"):
            cost.recommend(cost.assess(rows), 0.1)

    def test_recommends_the_cheapest_within_the_error(self) -> None:
        # as c0.02, at three times its cost
        slow = row("slow", "continuum", 0.02, 0.1 * 1.04, 0.2 * 0.9, 2e3, seed="", error=1e-9)
        assessed = cost.assess(made_runs() + [slow])
        errors = {a.row.run: a.error for a in assessed}
        # the coefficient's 5 h is the worse, with half of the index: 1.25 times the finest's
        index = 0.5 * 1.25 * 5 * 0.01
        self.assertAlmostEqual(errors["c0.04"], math.hypot(0.2, index), places=3)
        self.assertAlmostEqual(errors["c0.02"], math.hypot(0.1, index), places=3)
        # size, packing and domain of the sinkage
        family = cost_table.families(made_runs())[GRAINS]
        zero, _ = family.reference("sinkage")
        total = family.components("sinkage", 0.02, 1e-9).total / zero
        self.assertAlmostEqual(errors["g0.02"], total, places=6)
        self.assertEqual({a.row.run for a in assessed if not a.pareto}, {"slow", "g0.01"})
        for wanted, name, reached in ((0.11, "c0.02", True), (0.001, "c0.01", False)):
            choice, within = cost.recommend(assessed, wanted)
            self.assertEqual(within, reached)
            if reached:
                self.assertEqual(choice.row.run, name)
            self.assertEqual(choice.error, min(a.error for a in assessed) if not reached else choice.error)
        grains, within = cost.recommend(assessed, total + 1e-6, {"grains"})
        self.assertEqual((grains.row.run, within), ("g0.02", True))

    def test_two_runs_extrapolated_where_they_are_cheaper(self) -> None:
        assessed = cost.assess([r for r in made_runs() if r.ground == "continuum"])
        # on exact lines a pair has no error but that of the series: 40 and 20 mm are the cheapest
        run, within = cost.recommend(assessed, 0.04)
        pair = extrapolation.better_pair(assessed, 0.04, run, within) or self.fail()
        self.assertEqual([run.row.run for run in pair.runs], ["c0.04", "c0.02"])
        self.assertAlmostEqual(pair.cpu_time, 1e-4 / 0.04**4 + 1e-4 / 0.02**4)
        worst = assessed[0].reference_errors[pair.worst] / assessed[0].references[pair.worst]
        self.assertAlmostEqual(pair.error, worst, places=4)
        run, within = cost.recommend(assessed, 0.11)
        self.assertIsNone(extrapolation.better_pair(assessed, 0.21, run, within))
        run, within = cost.recommend(assessed, 1e-6)  # that nothing reaches
        best = extrapolation.better_pair(assessed, 1e-6, run, within) or self.fail()
        self.assertLess(best.error, run.error)
        value, u = pair.at_size_zero("sinkage", (0.108, 1e-3), (0.104, 2e-3))
        self.assertAlmostEqual(value, 0.1, places=4)
        self.assertAlmostEqual(u, math.hypot(0.04 * 2e-3, 0.02 * 1e-3) / 0.02, places=5)

    def test_a_pair_has_the_order_of_its_family(self) -> None:
        rows = [
            row(f"{h}", "continuum", h, 0.1 + 20 * h**2, 0.2 - 30 * h**2, 1 / h, seed="", error=1e-9)
            for h in (0.04, 0.02, 0.01)
        ]
        assessed = cost.assess(rows)
        pair = next(p for p in extrapolation.pairs(assessed) if p.coarse.row.size == 0.04)
        value, _ = pair.at_size_zero("sinkage", (0.1 + 20 * 0.04**2, 0.0), (0.1 + 20 * 0.02**2, 0.0))
        self.assertAlmostEqual(value, 0.1, places=4)
        rows[1].sinkage = 0.2  # no longer monotonic: no order, no pair
        self.assertEqual(list(extrapolation.pairs(cost.assess(rows))), [])

    def test_a_pair_s_noise_and_packings_are_enlarged(self) -> None:
        runs = [r for r in made_runs() if r.ground == "grains"]
        for one in runs:
            one.coefficient = 0.25 * (1 + 4 * one.size)
        assessed = cost.assess(runs)
        pair = next(p for p in extrapolation.pairs(assessed) if p.coarse.row.size == 0.04)
        zero, left = pair.references["sinkage"], pair.fine.reference_errors["sinkage"]
        parts, order = pair.fine.parts["sinkage"], pair.fine.orders["sinkage"]
        h1, h2 = (run.row.size**order for run in pair.runs)
        value, _ = pair.at_size_zero(
            "sinkage", pair.coarse.row.value("sinkage"), pair.fine.row.value("sinkage")
        )
        enlarged = math.hypot(h1, h2) / (h1 - h2) * parts.packing
        expected = math.hypot(value - zero, enlarged, parts.domain, left) / zero
        self.assertAlmostEqual(pair.errors["sinkage"], expected, places=6)

    def test_another_wheel_errs_by_the_difference_of_values_at_size_zero(self) -> None:
        tyres = [
            dataclasses.replace(
                r,
                run="t" + r.run,
                wheel="tyre",
                model="whole",
                sinkage=1.25 * r.sinkage,
                cpu_time=9 * r.cpu_time,
            )
            for r in made_runs()
            if r.ground == "continuum"
        ]
        assessed = {a.row.run: a for a in cost.assess(made_runs() + tyres, "tyre")}
        stand_in, tyre = assessed["c0.01"], assessed["tc0.01"]
        index = 0.5 * 1.25 * 0.05
        self.assertAlmostEqual(tyre.error, math.hypot(0.05, index), places=3)  # its own size, as before
        self.assertEqual(tyre.models["sinkage"], 0.0)
        self.assertAlmostEqual(stand_in.models["sinkage"], 0.2, places=4)  # 0.1 m for 0.125 m
        own = math.hypot(0.2 * 0.01 / 0.125, 0.5 * 1.25 * 0.2 * 0.01 / 0.125)
        expected = math.hypot(0.2, own, stand_in.reference_errors["sinkage"] / 0.125)
        self.assertAlmostEqual(stand_in.errors["sinkage"], expected, places=3)
        self.assertAlmostEqual(stand_in.references["sinkage"], 0.125, places=4)
        self.assertTrue(math.isnan(assessed["g0.02"].error))  # no tyre on grains to be judged by
        choice, _ = cost.recommend(list(assessed.values()), 0.11)
        self.assertEqual(choice.row.run, "tc0.02")
        self.assertEqual(cost_table.wanted_wheel(["# made", "# wheel: tyre"]), "tyre")

    def test_size_and_cost_beyond_the_table(self) -> None:
        # coefficient error 5 h and half of the index, in proportion to h: 1 % at h; cost 1e-4/h^4
        size = 0.01 * 0.01 / math.hypot(0.05, 0.5 * 1.25 * 0.05)
        continuum = [r for r in made_runs() if r.ground == "continuum"]
        needed, *_ = cost.needed(cost.assess(continuum), 0.01)
        self.assertEqual(needed.family, FamilyKey("continuum", "half", "rigid wheel"))
        self.assertAlmostEqual(needed.size, size, delta=2e-5)
        self.assertAlmostEqual(needed.cpu_time / (1e-4 / size**4), 1, delta=0.05)

    def test_size_for_an_error_follows_the_observed_order(self) -> None:
        # errors in proportion to the root of the size: a quarter of the size for half the error
        rows = [
            row(f"h{h}", "continuum", h, 0.1, 0.2 * (1 - math.sqrt(h)), 1e-4 / h**4, seed="", error=1e-9)
            for h in (0.04, 0.02, 0.01)
        ]
        assessed = cost.assess(rows)
        finest = min(assessed, key=lambda a: a.row.size)
        self.assertAlmostEqual(finest.orders["coefficient"], 0.5, places=2)
        whole, half = (cost.needed(assessed, part * finest.error)[0].size for part in (1.0, 0.5))
        self.assertAlmostEqual(whole, 0.01, places=5)
        self.assertAlmostEqual(half / whole, 0.25, places=2)

    def test_written_table_comes_back(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.csv"
            cost_table.write_table(path, made_runs(), ["# made"])
            rows, comments = cost_table.read_table(path)
            self.assertEqual([r.run for r in rows], [r.run for r in made_runs()])
            self.assertAlmostEqual(rows[0].sinkage, made_runs()[0].sinkage)
            self.assertEqual(comments, ["# made"])
            path.write_text("run,ground\na,b\n")
            message = "has no column model; columns are run, ground"
            with self.assertRaisesRegex(ResultsError, message):
                cost_table.read_table(path)


if __name__ == "__main__":
    unittest.main()
