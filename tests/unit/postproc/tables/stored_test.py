# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of studies that are made of other tables: made of the stored ones they are the stored ones, cell by cell."""

import unittest
from pathlib import Path

from furrow_post.csv_table import read_rows
from furrow_post.study.definition import evaluation_of
from furrow_post.study.values import DEFINITION, load_yaml, study_folders
from furrow_post.tables.engine import Engine, Tables
from support.command import SOURCE


def is_stored(engine: Engine, name: str) -> bool:
    """Whether a table can be made of stored ones: no table of runs that is not stored is among its sources."""
    spec = engine.tables.get(name)
    if spec is None or Path(name).suffix and "of" not in spec:
        return True
    if "of" not in spec:
        return False
    joined = [one["table"] for step in spec.get("do") or [] if isinstance(step, dict) for one in step.values() if isinstance(one, dict) and "table" in one]
    sources = [spec["of"]] if isinstance(spec["of"], str) else spec["of"]
    return all(is_stored(engine, one) for one in (*sources, *joined))


class StoredTablesTest(unittest.TestCase):
    def test_stored_tables_are_those_of_their_sources(self) -> None:
        made = 0
        for folder in study_folders(SOURCE):
            engine = Engine(folder, load_yaml(folder / DEFINITION), evaluation_of(folder))
            for name, spec in engine.tables.items():
                if "of" in spec and Path(name).suffix and is_stored(engine, name):
                    with self.subTest(study=folder.name, table=name):
                        stored = (folder / name).read_text(encoding="utf-8")
                        self.assertEqual(engine.text(name, Tables(engine)), stored)
                        made += 1
        self.assertGreater(made, 2)

    def test_stored_tables_are_within_the_limits_of_their_study(self) -> None:
        for folder in study_folders(SOURCE):
            engine = Engine(folder, load_yaml(folder / DEFINITION), evaluation_of(folder))
            with self.subTest(study=folder.name):
                self.assertEqual(list(engine.missed(Tables(engine))), [])


if __name__ == "__main__":
    unittest.main()
