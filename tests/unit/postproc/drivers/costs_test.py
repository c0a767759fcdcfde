# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/costs: its tables are made of the runs that it lists, and --error can make them again."""

import shlex
import math
import unittest
from pathlib import Path
from typing import Any

from furrow_post.analyse import cost_table
from furrow_post.csv_table import rows_text
from furrow_post.scene.catalogue import script_of
from furrow_post.study.definition import evaluation_of
from support.command import SOURCE

FOLDER = SOURCE / "inputs" / "costs"
driver: Any = evaluation_of(FOLDER)


class CostsTest(unittest.TestCase):
    def test_every_table_is_of_the_listed_runs(self) -> None:
        tables = {path.stem for path in FOLDER.glob("*.csv")} - {"runs", "models", "provenance", Path(driver.MODELS).stem}
        self.assertEqual(tables, set(driver.TABLES))
        for table in driver.TABLES:
            with self.subTest(table=table):
                rows, _ = cost_table.read_table(FOLDER / f"{table}.csv")
                listed = [row for row in driver.PLANNED if row["table"] == table]
                self.assertEqual([row.run for row in rows], [row["run"] for row in listed])
                for row, planned in zip(rows, listed):
                    self.assertEqual(row.options, driver.options(planned))

    def test_every_family_has_all_parts_of_an_error(self) -> None:
        for table in driver.TABLES:
            rows, _ = cost_table.read_table(FOLDER / f"{table}.csv")
            for key, family in cost_table.families(rows).items():
                with self.subTest(table=table, family=key):
                    parts = family.components("sinkage", family.bases[-1].size, 0.0)
                    self.assertTrue(all(map(math.isfinite, parts.numerical())), parts)

    def test_errors_of_the_models_are_those_of_the_cross_check(self) -> None:
        table, rows = FOLDER / driver.MODELS, driver.model_errors(*driver.hub_drops())
        self.assertEqual(table.read_text(encoding="utf-8"), rows_text(rows, driver.MODELS_HEAD))
        for row in rows:
            with self.subTest(run=row["run"], ground=row["ground"]):
                scene = shlex.split(str(row["options"]))[0].replace("{inputs}", str(FOLDER.parent))
                self.assertTrue(scene == "furrow-post" or script_of(scene).is_file())

    def test_models_are_compared_with_the_finest_continuum(self) -> None:
        answers, (value, error) = driver.hub_drops()
        self.assertEqual(
            {a.model for a in answers}, {"formula", "terrain/scm", "continuum", "grains", "hybrid"}
        )
        finest = max((a.cpu_time, a.value) for a in answers if a.model == "continuum")
        self.assertEqual(finest[1], value)
        self.assertAlmostEqual(error / value, 0.17, places=2)

    def test_options_are_those_of_the_run(self) -> None:
        offered = next(row for row in driver.PLANNED if row["offered"] == "yes")
        scene, *given = shlex.split(driver.options(offered))
        self.assertEqual(scene, offered["scene"])
        self.assertEqual(given[::3], ["-v"] * (len(given) // 3))
        self.assertEqual(dict(zip(given[1::3], given[2::3])), driver.named_values(offered["variables"]))


if __name__ == "__main__":
    unittest.main()
