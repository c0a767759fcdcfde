# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders as rows of a table."""

import json
import math
import unittest

from furrow_post.errors import ResultsError
from furrow_post.run.executor import Executor
from furrow_post.run.reader import read_row, read_table
from support.fake import FakeTree
from support.folder import FolderTest
from support.runs import write_run


class ReaderTest(FolderTest):
    def test_rows_have_variables_facts_cost_and_error(self) -> None:
        tree = FakeTree(self.folder)
        cases = [tree.case("a", value=2, ground="sand"), tree.case("b", fail="it broke")]
        executor = Executor(self.folder / "results", tree.tools)
        executor.run(cases)
        table = read_table(map(executor.folder, cases))
        self.assertEqual(list(table["folder"]), [str(executor.folder(case)) for case in cases])
        self.assertEqual((table["set_value"][0], table["set_ground"][0]), (2.0, "sand"))
        self.assertEqual(table["value"][0], 2.0)
        self.assertEqual(list(table["error"]), ["", "ERROR: it broke (made.cpp:1)"])
        self.assertTrue(math.isnan(table["value"][1]))
        self.assertGreater(table["wall_time"].min(), 0.0)
        self.assertEqual(table.attrs["units"], {"wall_time": "s", "cpu_time": "s"})

    def test_quantities_have_errors_and_units(self) -> None:
        write_run(self.folder)
        row = read_row(self.folder)
        stored = json.loads((self.folder / "summary.json").read_text())["quantities"]["hub_drop"]
        self.assertEqual(row.cells["hub_drop"], stored["mean"])
        self.assertEqual(row.cells["hub_drop_error"], stored["standard_error"])
        self.assertEqual(row.cells["hub_drop_steady"], stored["steady"])
        self.assertEqual((row.units["hub_drop"], row.units["hub_drop_error"]), (stored["unit"],) * 2)

    def test_row_has_the_facts_of_a_laboratory_test(self) -> None:
        (self.folder / "facts.txt").write_text("test plate ground sand bulk 1330\n")
        cells = read_row(self.folder).cells
        self.assertEqual((cells["test"], cells["bulk"]), ("plate", 1330.0))
        (self.folder / "facts.txt").write_text("test plate ground\n")
        with self.assertRaisesRegex(ResultsError, "facts.txt: cannot be used .*repeat the run"):
            read_row(self.folder)

    def test_folder_without_a_run_is_refused(self) -> None:
        with self.assertRaisesRegex(ResultsError, "has no run that came to its end"):
            read_row(self.folder)


if __name__ == "__main__":
    unittest.main()
