# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/crosscheck: its plan, its lines, and its page, which is made of them."""

import math
import sys
import unittest

import numpy as np

from furrow_post.uncertainty.budget import Budget
from furrow_post.analyse.plates import pressure_at
from furrow_post.uncertainty.verdict import BEST, COEFFICIENT, HUB_DROP, RUN, Entry
from furrow_post.csv_table import read_comments, read_rows
from support.command import SOURCE
from support.tables import row

FOLDER = SOURCE / "inputs" / "crosscheck"
sys.path.insert(0, str(FOLDER))

import cases
import lines
import series
import wheel_cases


class LinesTest(unittest.TestCase):
    def test_unknown_parts_are_named(self) -> None:
        """The page has the other answers."""
        for value, parts, expected in (
            (0.13, (), "inconclusive, +30 %, unknown: uncertainty of grains"),
            (0.1, (0.001, 0.0, math.nan, 0.0), "inconclusive, +0 % (2 %), unknown: domain of grains"),
        ):
            with self.subTest(value=value, parts=parts):
                other = Entry(HUB_DROP, "grains", value, Budget(*parts), RUN)
                own = {"continuum": Entry(HUB_DROP, "continuum", 0.1, Budget(0.0, 0.0, 0.0, 0.0), RUN), "grains": other}
                self.assertEqual(lines.answers(own), [expected])

    def test_line_of_the_table_restores_its_entry(self) -> None:
        parts = Budget(1e-3, 2e-3, math.nan, 0.0)
        for quantity in (HUB_DROP, COEFFICIENT, pressure_at(0.015)):
            for kind in (RUN, BEST):
                written = Entry(quantity, "grains", 0.25, parts, kind, cpu_time=12.0)
                read = lines.entry_of(lines.line_of("case", "base", written, 0.03, "abc"))
                self.assertEqual((read.quantity, read.kind), (quantity, kind))
                self.assertEqual((read.value, read.text()), (0.25, written.text()))
                self.assertEqual(read.unknown, ["domain"])


class SeriesTest(unittest.TestCase):
    """A point of a series moves from its twin among the base's runs."""

    twin = row("base", "grains", 0.04, 0.08, 0.20, 10.0, error=0.001)
    point = row("point", "grains", 0.0401, 0.12, 0.26, 10.0, error=0.003)

    def test_sinkages_compare_by_ratio_and_coefficients_by_difference(self) -> None:
        ratio_error = 0.15 * math.hypot(0.003 / 0.12, 0.001 / 0.08)
        for quantity, base, value, parts in (
            (HUB_DROP, 0.1, 0.1 * 1.5, (ratio_error, 0.003, 0.0015, 0.006)),
            (COEFFICIENT, 0.15, 0.15 + 0.06, (math.hypot(0.003, 0.001), 0.002, 0.001, 0.004)),
        ):
            with self.subTest(quantity=quantity.key):
                whole = Entry(quantity, "grains", base, Budget(0.0, 0.002, 0.001, 0.0), BEST)
                zero = series.moved(whole, self.point, self.twin, 0.004)
                np.testing.assert_allclose([zero.value, *(zero.parts.part(name) for name in Budget.NUMERICAL)], [value, *parts], atol=5e-8)

    def test_twin_run_has_size_packing_and_width_of_the_point(self) -> None:
        others = [
            row("coarse", "grains", 0.05, 0.1, 0.2, 99.0),
            row("packing", "grains", 0.04, 0.1, 0.2, 99.0, seed="2"),
            row("wide", "grains", 0.04, 0.1, 0.2, 99.0, domain="2x2"),
            row("short", "grains", 0.04, 0.1, 0.2, 1.0, domain="1.5x1"),
        ]
        self.assertIs(series.twin_of(self.point, [*others, self.twin]), self.twin)


class PlanTest(unittest.TestCase):
    def test_lines_of_cases_csv_become_runs(self) -> None:
        plans = {plan.run.name: plan for plan in cases.plan()}
        size = plans["wheel_on_sand/continuum_size_0.05"]
        self.assertEqual((size.kind, size.is_check, size.of_wheel), ("size", True, True))
        self.assertEqual(size.run.variables["cell"], "0.05")
        base = plans["plate_on_sand/hybrid_base"]
        self.assertEqual((base.is_check, base.of_wheel), (False, False))
        scene = plans["tyre_on_snow/grains_base"].run
        self.assertIn(SOURCE / "inputs" / "scenes" / "tyre_on_sintered_snow.lig", scene.arguments)
        self.assertNotIn("here", scene.variables)

    def test_scripts_and_materials_exist(self) -> None:
        for plan in cases.plan():
            with self.subTest(run=plan.run.name):
                self.assertIn(plan.run.arguments[1], plan.run.input_files())
                material = str(plan.run.variables.get("material", "../materials/dry_sand.yaml"))
                self.assertTrue((FOLDER / material).is_file())

    def test_cited_bases_have_both_grounds_of_a_case(self) -> None:
        found = [lines.entry_of(line) for line in wheel_cases.cited_lines()]
        runs = [one for one in found if one.kind == RUN and one.quantity == HUB_DROP]
        self.assertEqual([one.source for one in runs], ["continuum", "grains"])
        self.assertTrue(all(not one.unknown for one in runs))


class PageTest(unittest.TestCase):
    """README.md is made of results.csv, and that of the runs that are planned."""

    def test_table_of_the_page_is_results_csv(self) -> None:
        page = (FOLDER / "README.md").read_text(encoding="utf-8")
        table = lines.table(read_rows(FOLDER / "results.csv"))
        self.assertGreater(len(table), 2)
        self.assertIn("\n".join(["", *table, ""]), page)

    def test_every_ground_has_one_program(self) -> None:
        self.assertEqual(read_comments(FOLDER / "results.csv"), list(lines.HEAD))
        runs = [row for row in read_rows(FOLDER / "results.csv") if row["kind"] == RUN]
        wanted = {(plan.case, plan.ground) for plan in cases.plan()}
        cited = {(row["case"], row["ground"]) for row in read_rows(FOLDER / "cited.csv")}
        self.assertEqual({(row["case"], row["source"]) for row in runs}, wanted | cited)
        # grains are by an earlier program than continuum and hybrid, but for those under the tyre, as the page says
        programs = {(row["source"] == "grains" and row["case"] != "tyre_on_snow", row["program"]) for row in runs if row["program"]}
        self.assertEqual(sorted(is_earlier for is_earlier, _ in programs), [False, True])


if __name__ == "__main__":
    unittest.main()
