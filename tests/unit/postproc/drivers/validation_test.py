# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation: the table of all experiments is what the stored tables of the studies say."""

import contextlib
import io
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

from support.command import SOURCE

VALIDATION = SOURCE / "inputs" / "validation"
sys.path.insert(0, str(VALIDATION))

import command
import experiments
import guards
import overview
import programs

from furrow_post.errors import ResultsError
from furrow_post.study.provenance import read_origins
from overview import Experiment, Stored, number


# Of each other: a coarse mesh and the fine one, one rig and the other
OWN_CHECKS = {"validation.free_travel", "validation.tyre_brick"}


class _Missed:
    """Stands for the module guards."""

    @staticmethod
    def missed(study: str, made: Path, whole: bool) -> list[str]:
        return ["z is another"] if whole else []


class PageTest(unittest.TestCase):
    def test_page_is_what_the_command_writes(self) -> None:
        text = command.PAGE.read_text(encoding="utf-8")
        self.assertEqual(
            text, command.page_of(text), "run inputs/validation/run --table and look at the change"
        )

    def test_every_number_is_a_study_s_that_has_a_page(self) -> None:
        for group in experiments.GROUPS:
            for row in group.rows:
                with self.subTest(row=row.what, quantity=row.quantity):
                    for stored in (row.ours, row.cost, row.uncertainty, row.near):
                        if stored:
                            stored.value()
                            self.assertTrue((VALIDATION / stored.study / "README.md").is_file())
                    self.assertTrue(row.ours or row.remark, "a row that is not done says why")

    def test_what_differs_has_a_reason_and_a_page(self) -> None:
        for group in experiments.GROUPS:
            for row in group.rows:
                if row.verdict() in overview.UNMET:
                    with self.subTest(row=row.what, quantity=row.quantity):
                        shown = re.fullmatch(r".+ \((\w+)\)", row.why)
                        self.assertTrue(shown, f"a reason, and its study in brackets: {row.why!r}")
                        assert shown
                        self.assertTrue((VALIDATION / shown[1] / "README.md").is_file())
                        self.assertIn(row.why, row.cells()[-1])

    def test_one_number_a_cell(self) -> None:
        for group in experiments.GROUPS:
            for row in group.rows:
                cells = dict(zip(overview.HEAD, row.cells()))
                for column in ("report", "measured", "ours", "±", "difference %", "ours core s"):
                    text = cells[column].removeprefix("< ").removeprefix("> ")
                    if text:
                        float(text)

    def test_every_study_but_those_beyond_the_report_has_a_row(self) -> None:
        named = {
            row.ours.study for group in experiments.GROUPS for row in group.rows if row.ours
        }
        self.assertEqual(named | {"cmu_sand", "free_travel", "grains"}, set(command.studies()))


class ReasonsTest(unittest.TestCase):
    def test_each_reason_stands_once_with_its_rows(self) -> None:
        lacks = Experiment("p. 1", "", "", remark="no law has it")
        aside = Experiment("p. 3", "", "", remark="a method", aside=overview.OUTSIDE)
        drawn = Experiment("p. 4", "", "", remark="only drawn", aside=overview.NOTHING)
        group = overview.Group("", (lacks, replace(lacks, place="p. 2"), aside, drawn))
        self.assertEqual(
            overview.reasons([group])[2:],
            ["| no law has it | 2 not done | p. 1; p. 2 |", "| a method | 1 outside | p. 3 |"],
        )

    def test_every_row_that_is_not_met_is_among_them(self) -> None:
        unmet = (*overview.UNMET, overview.OUTSIDE, overview.NOT_DONE)
        lines = overview.reasons(experiments.GROUPS)[2:]
        counts = [int(word) for line in lines for word in re.findall(r"\d+", line.split(" | ")[1])]
        rows = [row for group in experiments.GROUPS for row in group.rows]
        self.assertEqual(sum(counts), sum(row.verdict() in unmet for row in rows))
        self.assertIn("missed", lines[0])


class ProgramsTest(unittest.TestCase):
    def test_commits_of_a_table_and_which_are_old(self) -> None:
        change = programs.Change("c", frozenset({"made"}), frozenset({"aaaaaaa"}))
        with tempfile.TemporaryDirectory() as folder, patch.object(
            programs, "changes", lambda: (change,)
        ):
            for study in ("made", "other"):
                (Path(folder) / study).mkdir()
                (Path(folder) / study / "provenance.csv").write_text(
                    "file,program,commit,runs,written,command,note\n"
                    "results.csv,furrow 1,aaaaaaa+ bbbbbbb aaaaaaa,,,,\nsize.csv,furrow 1,,,,,\n"
                )
            for path, expected in (
                ("made/results.csv", "aaaaaaa old, bbbbbbb"),
                ("other/results.csv", "aaaaaaa, bbbbbbb"),
                ("made/size.csv", ""),
                ("made/absent.csv", ""),
            ):
                with self.subTest(table=path):
                    self.assertEqual(programs.cell(Path(folder) / path), expected)

    def test_what_comes_before_a_change_is_what_git_says(self) -> None:
        """For the commits in provenance.csv of the studies that the change reaches."""

        def git(*words: str) -> int:
            done = subprocess.run(["git", "-C", str(SOURCE), *words], capture_output=True)
            return done.returncode

        if not shutil.which("git") or git("cat-file", "-e", programs.changes()[0].commit):
            self.skipTest("no git, or not the history")
        for change in programs.changes():
            for study in change.studies:
                origins = read_origins(VALIDATION / study).values()
                for commit in {
                    word.rstrip("+") for origin in origins for word in origin.commit.split()
                }:
                    with self.subTest(change=change.commit, study=study, commit=commit):
                        has = not git("merge-base", "--is-ancestor", change.commit, commit)
                        self.assertEqual(commit in change.before, not has)


