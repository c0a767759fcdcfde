# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables for people and for files."""

import tempfile
import unittest
from pathlib import Path

from furrow_post.csv_table import aligned, markdown, read_comments, read_numbers, read_rows, write_rows
from furrow_post.errors import ResultsError

ROWS: list[dict[str, object]] = [{"run": "a", "value": 1 / 3}, {"run": "long", "error": "stopped"}]


class TablesTest(unittest.TestCase):
    def test_table_has_the_columns_of_all_rows(self) -> None:
        lines = aligned(ROWS).splitlines()
        self.assertEqual(lines[0].split(), ["run", "value", "error"])
        self.assertEqual(lines[1].split(), ["a", "0.333333"])
        self.assertEqual(len({len(line) for line in lines}), 1)

    def test_table_is_written_as_markdown(self) -> None:
        lines = markdown(["a", "b"], [["1", "2"]])
        self.assertEqual(lines, ["| a | b |", "|---|---|", "| 1 | 2 |"])

    def test_file_with_comments_is_read_back(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.csv"
            write_rows(path, ROWS, ["# made"])
            self.assertEqual(read_comments(path), ["# made"])
            self.assertEqual(read_rows(path)[1], {"run": "long", "value": "", "error": "stopped"})
            with self.assertRaisesRegex(ResultsError, "t.csv: could not convert"):
                read_numbers(path)


if __name__ == "__main__":
    unittest.main()
