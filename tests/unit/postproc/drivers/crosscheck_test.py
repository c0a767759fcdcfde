# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/crosscheck: its plan, its lines, and its page, which is made of them."""

import math
import sys
import unittest

from furrow_post.uncertainty.budget import Budget
from furrow_post.analyse.plates import pressure_at
from furrow_post.uncertainty.verdict import BEST, COEFFICIENT, FORMULA, HUB_DROP, RUN, Entry
from furrow_post.csv_table import read_comments, read_rows
from support.command import SOURCE
from support.tables import row

FOLDER = SOURCE / "inputs" / "crosscheck"
sys.path.insert(0, str(FOLDER))

import cases
import lines
import series
import wheel_cases


def entry(source: str, value: float, u: float, kind: str = RUN) -> Entry:
    return Entry(HUB_DROP, source, value, Budget(u, 0.0, 0.0, 0.0), kind)


class AnswersTest(unittest.TestCase):
    def test_the_answer_is_the_verdict_s(self) -> None:
        # against 100 mm: value and uncertainty of the other ground, verdict
        for value, u, expected in (
            (0.102, 0.01, "yes, +2 % (20 %)"),
            (0.15, 0.01, "no, +50 % (20 %)"),
            (0.13, 0.02, "inconclusive, +30 % (40 %)"),
            (0.13, math.nan, "inconclusive, +30 %, unknown: uncertainty of grains"),
        ):
            with self.subTest(value=value, u=u):
                other = entry("grains", value, u)
                if math.isnan(u):
                    other = Entry(HUB_DROP, "grains", value, Budget(), RUN)
                own = {"continuum": entry("continuum", 0.1, 0.0), "grains": other}
                self.assertEqual(lines.answers(own), [expected])

    def test_parts_that_are_not_known_are_named(self) -> None:
        other = Entry(HUB_DROP, "grains", 0.1, Budget(0.001, 0.0, math.nan, 0.0), RUN)
        (answer,) = lines.answers({"continuum": entry("continuum", 0.1, 0.0), "grains": other})
        self.assertEqual(answer, "inconclusive, +0 % (2 %), unknown: domain of grains")

    def test_a_third_ground_is_named(self) -> None:
        own = {name: entry(name, 0.1, 0.001) for name in lines.GROUNDS}
        self.assertEqual(
            lines.answers(own), ["grains: yes, +0 % (3 %)", "hybrid: yes, +0 % (3 %)"]
        )


class LinesTest(unittest.TestCase):
    def test_a_line_is_the_entry_again(self) -> None:
        parts = Budget(1e-3, 2e-3, math.nan, 0.0)
        for quantity in (HUB_DROP, COEFFICIENT, pressure_at(0.015)):
            for kind in (RUN, BEST):
                written = Entry(quantity, "grains", 0.25, parts, kind, cpu_time=12.0)
                read = lines.entry_of(lines.line_of("case", "base", written, 0.03, "abc"))
                self.assertEqual((read.quantity, read.kind), (quantity, kind))
                self.assertEqual((read.value, read.text()), (0.25, written.text()))
                self.assertEqual(read.unknown, ["domain"])

    def test_the_table_has_the_best_estimates_else_the_values_of_the_runs(self) -> None:
        made = [
            lines.line_of(case, "base", one, size)
            for case, one, size in (
                ("wheel_on_sand", entry("continuum", 0.1, 0.002), 0.04),
                ("wheel_on_sand", entry("continuum", 0.11, 0.002, BEST), math.nan),
                ("wheel_on_sand", entry("grains", 0.12, 0.002), 0.03),
                ("wheel_on_sand", entry("grains", 0.111, 0.002, BEST), math.nan),
                ("wheel_on_sand", Entry(HUB_DROP, "made", 0.09, Budget(), FORMULA), math.nan),
                ("plate", entry("continuum", 0.1, 0.002), 0.04),
                ("plate", entry("grains", 0.12, 0.002), 0.03),
            )
        ]
        made.append(lines.number_line("wheel_on_sand", "flow", "displacement_difference", 0.2))
        point = lines.line_of("wheel_on_sand", "load=1560", entry("grains", 0.1, 0.002, BEST), 0.04)
        self.assertEqual(
            lines.table([*made, point])[2:],
            [
                "| wheel on sand | hub drop [mm] | 110 ± 2 | 111 ± 2 |  |  | yes, +1 % (5 %) |",
                "| plate | hub drop [mm] | 100 ± 2 | 120 ± 2 |  |  | no, +20 % (6 %) |",
            ],
        )


