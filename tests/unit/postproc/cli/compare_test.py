# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compare and report on made runs with known answers; refusals."""

import csv
import unittest
from html.parser import HTMLParser
from subprocess import CompletedProcess
from typing import Any

import h5py

from furrow_post.uncertainty import cost_table
from furrow_post.csv_table import read_rows
from support.command import run_post
from support.folder import SharedFolderTest
from support.laboratory import write_plate
from support.runs import add_parts, write_run


class Balanced(HTMLParser):
    """Counts images and follows which elements are open."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.images = 0

    def handle_startendtag(self, tag: str, attrs: Any) -> None:
        self.images += tag == "img"

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag, tag


class CompareCommandTest(SharedFolderTest):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        write_run(cls.folder / "a")
        add_parts(cls.folder / "a", {"compaction": 150.0, "friction of wheel and ground": 50.0})
        write_run(cls.folder / "b", sinkage=0.051)
        write_run(cls.folder / "heavy", load=1100.0)

    def run_post(self, *arguments: object) -> "CompletedProcess[str]":
        return run_post(*arguments, folder=self.folder)

    def test_other_load_is_refused_with_the_reason(self) -> None:
        done = self.run_post("compare", "a", "heavy", "-o", "refused")
        self.assertEqual(done.returncode, 1)
        self.assertIn(
            "these runs are not comparable:\n"
            "  load: a: 1000 N; heavy: 1100 N (they may differ by 2 %)",
            done.stderr,
        )
        self.assertFalse((self.folder / "refused").exists())
        done = self.run_post("compare", "a", "heavy", "-o", "anyway", "--anyway")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("COMPARED ALTHOUGH CONDITIONS DIFFER", done.stdout)

    def test_compare_writes_table_and_figure(self) -> None:
        done = self.run_post("compare", "one=a", "two=b", "-o", "both")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Inconclusive in hub drop and resistance coefficient; unknown: size of", done.stdout)
        self.assertIn("two - one = +1 mm (+2 %), 19 allowed by the known parts", done.stdout)
        self.assertIn("To find what is unknown\n  - size of cells or grains (one, two): ", done.stdout)
        lines = read_rows(self.folder / "both" / "compare.csv")
        self.assertEqual(
            [(line["quantity"], line["source"], float(line["value"])) for line in lines[:3]],
            [
                ("hub drop", "one", 0.05),
                ("resistance coefficient", "one", 0.2),
                ("hub drop", "two", 0.051),
            ],
        )
        self.assertEqual(lines[0]["u_size"], "")  # not known is not zero
        with h5py.File(self.folder / "both" / "compare.h5", "r") as content:
            self.assertAlmostEqual(content["runs/two/history/hub_drop"][-1], 0.051)
        self.assertGreater((self.folder / "both" / "compare.png").stat().st_size, 20000)

    def test_plates_are_compared_at_equal_sinkage(self) -> None:
        write_plate(self.folder / "soft", 1e6)
        write_plate(self.folder / "stiff", 1.5e6)
        write_plate(self.folder / "large", 1e6, size=0.2)
        done = self.run_post("compare", "soft", "stiff", "-o", "plates")
        self.assertEqual(done.returncode, 0, done.stderr)
        message = "stiff over soft: +50 % on average, rms ln-ratio 0.405"
        self.assertIn(message, done.stdout)
        self.assertIn("Inconclusive in pressure at equal sinkage; unknown: domain of soft, ", done.stdout)
        self.assertIn("  - size of cells or grains (soft, stiff): ", done.stdout)
        with open(self.folder / "plates" / "compare.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.assertEqual([float(r["level"]) for r in rows], [0.0025, 0.005, 0.01, 0.015])
        self.assertAlmostEqual(float(rows[2]["soft"]), 1e4, delta=10)
        done = self.run_post("compare", "soft", "large", "-o", "refused")
        self.assertEqual(done.returncode, 1)
        self.assertIn(
            "these tests are not comparable:\n"
            "  size: soft: 0.1; large: 0.2 (they may differ by 2 %)",
            done.stderr,
        )

    def test_report_is_one_page(self) -> None:
        done = self.run_post("report", "one=a", "two=b", "-o", "page/report.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "page" / "report.html").read_text(encoding="utf-8")
        parser = Balanced()
        parser.feed(text.replace("<!DOCTYPE html>", ""))
        self.assertEqual(parser.open, [])
        self.assertEqual(parser.images, 4)  # compared, what a resistance is made of, two runs
        self.assertEqual(text.count("<h2>What the resistance is made of</h2>"), 1)
        self.assertNotIn('src="http', text)
        self.assertNotIn(str(self.folder), text)  # no path of this machine
        for name in ("report.csv", "report.h5"):
            self.assertTrue((self.folder / "page" / name).is_file())

    def test_cost_writes_figure_and_table(self) -> None:
        done = self.run_post("cost", "a", "b", "--write", "runs.csv", "-o", "cost.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("grains, ground unknown", done.stdout)
        rows, _ = cost_table.read_table(self.folder / "runs.csv")
        self.assertEqual([row.run for row in rows], ["a", "b"])


if __name__ == "__main__":
    unittest.main()
