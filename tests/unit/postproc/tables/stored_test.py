# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of studies that are made of other tables: made of the stored ones they are the stored ones, cell by cell."""

import unittest
from pathlib import Path
from typing import Any

from furrow_post.csv_table import read_rows
from furrow_post.study.definition import evaluation_of
from furrow_post.study.values import DEFINITION, NOT_ESTIMATED, load_yaml, study_folders
from furrow_post.tables.engine import Engine, Tables
from furrow_post.tables.frames import frame_of, rows_of
from support.command import SOURCE


class StoredTablesTest(unittest.TestCase):
    def test_stored_tables_equal_those_of_their_sources(self) -> None:
        made = 0
        for folder in study_folders(SOURCE):
            engine = Engine(folder, load_yaml(folder / DEFINITION), evaluation_of(folder))
            for name, spec in engine.tables.items():
                if "of" in spec and Path(name).suffix and engine.is_of_stored(name):
                    with self.subTest(study=folder.name, table=name):
                        stored = (folder / name).read_text(encoding="utf-8")
                        self.assertEqual(engine.text(name, Tables(engine)), stored)
                        made += 1
        self.assertGreater(made, 2)

    def test_stored_tables_of_runs_have_the_columns_that_are_listed(self) -> None:
        seen = 0
        for folder in study_folders(SOURCE):
            content = load_yaml(folder / DEFINITION)
            for name, spec in (content.get("tables") or {}).items():
                blocks = [spec.get("columns") or {}, *(one.get("columns") or {} for one in spec.get("blocks") or [])]
                listed = list(dict.fromkeys(column for block in blocks for column in block))
                if Path(name).suffix and "of" not in spec and not spec.get("transpose") and listed and "*" not in listed:
                    with self.subTest(study=folder.name, table=name):
                        self.assertEqual(list(read_rows(folder / name)[0]), listed)
                        seen += 1
        self.assertGreater(seen, 20)

    def test_stored_closed_forms_are_recomputed(self) -> None:
        folder = SOURCE / "inputs" / "validation" / "report_wheel"
        engine = Engine(folder, load_yaml(folder / DEFINITION), evaluation_of(folder))
        nothing: Any = None  # they need no runs
        for name in ("closed_form.csv", "nrmm.csv"):
            rows = engine.rows(nothing, name, Tables(engine))
            made = [{column: str(value) for column, value in row.items()} for row in rows]
            self.assertEqual(made, read_rows(folder / name), name)

    def test_plates_without_an_error_are_excluded_from_tests(self) -> None:
        folder = SOURCE / "inputs" / "validation"
        engine = Engine(folder, load_yaml(folder / DEFINITION), evaluation_of(folder))
        stored = [row["error"] for row in rows_of(engine.derived("plates", Tables(engine)))]
        self.assertEqual(len(stored), 2)
        for unknown, kept in (("plate_variants.fresh_31.peak_N", stored[:1]), ("cmu_sand.smooth.fx", stored)):
            rows = read_rows(folder / "experiments.csv")
            next(row for row in rows if row["id"] == unknown)["error"] = NOT_ESTIMATED
            tables = Tables(engine)
            tables["experiments.csv"] = frame_of(rows)
            with self.subTest(unknown=unknown):
                self.assertEqual([row["error"] for row in rows_of(engine.derived("plates", tables))], kept)

    def test_stored_tables_are_within_the_limits_of_their_study(self) -> None:
        for folder in study_folders(SOURCE):
            engine = Engine(folder, load_yaml(folder / DEFINITION), evaluation_of(folder))
            with self.subTest(study=folder.name):
                self.assertEqual(list(engine.missed(Tables(engine))), [])


if __name__ == "__main__":
    unittest.main()