class VerdictTest(unittest.TestCase):
    def setUp(self) -> None:
        self.temporary = tempfile.TemporaryDirectory()
        folder = Path(self.temporary.name)
        (folder / "made").mkdir()
        (folder / "made" / "results.csv").write_text("run,z\na,0.108\nb,0.100\nc,0.15\nd,\nd,1\n")
        self.patched = patch.object(overview, "HERE", folder)
        self.patched.start()

    def tearDown(self) -> None:
        self.patched.stop()
        self.temporary.cleanup()

    def stored(self, run: str, column: str = "z") -> Stored:
        return Stored("made/results.csv", {"run": run}, column, 100.0)

    def test_verdicts(self) -> None:
        row = Experiment("", "", "", ours=self.stored("a"))
        uncertain = replace(row, near=self.stored("c"))  # by 4.2
        limited = replace(row, limit=True)
        for expected, measured, given in (
            ("agrees", "10", row),
            ("near", "9", row),
            ("differs", "8", row),
            ("agrees", "8", uncertain),
            ("met", "11", limited),
            ("missed", "10", limited),
            ("met", "10", replace(row, floor=True)),
            ("missed", "11", replace(row, floor=True)),
            ("nothing to compare", "", row),
            ("not done", "10", replace(row, ours=None)),
            ("outside", "", replace(row, ours=None, aside=overview.OUTSIDE)),
        ):
            with self.subTest(expected=expected, measured=measured):
                self.assertEqual(replace(given, measured=measured).verdict(), expected)

    def test_measured_goes_before_the_report(self) -> None:
        row = Experiment("", "", "", report="8", measured="12", ours=self.stored("a"))
        self.assertEqual(row.cells()[overview.HEAD.index("difference %")], "-10")

    def test_what_is_not_stored_is_an_error_with_a_remedy(self) -> None:
        with self.assertRaisesRegex(ResultsError, "inputs/validation/run other makes it"):
            Stored("other/results.csv", {}, "z").value()
        with self.assertRaisesRegex(ResultsError, "2 rows have"):
            self.stored("d").value()
        with self.assertRaisesRegex(ResultsError, "no number in 'c'"):
            self.stored("a", "c").value()

    def test_numbers_have_no_exponent(self) -> None:
        self.assertEqual(
            [number(value) for value in (12345.6, 0.00123, 10.0, 0.15649)],
            ["12300", "0.00123", "10", "0.156"],
        )


