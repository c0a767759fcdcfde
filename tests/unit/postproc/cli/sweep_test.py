# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post sweep as a user starts it."""

import unittest

from support.command import run_post
from support.folder import FolderTest
from support.runs import write_run


class SweepCommandTest(FolderTest):
    def test_sweep_lists_folders_of_runs_and_refuses_faults(self) -> None:
        for ground, sinkage in (("soft", 0.05), ("hard", 0.02)):
            for load in (1000.0, 2000.0):
                write_run(self.folder / ground / f"load_{load:g}", load, sinkage)
        done = run_post("sweep", "soil=soft", "hard", "-o", "out", folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"soil +1 +0.20 ± 0.18 +50 ± 7 +yes")
        self.assertRegex(done.stdout, r"hard +2 +0.200 ± 0.010 +20.0 ± 1.0 +yes")
        self.assertTrue((self.folder / "out" / "report.html").is_file())
        for words, message in (
            (("soft", "soft"), "is given twice"),
            (("none",), "none: is no folder"),
            (("soft", "--against", "age"), "has no age; --against takes"),
            (("soft", "--measured", "x.csv"), "x.csv: no such file"),
            (("soft", "--formula", "x"), "there is no formula 'x'"),
        ):
            done = run_post("sweep", *words, folder=self.folder)
            self.assertEqual(done.returncode, 1, words)
            self.assertIn(message, done.stderr)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
