# SPDX-License-Identifier: GPL-2.0-or-later
"""The verdict on the screen; summary_test.cpp has its words and its length."""

import json
import unittest

from furrow_post.scene.scene_summary import verdict_line
from support.folder import FolderTest
from support.runs import write_run

STEADY = "steady, resistance coefficient 0.200 ± 0.010"


class VerdictTest(FolderTest):
    def test_verdict_is_that_of_the_summary(self) -> None:
        write_run(self.folder)
        file = self.folder / "summary.json"
        file.write_text(json.dumps({**json.loads(file.read_text()), "verdict": STEADY}))
        self.assertEqual(verdict_line(self.folder, quick=False), f"Verdict: {STEADY}")

    def test_a_quick_run_is_too_short(self) -> None:
        line = verdict_line(self.folder, quick=True)
        self.assertEqual(line, "Verdict: quick run, too short for steady values")


if __name__ == "__main__":
    unittest.main()
