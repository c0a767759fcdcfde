# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of a study: rows of runs, of failed runs, limits, names that are not there."""

import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import yaml

from furrow_post.errors import ResultsError
from furrow_post.run.case import Case
from furrow_post.tables.engine import Engine, Tables
from furrow_post.tables.frames import frame_of


def run_of(name: str, error: str = "", **variables: Any) -> Any:
    record = SimpleNamespace(changes={}, facts={}, cpu_time=1.0, system_time=0.5)
    case = Case(name, "furrow", variables=variables)
    return SimpleNamespace(name=name, what="", case=case, error=error, seconds=1.0, record=record, folder=Path(name))


class SomeRuns:
    def __init__(self, *runs: Any) -> None:
        self.runs = runs

    def ended(self, *names: str) -> list[Any]:
        return list(self.runs)

    def done(self, *names: str) -> list[Any]:
        return [run for run in self.runs if not run.error]


class EngineTest(unittest.TestCase):
    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def engine(self, text: str) -> Engine:
        module: Any = SimpleNamespace(loads=lambda run: [{"load": 10.0 * k} for k in (1, 2)])
        return Engine(self.folder, yaml.safe_load(text), module)

    def rows(self, text: str, *runs: Any) -> list[dict[str, Any]]:
        engine = self.engine(text)
        runs_of: Any = SomeRuns(*runs)
        return engine.rows(runs_of, "t.csv", Tables(engine))

    def test_measure_of_several_rows_has_a_row_for_each(self) -> None:
        text = "tables: {t.csv: {measure: loads, where: 'load > 10', columns: {run: name, kN: load / 1e3, cell: v.cell}}}"
        self.assertEqual(self.rows(text, run_of("a", cell=0.02)), [{"run": "a", "kN": 0.02, "cell": 0.02}])

    def test_failed_runs_have_the_named_columns(self) -> None:
        text = "tables: {t.csv: {failed: [run, error], measure: loads, columns: {run: name, load: , error: }}}"
        found = self.rows(text, run_of("a"), run_of("b", "too long"))
        self.assertEqual(found[0], {"run": "a", "load": 10.0, "error": ""})
        self.assertEqual(found[2], {"run": "b", "error": "too long"})

    def test_blocks_have_common_columns_first(self) -> None:
        text = "tables: {t.csv: {columns: {run: name}, blocks: [{expand: '[{\"k\": 1}]', columns: {k: }}]}}"
        self.assertEqual(self.rows(text, run_of("a")), [{"run": "a", "k": 1}])

    def test_unknown_name_is_refused_with_the_existing_ones(self) -> None:
        with self.assertRaisesRegex(ResultsError, "column x: name 'lod' is not defined; known names are .*load"):
            self.rows("tables: {t.csv: {measure: loads, columns: {x: lod}}}", run_of("a"))
        with self.assertRaisesRegex(ResultsError, "there is no lods; known are "):
            self.rows("tables: {t.csv: {measure: lods, columns: {x: load}}}", run_of("a"))
        with self.assertRaisesRegex(ResultsError, r"unknown keys \['colums'\]; allowed are"):
            self.engine("tables: {t.csv: {colums: {}}}")

    def test_limits_use_stored_rows_without_a_run(self) -> None:
        text = """
            tables: {t.csv: {measure: loads, columns: {run: name, load: }}}
            limits:
              - {table: t.csv, holds: load < 15, message: '{run}: {load}'}
              - {table: t.csv, where: load > 50, least: 1, absent: no large load}
        """
        (self.folder / "t.csv").write_text("run,load\nstored,60\n", encoding="utf-8")
        engine = self.engine(text)
        tables = Tables(engine)
        tables["t.csv"] = frame_of([])
        self.assertEqual(list(engine.missed(tables)), ["stored: 60"])
        tables["t.csv"] = frame_of([{"run": "a", "load": 20.0}])
        self.assertEqual(list(engine.missed(tables)), ["a: 20.0", "no large load"])

    def test_limit_of_repetition_lists_the_changes(self) -> None:
        (self.folder / "t.csv").write_text("run,load\na,60\n", encoding="utf-8")
        engine = self.engine("limits: [{table: t.csv, key: run, repeats: [load], within: 0.01}]")
        tables = Tables(engine)
        tables["t.csv"] = frame_of([{"run": "a", "load": 61.0}, {"run": "new", "load": 1.0}])
        self.assertEqual(
            list(engine.missed(tables)), ["a: load 61.0 was 60; the table is of another program"]
        )

    def test_table_of_unstored_runs_ignores_stored_ones(self) -> None:
        engine = self.engine("tables: {runs: {measure: loads}, a.csv: {of: runs}, b.csv: {of: a.csv}, c.csv: {of: reference.csv}}")
        self.assertEqual([engine.is_of_stored(name) for name in ("a.csv", "b.csv", "c.csv")], [False, False, True])


if __name__ == "__main__":
    unittest.main()
