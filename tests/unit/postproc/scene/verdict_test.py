# SPDX-License-Identifier: GPL-2.0-or-later
"""The verdict on the screen: short for a quick run, positive where the main values are steady."""

import json
import unittest

from furrow_post.scene.verdict import summary_text
from support.folder import FolderTest
from support.runs import write_run

LONG = "not steady: the transient of force_x fills nearly half of the cruise"


class VerdictTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        write_run(self.folder)
        (self.folder / "summary.txt").write_text(f"hub drop 5\nVerdict: {LONG}\nWindow: 1 s\n")

    def not_steady(self, *names: str) -> None:
        file = self.folder / "summary.json"
        content = json.loads(file.read_text())
        for name in names:
            content["quantities"][name]["steady"] = False
        content["steady"] = not names
        file.write_text(json.dumps(content))

    def verdict(self, quick: bool = False) -> str:
        first, verdict, last = summary_text(self.folder, quick).splitlines()
        self.assertEqual((first, last), ("hub drop 5", "Window: 1 s"))
        return verdict.removeprefix("Verdict: ")

    def test_quick_run(self) -> None:
        self.assertEqual(self.verdict(quick=True), "quick run: too short for steady values")

    def test_all_steady(self) -> None:
        self.assertEqual(self.verdict(), "good: all values are steady")

    def test_main_values_steady(self) -> None:
        self.not_steady("slip")
        expected = "good: hub drop and resistance coefficient are steady; not steady: slip"
        self.assertEqual(self.verdict(), expected)

    def test_driven_wheel_is_judged_by_its_net_traction(self) -> None:
        write_run(self.folder, torque=5.0)
        self.assertEqual(self.verdict(), LONG)  # the summary has no net traction coefficient

    def test_main_value_not_steady(self) -> None:
        self.not_steady("hub_drop")
        self.assertEqual(self.verdict(), LONG)


if __name__ == "__main__":
    unittest.main()
