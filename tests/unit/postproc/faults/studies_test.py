# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies: what a user gets wrong, and results of runs that somebody damaged or removed."""

import os
import shutil
import tempfile
import unittest
from pathlib import Path

from furrow_post.cli.study_command import study_folders
from furrow_post.run.executor import PROGRAM, Executor
from furrow_post.run.process import ERRORS, SCREEN
from furrow_post.run.tools import OTHERS, Tools
from furrow_post.run.record import Record
from furrow_post.study.study import Study
from furrow_post.tables.engine import load_study
from support.command import SOURCE
from support.evaluation import run_study
from support.faults import FaultsTest, outcome

INPUTS = SOURCE / "inputs"
STUDIES = study_folders(SOURCE)
FILES = ("history.h5", "terrain.h5", "curve.txt", "facts.txt", "summary.json", "point.csv")

# (words, error)
WORDS = (
    ("no_such_run", "nothing is called 'no_such_run'; --list shows all runs"),
    ("--build=none", "there is no program"),
    ("--results=/proc/x", "/proc/x: no such file or directory; check path and rights"),
)
NEEDS_NO_RUNS = {"tyre_table6", "validation"}  # results on the screen of a run; tables of other studies
COMPARES = "second_opinion"  # evaluated with OTHERS, CalculiX first, which a machine need not have


def forge(study: Study, results: Path, content: str | None) -> None:
    """Folders of finished runs, of all cases but one, with this in every file, or without files."""
    executor = Executor(results, Tools.of(study.folder))
    for case in study.cases[:-1]:
        folder = results / case.name
        folder.mkdir(parents=True, exist_ok=True)
        inputs = executor.digests_now(case)
        record = Record(case.identity(executor.tools.root), inputs.pop(PROGRAM), inputs, "", "2026-01-01T00:00:00Z", 1.0, 1.0, 0.1)
        record.write(folder)
        for name in (SCREEN, ERRORS):
            (folder / name).write_text("")
        for name in FILES if content is not None else ():
            (folder / name).write_text(content or "")


class StudiesFaultsTest(FaultsTest):
    def test_wrong_arguments_are_refused(self) -> None:
        study = load_study(INPUTS / "crosscheck")
        for word, message in WORDS:
            self.expect(word, outcome(lambda: run_study(study, [word])), message)

    def test_folders_without_results_are_refused(self) -> None:
        for folder in STUDIES:
            study = load_study(folder)
            if folder.name in NEEDS_NO_RUNS:
                continue
            absent = folder.name == COMPARES and not shutil.which("ccx")
            for content in (None, "junk\n"):
                with tempfile.TemporaryDirectory() as results:
                    forge(study, Path(results), content)
                    words = ["--evaluate", "--results", results]
                    found = outcome(lambda: run_study(study, words))
                    self.expect(f"{folder.name}: {content}", found, OTHERS["ccx"] if absent else results)
        self.assertEqual(len(STUDIES), 29)
        self.assertNotIn("FURROW_TRACEBACK", os.environ)


if __name__ == "__main__":
    unittest.main()