class SeriesTest(unittest.TestCase):
    """A point of a series moves from its twin among the base's runs."""

    parts = Budget(0.0, 0.002, 0.001, 0.0)
    twin = row("base", "grains", 0.04, 0.08, 0.20, 10.0, error=0.001)
    point = row("point", "grains", 0.0401, 0.12, 0.26, 10.0, error=0.003)

    def test_sinkages_go_by_the_ratio(self) -> None:
        zero = series.moved(
            Entry(HUB_DROP, "grains", 0.1, self.parts, BEST), self.point, self.twin, 0.004
        )
        self.assertAlmostEqual(zero.value, 0.1 * 1.5)
        time = 0.15 * math.hypot(0.003 / 0.12, 0.001 / 0.08)
        for name, expected in zip(Budget.NUMERICAL, (time, 0.003, 0.0015, 0.006)):
            found = zero.parts.part(name)
            self.assertAlmostEqual(found, expected)

    def test_coefficients_go_by_the_difference(self) -> None:
        zero = series.moved(
            Entry(COEFFICIENT, "grains", 0.15, self.parts, BEST), self.point, self.twin, 0.004
        )
        self.assertAlmostEqual(zero.value, 0.15 + 0.06)
        time = math.hypot(0.003, 0.001)
        for name, expected in zip(Budget.NUMERICAL, (time, 0.002, 0.001, 0.004)):
            found = zero.parts.part(name)
            self.assertAlmostEqual(found, expected)

    def test_the_twin_has_the_point_s_size_packing_and_width(self) -> None:
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

    def test_scripts_and_materials_are_there(self) -> None:
        for plan in cases.plan():
            with self.subTest(run=plan.run.name):
                script = plan.run.arguments[1]
                self.assertIn(script, plan.run.input_files())
                material = str(plan.run.variables.get("material", "../materials/dry_sand.yaml"))
                self.assertTrue((FOLDER / material).is_file())

    def test_cited_bases_have_both_grounds_of_a_case(self) -> None:
        found = [lines.entry_of(line) for line in wheel_cases.cited_lines()]
        runs = [one for one in found if one.kind == RUN and one.quantity == HUB_DROP]
        self.assertEqual([one.source for one in runs], ["continuum", "grains"])
        self.assertTrue(all(not one.unknown for one in runs))


class PageTest(unittest.TestCase):
    """README.md is made of results.csv, and that of the runs that are planned."""

    def setUp(self) -> None:
        self.rows = read_rows(FOLDER / "results.csv")

    def test_the_page_s_table_is_that_of_results_csv(self) -> None:
        page = (FOLDER / "README.md").read_text(encoding="utf-8").splitlines()
        table = lines.table(self.rows)
        self.assertGreater(len(table), 2)
        start = page.index(table[0])
        self.assertEqual(page[start : start + len(table)], table)

    def test_every_ground_is_by_one_program(self) -> None:
        self.assertEqual(read_comments(FOLDER / "results.csv"), list(lines.HEAD))
        runs = [row for row in self.rows if row["kind"] == RUN]
        there = {(row["case"], row["source"]) for row in runs}
        wanted = {(plan.case, plan.ground) for plan in cases.plan()}
        cited = {(row["case"], row["ground"]) for row in read_rows(FOLDER / "cited.csv")}
        self.assertEqual(there, wanted | cited)
        # grains are by earlier programs than continuum and hybrid, those of the tyre by another, as the page says
        earlier = [row for row in runs if row["source"] == "grains"]
        tyre = [row for row in earlier if row["case"] == "tyre_on_snow"]
        for rows in ([row for row in runs if row not in earlier], tyre, [row for row in earlier if row not in tyre]):
            programs = {row["program"] for row in rows if row["program"]}
            self.assertEqual(len(programs), 1)


if __name__ == "__main__":
    unittest.main()
