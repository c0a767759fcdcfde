# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/costs: its tables are made of the runs that it lists; speed against error."""

import math
import unittest
from typing import Any

from furrow_post.uncertainty import cost_table
from furrow_post.csv_table import read_rows
from furrow_post.study.definition import evaluation_of
from support.command import SOURCE

FOLDER = SOURCE / "inputs" / "costs"
driver: Any = evaluation_of(FOLDER)


class CostsTest(unittest.TestCase):
    def test_tables_have_the_listed_runs(self) -> None:
        tables = {path.stem for path in FOLDER.glob("*.csv")} - {"runs", "models", "provenance"}
        self.assertEqual(tables, set(driver.TABLES))
        for table in driver.TABLES:
            with self.subTest(table=table):
                rows, _ = cost_table.read_table(FOLDER / f"{table}.csv")
                listed = [row for row in driver.PLANNED if row["table"] == table]
                self.assertEqual([row.run for row in rows], [row["run"] for row in listed])

    def test_every_family_has_all_parts_of_an_error(self) -> None:
        for table in driver.TABLES:
            rows, _ = cost_table.read_table(FOLDER / f"{table}.csv")
            for key, family in cost_table.families(rows).items():
                with self.subTest(table=table, family=key):
                    parts = family.components("sinkage", family.bases[-1].size, 0.0)
                    self.assertTrue(all(map(math.isfinite, [parts.part(name) for name in parts.NUMERICAL])), parts)

    def test_cheapest_run_within_the_requested_error_is_marked(self) -> None:
        rows = read_rows(FOLDER.parent / "validation" / "speed.csv")
        self.assertEqual(len({row["kind"] for row in rows}), 3)
        self.assertLessEqual({"continuum", "grains", "hybrid", "terrain/scm", "formula"}, {row["ground"] for row in rows})
        for row in rows:
            self.assertGreaterEqual(float(row["whole"]), float(row["numerical"] or 0.0), row)
            within = [o for o in rows if o["kind"] == row["kind"] and float(o["whole"]) <= 0.3]
            self.assertEqual(row["asked"] == "yes", row == min(within, key=lambda o: float(o["core_minutes"])), row)


if __name__ == "__main__":
    unittest.main()
