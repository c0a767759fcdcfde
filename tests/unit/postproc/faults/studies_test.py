# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies: what a user gets wrong, and results of runs that somebody damaged or removed."""

import importlib
import os
import sys
import tempfile
import unittest
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from unittest import mock

from furrow_post.study import study as module
from furrow_post.study.definition import load_study
from furrow_post.study.launch import ERRORS, SCREEN, Tools
from furrow_post.study.record import Record
from furrow_post.study.study import Study, run_study
from support.command import SOURCE
from support.faults import FaultsTest, outcome

INPUTS = SOURCE / "inputs"
OTHERS = (INPUTS / "crosscheck" / "run.py", INPUTS / "costs" / "run.py")
STUDIES = (*OTHERS, *(file.parent for file in sorted(INPUTS.glob("*/*/evaluate.py"))))
FILES = ("history.h5", "terrain.h5", "curve.txt", "facts.txt", "summary.json", "point.csv")

# (words, what is said)
WORDS = (
    ("no_such_run", "nothing is called 'no_such_run'; --list shows all runs"),
    ("", "argument NAME: is empty"),
    ("--jobs=0", "argument --jobs: 0 is below 1"),
    ("--jobs=all", "argument --jobs: 'all' is not a whole number"),
    ("--build=none", "there is no program"),
    ("--build=", "argument --build: is empty"),
    ("--results=", "argument --results: is empty"),
    ("--results=/proc/x", "/proc/x: no such file or directory; check path and rights"),
)
NEEDS_NO_RUNS = {"tyre_table6"}  # its results are on the screen of a run: a run without is missed


@contextmanager
def study_of(driver: Path) -> Iterator[Study]:
    """The study of a folder with a study.yaml, or of a driver, with the modules of its folder."""
    if driver.is_dir():
        yield load_study(driver)
        return
    known = set(sys.modules)
    found: list[Study] = []

    def keep(study: Study, arguments: object = None) -> int:
        found.append(study)
        return 0

    with mock.patch.object(sys, "path", [str(driver.parent), *sys.path]):
        code = compile(driver.read_text(encoding="utf-8"), driver, "exec")
        with mock.patch.object(module, "run_study", keep):
            with suppress(SystemExit):
                exec(code, {"__name__": "__main__", "__file__": str(driver)})
        yield found[0]
    for name in set(sys.modules) - known:
        if str(driver.parent) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]
    importlib.invalidate_caches()


def forge(study: Study, results: Path, content: str | None) -> None:
    """Folders of finished runs, of all cases but one, with this in every file, or without files."""
    root = Tools.of(study.file).root
    for case in study.cases[:-1]:
        folder = results / case.name
        folder.mkdir(parents=True, exist_ok=True)
        record = Record(case.identity(root), "", {}, "", "2026-01-01T00:00:00Z", 1.0, 1.0, 0.1)
        record.write(folder)
        for name in (SCREEN, ERRORS):
            (folder / name).write_text("")
        for name in FILES if content is not None else ():
            (folder / name).write_text(content or "")


class StudiesFaultsTest(FaultsTest):
    def test_words(self) -> None:
        with study_of(OTHERS[0]) as study:
            for word, message in WORDS:
                self.expect(word, outcome(lambda: run_study(study, [word])), message)

    def test_results_that_are_no_results(self) -> None:
        for driver in STUDIES:
            with study_of(driver) as study:
                if study.folder.name in NEEDS_NO_RUNS:
                    continue
                for content in (None, "junk\n"):
                    with tempfile.TemporaryDirectory() as results:
                        forge(study, Path(results), content)
                        words = ["--evaluate", "--results", results]
                        found = outcome(lambda: run_study(study, words))
                        self.expect(f"{study.folder.name}: {content}", found, results)
        self.assertEqual(len(STUDIES), 22)
        self.assertNotIn("FURROW_TRACEBACK", os.environ)


if __name__ == "__main__":
    unittest.main()
