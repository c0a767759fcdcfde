# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of runs with exact lines to size zero: errors, costs, recommendations."""

import dataclasses
import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

from furrow_post.analyse import cost, cost_table, extrapolation
from furrow_post.analyse.cost_table import FamilyKey
from furrow_post.errors import ResultsError
from support.tables import CONTINUUM, GRAINS, made_runs, row


class TableTest(unittest.TestCase):
    def test_extrapolation_and_components_are_those_of_the_lines(self) -> None:
        families = cost_table.families(made_runs())
        fit = families[CONTINUUM].fit("sinkage")
        assert fit
        self.assertAlmostEqual(fit.at_zero, 0.1, places=9)
        self.assertAlmostEqual(fit.slope, 0.2, places=7)
        parts = families[GRAINS].components("sinkage", 0.03, 1e-4)
        # the second packing lifts the mean at 40 mm by 1 mm
        slope = 0.12 * 3 + 0.001 / 0.02
        self.assertAlmostEqual(parts.size, slope * 0.03, places=5)
        self.assertAlmostEqual(parts.packing, 0.002 / math.sqrt(2), places=9)
        # the wider one is 5 mm below one packing and 7 mm below the other
        self.assertAlmostEqual(parts.domain, 0.006, places=9)
        squares = 1e-8 + (slope * 0.03) ** 2 + 0.002**2 / 2 + 0.006**2
        self.assertAlmostEqual(parts.total, math.sqrt(squares), places=5)

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
        value, parts = family.at_size_zero("sinkage", 0.04, 0.12 * 1.12, 1e-4) or self.fail()
        zero, error = family.reference("sinkage")
        self.assertEqual((value, parts.parts()), (zero, [0.0, error, family.domain_error("sinkage"), 0.0]))

    def test_a_run_of_another_load_comes_to_size_zero_along_the_slope(self) -> None:
        family = cost_table.families(made_runs())[CONTINUUM]
        value, parts = family.at_size_zero("sinkage", 0.03, 0.5, 1e-4) or self.fail()
        self.assertAlmostEqual(value, 0.5 - 0.2 * 0.03, places=9)
        fit = family.fit("sinkage")
        assert fit
        self.assertEqual((parts.time, parts.size), (1e-4, 0.03 * fit.slope_error))

    def test_the_slope_s_error_is_that_of_scattered_values(self) -> None:
        random, sizes, scatter = np.random.default_rng(1), (0.01, 0.02, 0.03, 0.04, 0.05), 2e-3
        fits = []
        for _ in range(400):
            values = 0.1 + 0.2 * np.array(sizes) + random.normal(0, scatter, len(sizes))
            rows = [
                row(f"{h}", "continuum", h, value, 0.2, 1.0, seed="", error=scatter)
                for h, value in zip(sizes, values)
            ]
            fits.append(cost_table.families(rows)[CONTINUUM].fit("sinkage"))
        found = np.array([(fit.slope, fit.slope_error) for fit in fits if fit])
        # the scatter about the line counts where it is larger than the errors: 1.1 times on average
        self.assertAlmostEqual(found[:, 1].mean() / found[:, 0].std(), 1.1, delta=0.12)

    def test_a_run_errs_by_no_less_than_its_distance_from_size_zero(self) -> None:
        values = {0.05: 0.190, 0.04: 0.184, 0.03: 0.184, 0.02: 0.183}  # no line
        rows = [
            row(f"{h}", "continuum", h, 0.1, c, 1.0, seed="", error=1e-3) for h, c in values.items()
        ]
        family = cost_table.families(rows)[CONTINUUM]
        at_zero, slope, *_ = family.fit("coefficient") or self.fail()
        of_size = {h: family.components("coefficient", h).size for h in (*values, 0.045)}
        distance = math.sqrt((0.190 - at_zero) ** 2 - 1e-6)
        self.assertGreater(distance, 1.1 * slope * 0.05)
        self.assertAlmostEqual(of_size[0.05], distance, places=9)
        self.assertAlmostEqual(of_size[0.04], slope * 0.04, places=9)  # it is below the line
        self.assertAlmostEqual(of_size[0.045], slope * 0.045, places=9)  # no run of this size

    def test_one_size_gives_no_error(self) -> None:
        rows = [row("a", "grains", 0.04, 0.1, 0.2, 1.0)]
        family = cost_table.families(rows)[GRAINS]
        self.assertIsNone(family.fit("sinkage"))
        self.assertEqual(family.components("sinkage", 0.04).known, [])
        with self.assertRaisesRegex(ResultsError, "add a run of another size, or longer runs"):
            cost.recommend(cost.assess(rows), 0.1)

    def test_recommends_the_cheapest_within_the_error(self) -> None:
        # as c0.02, at three times its cost
        slow = row("slow", "continuum", 0.02, 0.1 * 1.04, 0.2 * 0.9, 2e3, seed="", error=1e-9)
        assessed = cost.assess(made_runs() + [slow])
        errors = {a.row.run: a.error for a in assessed}
        self.assertAlmostEqual(errors["c0.04"], 0.2, places=4)  # the coefficient's 5 h is the worse
        self.assertAlmostEqual(errors["c0.02"], 0.1, places=4)
        # size, packing and domain of the sinkage; the second packing lifts the mean at 40 mm by
        # 1 mm, and so lowers the value at size zero
        zero = 0.12 - 0.001
        size = (0.12 * 3 + 0.001 / 0.02) * 0.02 / zero
        packing = 0.002 / math.sqrt(2) / zero
        left = math.sqrt(4.5) * packing  # open at size zero: [(X^T X)^-1]_00 of 20, 40, 40 mm
        squares = size**2 + packing**2 + (0.006 / zero) ** 2 + left**2
        self.assertAlmostEqual(errors["g0.02"], math.sqrt(squares), places=4)
        self.assertEqual({a.row.run for a in assessed if not a.pareto}, {"slow"})
        for wanted, name, reached in (
            (0.101, "c0.02", True),
            (0.09, "g0.02", True),
            (0.001, "c0.01", False),
        ):
            choice, within = cost.recommend(assessed, wanted)
            self.assertEqual((choice.row.run, within), (name, reached))

    def test_two_runs_extrapolated_where_they_are_cheaper(self) -> None:
        assessed = cost.assess([r for r in made_runs() if r.ground == "continuum"])
        # on exact lines a pair has no error but that of the line: 40 and 20 mm are the cheapest
        run, within = cost.recommend(assessed, 0.03)
        pair = extrapolation.better_pair(assessed, 0.03, run, within) or self.fail()
        self.assertEqual([run.row.run for run in pair.runs], ["c0.04", "c0.02"])
        self.assertAlmostEqual(pair.cpu_time, 1e-4 / 0.04**4 + 1e-4 / 0.02**4)
        worst = assessed[0].reference_errors[pair.worst] / assessed[0].references[pair.worst]
        self.assertAlmostEqual(pair.error, worst, places=7)
        run, within = cost.recommend(assessed, 0.11)
        self.assertIsNone(extrapolation.better_pair(assessed, 0.11, run, within))
        run, within = cost.recommend(assessed, 1e-6)  # that nothing reaches
        best = extrapolation.better_pair(assessed, 1e-6, run, within) or self.fail()
        self.assertLess(best.error, run.error)
        value, u = pair.at_size_zero((0.108, 1e-3), (0.104, 2e-3))
        self.assertAlmostEqual(value, 0.1)
        self.assertAlmostEqual(u, math.hypot(0.04 * 2e-3, 0.02 * 1e-3) / 0.02)

    def test_a_pair_s_noise_and_packings_are_enlarged(self) -> None:
        assessed = cost.assess([r for r in made_runs() if r.ground == "grains"])
        (pair,) = extrapolation.pairs(assessed)
        packing = pair.fine.parts["sinkage"].packing
        domain = pair.fine.parts["sinkage"].domain
        # f0 of the base's packing is 0.12; the family's is another by what the second packing adds
        zero = pair.fine.references["sinkage"]
        enlarged = math.hypot(0.04, 0.02) / 0.02 * packing
        left = pair.fine.reference_errors["sinkage"]
        expected = math.hypot(0.12 - zero, enlarged, domain, left) / zero
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
        self.assertAlmostEqual(tyre.error, 0.05, places=4)  # its own size, as before
        self.assertEqual(tyre.models["sinkage"], 0.0)
        self.assertAlmostEqual(stand_in.models["sinkage"], 0.2, places=6)  # 0.1 m for 0.125 m
        expected = math.hypot(0.2, 0.2 * 0.01 / 0.125)
        self.assertAlmostEqual(stand_in.errors["sinkage"], expected, places=4)
        self.assertAlmostEqual(stand_in.references["sinkage"], 0.125, places=6)
        self.assertTrue(math.isnan(assessed["g0.02"].error))  # no tyre on grains to be judged by
        choice, _ = cost.recommend(list(assessed.values()), 0.101)
        self.assertEqual(choice.row.run, "tc0.02")
        self.assertEqual(cost_table.wanted_wheel(["# made", "# wheel: tyre"]), "tyre")

    def test_size_and_cost_beyond_the_table(self) -> None:
        # coefficient error 5 h = 1 % at h = 2 mm, cost 1e-4/h^4
        continuum = [r for r in made_runs() if r.ground == "continuum"]
        needed, *_ = cost.needed(cost.assess(continuum), 0.01)
        self.assertEqual(needed.family, FamilyKey("continuum", "half", "rigid wheel"))
        self.assertAlmostEqual(needed.size, 0.002, delta=2e-5)
        self.assertAlmostEqual(needed.cpu_time / (1e-4 / 0.002**4), 1, delta=0.05)

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
