# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of runs with exact lines to zero size: errors and costs."""

import math
import tempfile
import unittest
from pathlib import Path

from furrow_post.uncertainty import cost_table
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from support.tables import CONTINUUM, GRAINS, made_runs, row


class TableTest(unittest.TestCase):
    def test_components_equal_those_of_the_series(self) -> None:
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

    def test_error_of_the_domain_is_the_mean_difference_of_packings(self) -> None:
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

    def test_corrected_run_has_the_value_of_all_runs(self) -> None:
        family = cost_table.families(made_runs())[GRAINS]
        value, parts = family.best_estimate("sinkage", 0.04, 0.12 * 1.12, 1e-4) or self.fail()
        zero, error = family.reference("sinkage")
        numerical = [parts.part(name) for name in parts.NUMERICAL]
        self.assertEqual((value, numerical), (zero, [0.0, error, family.domain_error("sinkage"), 0.0]))
        self.assertEqual(parts.label("size"), "grains")

    def test_run_of_another_load_is_corrected_as_its_family(self) -> None:
        family = cost_table.families(made_runs())[CONTINUUM]
        value, parts = family.best_estimate("sinkage", 0.03, 0.5, 1e-4) or self.fail()
        self.assertAlmostEqual(value, 0.5 - 0.2 * 0.03, places=5)
        series = family.convergence("sinkage") or self.fail()
        self.assertEqual((parts.time, parts.size), (1e-4, series.error))
        self.assertEqual(parts.label("size"), "cells")

    def test_series_without_order_has_its_range_as_error(self) -> None:
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

    def test_report_has_each_run_with_its_numerical_error_and_cost(self) -> None:
        report = cost_table.cost_report(made_runs())
        self.assertIn("c0.02: continuum, cells of 20 mm, half model, rigid wheel", report)
        self.assertRegex(report, r"hub drop +104 ± 4 mm \(cells 4; ground unknown\)")
        self.assertRegex(report, r"hub drop +1\d\d ± \d+ mm \(grains \d+, ground 6, packing 1\.4\)")
        for one, errors in cost_table.numerical_errors(made_runs()):
            family = cost_table.families(made_runs())[one.family]
            self.assertEqual(errors["sinkage"], family.components("sinkage", one.size, one.sinkage_error))

    def test_written_errors_list_their_parts(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            cost_table.write_errors(Path(folder) / "t.csv", made_runs())
            row = read_rows(Path(folder) / "t.csv")[0]
        parts = [float(row[f"sinkage_error_{part}"] or 0) for part in ("time", "size", "domain", "packing")]
        self.assertAlmostEqual(float(row["sinkage_error"]), math.hypot(*parts), 6)

    def test_written_table_is_read_back(self) -> None:
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
