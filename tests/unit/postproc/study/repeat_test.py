# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post study: which values its tests repeat, what a study costs, what the command says."""

import re
import tempfile
import unittest
from pathlib import Path

from furrow_post.cli.study_command import study_folders
from furrow_post.errors import ResultsError
from furrow_post.study.repeat import difference, known_cost
from furrow_post.study.values import TABLE, Part, Registry, Stored, StudyValue, values_of
from support.command import SOURCE, run_post
from support.folder import FolderTest

VALIDATION = SOURCE / "inputs" / "validation"
# Studies that check one of their runs with another: a coarse mesh with the fine one, one rig with the other
OWN_CHECKS = {"free_travel", "tyre_brick"}


class GuardTest(FolderTest):
    """Every value has a command that makes it and a test that repeats it."""

    def test_every_value_is_repeated(self) -> None:
        """By a test of seconds in tests/run, or by one of hours under the label study."""
        declared = (SOURCE / "tests" / "CMakeLists.txt").read_text(encoding="utf-8")
        lists = re.findall(r"(?:set|list)\((?:APPEND )?cheap_studies ([\w ]+)\)", declared)
        tested = {study for names in lists for study in names.split()}
        cheap = {value.study for value in Registry.of(SOURCE) if value.cheap}
        self.assertEqual(tested - OWN_CHECKS, cheap)
        self.assertIn("file(GLOB studies CONFIGURE_DEPENDS RELATIVE", declared)
        made = {folder.name for folder in study_folders(SOURCE)}
        for value in Registry.of(SOURCE):
            if value.stored:
                self.assertIn(value.study, made)
                self.assertTrue((value.stored.table.parent / "README.md").is_file())

    def test_studies_within_the_report_have_values(self) -> None:
        named = {value.study for value in Registry.of(SOURCE) if value.stored}
        made = {folder.name for folder in study_folders(SOURCE) if folder.parent == VALIDATION}
        self.assertEqual(named | {"cmu_sand", "free_travel", "grains", "predictions", "pull_slip", "tyre_formulas"}, made)

    def test_cheap_values_take_seconds(self) -> None:
        for folder in study_folders(SOURCE):
            costs = [v.cost.read() for v in values_of(folder) if v.cheap and v.cost]
            self.assertLessEqual(sum(costs), 30.0, folder.name)

    def test_missing_stored_files_are_reported(self) -> None:
        stored, made = self.folder / "stored", self.folder / "made"
        for folder, text in ((stored, "run,z,e,f\na,1.0,0.1,0.01\n"), (made, "")):
            folder.mkdir()
            (folder / "results.csv").write_text(text, encoding="utf-8")
        ours = Stored(stored / "results.csv", {"run": "a"}, "z")
        value = StudyValue("study.z", ours, reference=1.1)
        known = Stored(ours.table, ours.row, "f")
        limit = StudyValue("study.z", ours, error=(Part(TABLE, known),), reference=1.1, limit="upper")
        noisy = StudyValue("study.z", ours, error=(Part(TABLE, Stored(ours.table, ours.row, "e")),), reference=1.1)
        for number, (again, given, expected) in enumerate((
            ("1.02", value, ""),
            ("1.04", value, "1.04, not 1 ± 0.03"),
            ("1.04", noisy, ""),
            ("0.5", limit, ""),
            ("1.2", limit, "1.2 is missed, not met"),
        )):
            folder = self.folder / str(number)
            folder.mkdir()
            text = f"run,z,e,f\na,{again},0.1,0.01\n"
            (folder / "results.csv").write_text(text, encoding="utf-8")
            with self.subTest(again=again):
                self.assertEqual(difference(given, folder), expected)
        (made / "results.csv").write_text("run,z\nb,1\n", encoding="utf-8")
        with self.assertRaisesRegex(ResultsError, "0 rows have"):
            difference(value, made)


class CostTest(unittest.TestCase):
    """Core seconds of a study, from its stored tables."""

    def cost(self, tables: dict[str, str]) -> float:
        with tempfile.TemporaryDirectory() as temporary:
            for name, text in tables.items():
                (Path(temporary) / name).write_text(text, encoding="utf-8")
            return known_cost(Path(temporary))

    def test_cost_counts_each_run_once(self) -> None:
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


class CommandTest(unittest.TestCase):
    def test_studies_are_listed_and_unknown_ones_refused(self) -> None:
        done = run_post("study", folder=SOURCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"snow_plate +about [\d.]+ min of one core in all")
        done = run_post("study", "snow_plates", folder=SOURCE)
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no study 'snow_plates'; there are", done.stderr)

    def test_runs_of_a_study_are_listed(self) -> None:
        with tempfile.TemporaryDirectory() as results:
            done = run_post("study", "snow_oedometer", "--list", "--results", results, folder=SOURCE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"missing +fresh_snow\b")


if __name__ == "__main__":
    unittest.main()
