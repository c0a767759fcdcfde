# SPDX-License-Identifier: GPL-2.0-or-later
"""The result on the screen: whole errors, and the verdict as the last line; summary_test.cpp has that of a program."""

import json
import math
import unittest
from typing import Any

from furrow_post.run.reader import read_row
from furrow_post.run.summary import BUDGET
from furrow_post.scene.scene_summary import result_lines, verdict_line
from support.folder import FolderTest
from support.runs import write_run


class VerdictTest(FolderTest):
    def write(self, **changes: object) -> None:
        write_run(self.folder, torque=100.0)
        file = self.folder / "summary.json"
        content: dict[str, Any] = {**json.loads(file.read_text()), "verdict": "steady, of the program", "reasons": [], **changes}
        content["quantities"]["net_traction_coefficient"] = {**content["quantities"]["resistance_coefficient"], "mean": -0.2}
        file.write_text(json.dumps(content))

    def test_last_line_has_the_total_error(self) -> None:
        self.write()
        last = result_lines(self.folder, quick=False)[-1]
        self.assertRegex(last, r"^Verdict: steady, net traction coefficient -0\.\d+ ± 0\.\d+, hub drop \d+ ± \d+ mm$")
        self.assertLessEqual(len(last), 100)
        stored = json.loads((self.folder / BUDGET).read_text())["net_traction_coefficient"]
        self.assertGreater(stored["error"], 5 * 0.01)  # over time
        self.assertAlmostEqual(stored["error"], math.hypot(*(part or 0.0 for part in stored["parts"].values())))
        self.assertIsNone(stored["parts"]["material"])
        row = read_row(self.folder)
        self.assertEqual(row.cells["net_traction_coefficient_whole_error"], stored["error"])
        self.assertEqual(row.cells["net_traction_coefficient_error"], 0.01)
        self.assertEqual(row.units["hub_drop_whole_error"], "m")

    def test_reasons_and_warnings_are_shown(self) -> None:
        self.write(reasons=["slip: it drifts"], warnings=["the ground is narrow"])
        lines = result_lines(self.folder, quick=False)
        self.assertIn("Not steady: slip: it drifts", lines)
        self.assertIn("WARNING: the ground is narrow", lines)

    def test_quick_run_is_too_short(self) -> None:
        self.write()
        self.assertEqual(verdict_line(self.folder, quick=True), "Verdict: quick run, too short for steady values")

    def test_run_without_values_prints_the_verdict_of_the_program(self) -> None:
        (self.folder / "summary.json").write_text(json.dumps({"verdict": "no steady values, the wheel digs in"}))
        self.assertEqual(result_lines(self.folder, quick=False)[-1], "Verdict: no steady values, the wheel digs in")


if __name__ == "__main__":
    unittest.main()