class GuardTest(unittest.TestCase):
    """Every row of the table has a command that makes it and a test that repeats it."""

    def setUp(self) -> None:
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def test_every_row_is_guarded(self) -> None:
        """By a test of seconds in tests/run, or by one of hours under the label study."""
        declared = (SOURCE / "tests" / "CMakeLists.txt").read_text(encoding="utf-8")
        lists = re.findall(r"(?:set|list)\((?:APPEND )?cheap_studies ([\w ]+)\)", declared)
        cheap = {study for names in lists for study in names.split()}
        self.assertEqual(cheap, set(guards.CHEAP))
        self.assertIn("file(GLOB drivers CONFIGURE_DEPENDS RELATIVE", declared)
        tests = {f"validation.{study}" for study in cheap}
        tests |= {f"study.{study}" for study in command.studies()}
        found: set[str] = set()
        for group in experiments.GROUPS:
            for row in group.rows:
                if row.ours:
                    with self.subTest(row=row.what, command=f"run {row.ours.study}"):
                        self.assertIn(row.ours.study, command.studies())
                        self.assertIn(guards.guard(row), tests)
                        found.add(guards.guard(row))
        self.assertLessEqual({f"validation.{study}" for study in cheap} - found, OWN_CHECKS)

    def test_cheap_rows_cost_seconds(self) -> None:
        for study in guards.CHEAP:
            cheap = [row for row in guards.rows(study) if guards.is_cheap(row)]
            costs = [row.cost.value() for row in cheap if row.cost]
            self.assertLessEqual(sum(costs), 30.0, study)

    def test_what_is_no_longer_stored_is_found(self) -> None:
        stored, made = self.folder / "stored" / "study", self.folder / "made"
        for folder, text in ((stored, "run,z\na,1.0\n"), (made, "run,z\na,{}\n")):
            folder.mkdir(parents=True)
            (folder / "results.csv").write_text(text)
        ours = Stored("study/results.csv", {"run": "a"}, "z")
        row = Experiment("", "", "", report="1.1", ours=ours)
        limited = replace(row, limit=True)
        with patch.object(overview, "HERE", stored.parent):
            for again, given, expected in (
                ("1.02", row, ""),
                ("1.04", row, "1.04, not 1 ± 0.03"),
                ("0.5", limited, ""),
                ("1.2", limited, "1.2 is missed, not met"),
            ):
                (made / "results.csv").write_text(f"run,z\na,{again}\n")
                with self.subTest(again=again):
                    self.assertEqual(guards.difference(given, ours, made), expected)
            (made / "results.csv").write_text("run,z\nb,1\n")
            with self.assertRaisesRegex(ResultsError, "0 rows have"):
                guards.difference(row, ours, made)

    def test_the_command_counts_what_is_missed(self) -> None:
        words: list[str] = []

        def driver(study: str, *options: str) -> "subprocess.CompletedProcess[str]":
            words.extend(options)
            return subprocess.CompletedProcess([], 0)

        for name, replaced in (("driver", driver), ("guards", _Missed)):
            patched = patch.object(command, name, replaced)
            patched.start()
            self.addCleanup(patched.stop)
        with contextlib.redirect_stderr(io.StringIO()) as printed:
            self.assertEqual(command.check("a", True, self.folder, []), 1)
        self.assertEqual(words, ["--check", "*", "--results", str(self.folder)])
        self.assertEqual(printed.getvalue(), "MISSED: z is another\n")


class StudiesTest(unittest.TestCase):
    """Which studies the command makes; their drivers are replaced."""

    def setUp(self) -> None:
        self.made: list[str] = []
        self.listed = {
            "whole": "done a\ndone b\n",
            "half": "done a\nmissing b\n",
            "none": "missing a\n",
        }
        replaced = patch.multiple(command, driver=self.driver, known_cost=lambda study: 100.0)
        replaced.start()
        self.addCleanup(replaced.stop)

    def driver(self, study: str, *options: str) -> "subprocess.CompletedProcess[str]":
        if "--list" in options:
            return subprocess.CompletedProcess([], 0, stdout=self.listed[study])
        self.made.append(study)
        return subprocess.CompletedProcess([], 1 if study == "none" else 0)

    def test_only_what_is_missing_is_made(self) -> None:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            failed = command.make(list(self.listed), [])
        self.assertEqual(self.made, ["half", "none"])
        self.assertEqual(failed, 1)
        self.assertRegex(printed.getvalue(), r"half: about 2.5 min left\n.*none: about 100 s left")

    def test_list_says_how_many_runs_are_there(self) -> None:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            command.list_studies(["half"], [])
        self.assertRegex(printed.getvalue(), r"half +1 of +2 runs are there; about 100 s")
        self.assertEqual(self.made, [])

    def test_a_driver_that_does_not_start_is_an_error(self) -> None:
        broken = subprocess.CompletedProcess([], 2, stdout="")
        with patch.object(command, "driver", lambda *words: broken):
            with self.assertRaisesRegex(ResultsError, "half/run.py --list does not work"):
                command.missing("half", [])


class CostTest(unittest.TestCase):
    """Core seconds of a study, from its stored tables."""

    def cost(self, tables: dict[str, str]) -> float:
        with tempfile.TemporaryDirectory() as temporary:
            (Path(temporary) / "study").mkdir()
            for name, text in tables.items():
                (Path(temporary) / "study" / name).write_text(text)
            with patch.object(command, "HERE", Path(temporary)):
                return command.known_cost("study")

    def test_each_run_counts_once(self) -> None:
        results = "run,user_s\na,10\nb,5\n"
        for what, tables, expected in (
            ("a run of two tables", {"results.csv": results, "error.csv": "run,cpu_s\na,10\n"}, 15),
            ("rows of one run", {"stress.csv": "run,depth,user_s\na,1,7\na,2,7\n"}, 7),
            ("names of two families", {"x.csv": "family,run,cpu_s\nf,a,1\ng,a,2\n"}, 3),
            ("rows without a name", {"x.csv": "damping,user_s\n0,1\n100,2\n"}, 3),
            ("a column for each run", {"x.csv": "quantity,a,b\nz,8,9\nuser_s,1,2\n"}, 3),
            ("listed costs", {"costs.csv": results, "rolling.csv": "damping,user_s\n0,10\n"}, 15),
            ("no costs", {"x.csv": "run,z\na,1\n"}, 0),
        ):
            with self.subTest(what):
                self.assertEqual(self.cost(tables), expected)


if __name__ == "__main__":
    unittest.main()
