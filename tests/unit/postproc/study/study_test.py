# SPDX-License-Identifier: GPL-2.0-or-later
"""The command line of a study: selection, tables beside the driver or not, checks, provenance."""

import contextlib
import io
import unittest
from collections.abc import Callable, Sequence
from dataclasses import replace

from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.study.study_files import Output, merged
from furrow_post.study.runs import Runs
from furrow_post.study.study import Study
from support.evaluation import run_study
from support.fake import FakeTree
from support.folder import FolderTest


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    """A row per run that is there; a run called low misses its limit."""
    rows = [{"run": run.name, "value": run.record.facts["value"]} for run in runs.done("*")]
    output.table("results.csv", rows)
    output.section([f"{len(rows)} runs"])
    return [f"{row['run']} is below 1" for row in rows if float(str(row["value"])) < 1]


class StudyTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.tree = FakeTree(self.folder)
        self.results = self.folder / "results"
        self.page = self.tree.study / "README.md"
        self.page.write_text("# Made\n\n<!-- written by the study -->\nold\n<!-- end -->\n\nAfter.\n")

    def run_study(self, *words: str, **values: float) -> tuple[int, str]:
        """Runs of these values; status and what was printed."""
        cases = [
            replace(self.tree.case(name, value=value), stage=name[0], what=f"value {value:g}")
            for name, value in values.items()
        ]
        study = Study(self.tree.study, cases, evaluate)
        options = ("--results", str(self.results), "--build", str(self.tree.build))
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
            status = run_study(study, [*words, *options])
        return status, printed.getvalue()

    def test_list_starts_no_run(self) -> None:
        status, printed = self.run_study("--list", a1=1, b1=2)
        self.assertEqual(status, 0)
        self.assertRegex(printed, r"missing +a1 +value 1\nmissing +b1 +value 2")
        self.assertEqual(self.tree.starts(), [])

    def test_run_of_changed_inputs_is_repeated_before_it_is_tabulated(self) -> None:
        base, stored = self.tree.study / "base.yaml", self.tree.study / "results.csv"
        base.write_text("{law: {density: 300}}\n")
        (self.tree.study / "snow.yaml").write_text("{base: base.yaml}\n")
        self.tree.script.write_text("variable snow index snow.yaml\n")
        self.run_study(a1=1, a2=2)
        changes: tuple[tuple[Callable[[], object], str], ...] = (
            (lambda: self.tree.script.write_text("variable snow index snow.yaml\nrun 2\n"), "made.lig"),
            (lambda: base.write_text("{law: {density: 400}}\n"), "base.yaml"),
            (lambda: self.tree.install("another build"), "furrow"),
        )
        for change, name in changes:
            change()
            stored.write_text("run,value\na1,7\n")
            started = len(self.tree.starts())
            printed = self.run_study("--evaluate", "--merge", a1=1, a2=2)[1]
            self.assertIn(f"WARNING: 2 runs in {self.results} do not count, because {name} changed since", printed)
            self.assertEqual((stored.read_text(), len(self.tree.starts())), ("run,value\na1,7\n", started))
            printed = self.run_study("a1", "--merge", a1=1, a2=2)[1]
            self.assertIn(f"Repeating: 1 runs in {self.results} do not count", printed)
            self.assertEqual(read_rows(stored), [{"run": "a1", "value": "1.0"}])
            self.run_study(a1=1, a2=2)
            self.assertEqual(self.tree.starts()[started:], ["a1", "a2"])
            self.assertNotIn("Repeating", self.run_study(a1=1, a2=2)[1])

    def test_stage_and_pattern_select_runs(self) -> None:
        self.run_study("a", a1=1, a2=1, b1=2)
        self.assertEqual(self.tree.starts(), ["a1", "a2"])
        self.run_study("?1", a1=1, a2=1, b1=2)
        self.assertEqual(self.tree.starts(), ["a1", "a2", "b1"])
        status, printed = self.run_study("c", a1=1, b1=2)
        self.assertEqual(status, 1)
        self.assertIn("nothing is called 'c'; --list shows all runs; stages are a, b", printed)

    def test_incomplete_tables_do_not_replace_those_of_the_study(self) -> None:
        old = "run,value\na1,0.5\n"
        (self.tree.study / "results.csv").write_text(old)
        _, printed = self.run_study("a", a1=1, b1=2)
        self.assertEqual((self.tree.study / "results.csv").read_text(), old)
        self.assertIn("old", self.page.read_text())
        self.assertEqual((self.results / "results.csv").read_text(), "run,value\na1,1.0\n")
        self.assertIn("1 of 2 runs are there; tables are in", printed)

    def test_failed_runs_do_not_replace_tables(self) -> None:
        old = "run,value\na1,0.5\n"
        (self.tree.study / "results.csv").write_text(old)
        options = ["--results", str(self.results), "--build", str(self.tree.build)]
        one = self.tree.case("a1")
        bad = self.tree.case("bad", fail="it broke")

        def evaluate(runs: Runs, output: Output) -> list[str]:
            output.path("results.csv").write_text("new")
            return []

        for name, cases, kept in (
            ("a run failed", [one, bad], True),
            ("all runs failed", [replace(bad, may_fail=True)], True),
            ("a failure is a result", [one, replace(bad, may_fail=True)], False),
        ):
            study = Study(self.tree.study, cases, evaluate)
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
                run_study(study, options)
            text = (self.tree.study / "results.csv").read_text()
            self.assertEqual(text, old if kept else "new", name)

    def test_interrupted_evaluation_replaces_nothing(self) -> None:
        old = "run,value\na1,0.5\n"
        (self.tree.study / "results.csv").write_text(old)
        options = ["--results", str(self.results), "--build", str(self.tree.build)]

        def evaluate(runs: Runs, output: Output) -> list[str]:
            output.path("results.csv").write_text("new")
            raise ResultsError("the second table cannot be made")

        study = Study(self.tree.study, [self.tree.case("a1")], evaluate)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(run_study(study, options), 1)
        self.assertEqual((self.tree.study / "results.csv").read_text(), old)

    def test_complete_tables_have_their_provenance(self) -> None:
        status, _ = self.run_study(a1=1, b1=2)
        self.assertEqual(status, 0)
        page = self.page.read_text()
        self.assertIn("<!-- written by the study -->\n\n2 runs\n\n<!-- end -->\n\nAfter.\n", page)
        origins = {row["file"]: row for row in read_rows(self.tree.study / "provenance.csv")}
        self.assertEqual(set(origins), {"README.md", "results.csv"})
        origin = origins["results.csv"]
        self.assertRegex(origin["program"], r"^furrow [0-9a-f]{12}$")
        self.assertRegex(origin["runs"], r"^\d{4}-\d\d-\d\d")
        self.assertNotIn(str(self.tree.root), origin["command"])

    def test_provenance_of_other_files_is_kept(self) -> None:
        path = self.tree.study / "provenance.csv"
        head = "file,program,commit,runs,written,command,note"
        path.write_text(f"# ours\n{head}\nphoto.png,camera,,,2020-01-01,,by hand\n")
        self.run_study(a1=1)
        text = path.read_text()
        self.assertIn("photo.png,camera,,,2020-01-01,,by hand", text)
        self.assertTrue(text.startswith("# ours\n"))

    def test_rows_of_some_runs_replace_the_stored_ones(self) -> None:
        stored = self.tree.study / "results.csv"
        stored.write_text("run,value,note\na1,7,old\nb1,8,old\n")
        head = "file,program,commit,runs,written,command,note"
        provenance = self.tree.study / "provenance.csv"
        provenance.write_text(f"{head}\nresults.csv,furrow 0,abc,2020-01-01,2020-01-01,,\n")
        page = self.page.read_text()
        self.run_study("a1", "--merge", a1=1, b1=2, c1=3)
        self.assertEqual(
            [(row["run"], float(row["value"]), row["note"]) for row in read_rows(stored)],
            [("a1", 1.0, ""), ("b1", 8.0, "old")],
        )
        (origin,) = read_rows(provenance)
        self.assertTrue(origin["program"].startswith("furrow 0; furrow "))
        self.assertTrue(origin["runs"].startswith("2020-01-01 to "))
        self.assertEqual(self.page.read_text(), page)
        self.run_study("c1", "--merge", a1=1, b1=2, c1=3)  # a run that had no row
        self.assertEqual([row["run"] for row in read_rows(stored)], ["a1", "b1", "c1"])

    def test_all_rows_of_a_run_are_replaced(self) -> None:
        table = self.tree.study / "modes.csv"
        table.write_text("run,mode\na1,1\na1,2\nb1,1\nb1,2\n")
        fresh = [{"run": "c1", "mode": 1}, {"run": "a1", "mode": 3}]
        found = [(row["run"], str(row["mode"])) for row in merged(table, fresh)]
        self.assertEqual(found, [("a1", "3"), ("b1", "1"), ("b1", "2"), ("c1", "1")])

    def test_rows_join_by_their_run_in_any_column(self) -> None:
        table = self.tree.study / "error.csv"
        table.write_text("change,run,value\nbase,a1,1\ncells,b1,2\n")
        found = [row["value"] for row in merged(table, [{"change": "cells", "run": "b1", "value": 3}])]
        self.assertEqual(found, ["1", 3])

    def test_table_without_new_rows_is_kept(self) -> None:
        table = self.tree.study / "meshes.csv"
        table.write_text("mesh,value\nfine,1\n")
        self.assertEqual(merged(table, []), [{"mesh": "fine", "value": "1"}])

    def test_new_table_by_run_joins_the_others(self) -> None:
        page = self.page.read_text()
        self.run_study("a1", "--merge", a1=1, b1=2)
        stored = read_rows(self.tree.study / "results.csv")
        self.assertEqual(stored, [{"run": "a1", "value": "1.0"}])
        self.assertEqual(self.page.read_text(), page)

    def test_file_of_all_runs_is_written_completely(self) -> None:
        stored = self.tree.study / "sums.csv"
        stored.write_text("case,value\nall,1\nold,2\n")
        with Output(self.tree.study, page=False, merge=True) as output:
            output.table(output.of_all_runs("sums.csv"), [{"case": "all", "value": 3}])
            output.publish([], self.tree.study)
        self.assertEqual(read_rows(stored), [{"case": "all", "value": "3"}])

    def test_missed_limit_fails_in_a_check_alone(self) -> None:
        status, printed = self.run_study(low=0.5)
        self.assertEqual(status, 0)
        self.assertIn("MISSED: low is below 1", printed)
        status, _ = self.run_study("--check", low=0.5)
        self.assertEqual(status, 1)

    def test_check_writes_to_the_results_folder(self) -> None:
        status, _ = self.run_study("--check", a1=1)
        self.assertEqual(status, 0)
        self.assertFalse((self.tree.study / "results.csv").exists())
        self.assertTrue((self.results / "results.csv").exists())

    def test_check_fails_without_its_runs(self) -> None:
        status, printed = self.run_study("--check", "--evaluate", a1=1)
        self.assertEqual(status, 1)
        self.assertIn("MISSED: a1 was not run", printed)

    def test_failed_run_is_an_error_unless_it_is_a_result(self) -> None:
        bad = self.tree.case("bad", fail="it broke")
        options = ["--results", str(self.results), "--build", str(self.tree.build)]
        for may_fail, expected in ((False, 1), (True, 0)):
            case = replace(bad, may_fail=may_fail)
            study = Study(self.tree.study, [case], lambda runs, output: [])
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
                self.assertEqual(run_study(study, options), expected)
            self.assertIn("FAILED: bad: ERROR: it broke", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
