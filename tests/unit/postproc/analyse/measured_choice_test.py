# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of errors against a measurement: what is chosen, why, and what such a table needs."""

import tempfile
import unittest
from pathlib import Path

from furrow_post.analyse import measured_choice
from furrow_post.errors import ResultsError

HEAD = "run,wheel,area_error,section_width_error,cpu_time,options\n"
TABLE = (
    "# measured: the print\n"
    + HEAD
    + "a,simple,0.05,0.18,1,plane -v mesh '4 36'\n"
    + "b,simple,0.15,0.05,30,plane\n"
    + "c,rich,0.11,0.02,20,rich\n"
    + "d,rich,0.03,0.08,100,rich -v n 2\n"
)


def read(text: str) -> list[measured_choice.Compared]:
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "table.csv"
        table.write_text(text, encoding="utf-8")
        return measured_choice.read_compared(table)


class MeasuredChoiceTest(unittest.TestCase):
    def test_the_cheapest_whose_errors_are_all_within(self) -> None:
        runs = read(TABLE)
        for error, expected in ((0.2, "a"), (0.18, "a"), (0.15, "c"), (0.1, "d"), (0.01, "d")):
            with self.subTest(error=error):
                self.assertEqual(measured_choice.recommend(runs, error).run, expected)

    def test_it_says_why_no_other_wheel(self) -> None:
        runs = read(TABLE)
        for error, expected in (
            (
                0.15,
                "For 15 % error against the print use rich (c): area 11.0 %, section width 2.0 %; "
                "20 s of one core.\n"
                "  not simple, dearer: simple (b): area 15.0 %, section width 5.0 %; "
                "30 s of one core",
            ),
            (
                0.01,
                "No run of the table reaches 1 % against the print; the best is rich (d): area "
                "3.0 %, section width 8.0 %; 100 s of one core.\n"
                "  not simple, at best: simple (b): area 15.0 %, section width 5.0 %; "
                "30 s of one core",
            ),
        ):
            with self.subTest(error=error):
                said = measured_choice.reasons(runs, error, "the print")
                self.assertEqual("\n".join(said), expected)

    def test_the_comment_names_the_measurement(self) -> None:
        self.assertEqual(measured_choice.measurement(["# x", "# measured: Table 6"]), "Table 6")
        self.assertEqual(measured_choice.measurement(["# reference: fine cells"]), "fine cells")
        self.assertEqual(measured_choice.measurement(["# wheel: tyre"]), "")

    def test_kinds_of_ground_stand_where_kinds_of_wheel_do(self) -> None:
        runs = read(TABLE.replace("run,wheel", "run,ground"))
        self.assertEqual([run.kind for run in runs], ["simple", "simple", "rich", "rich"])

    def test_bad_tables_are_refused(self) -> None:
        for text, expected in (
            (HEAD, "has no rows; columns are run, wheel or ground, NAME_error"),
            (HEAD + "a,w,0.1,-0.1,1,x\n", "run 'a' needs errors of 0 or more"),
            (HEAD + "a,w,0.1,nan,1,x\n", "run 'a' needs errors of 0 or more"),
            (HEAD + "a,w,0.1,,1,x\n", "could not convert"),
            (HEAD + "a,w,0.1,0.1,1,\n", "run 'a' has no options"),
            (HEAD + "a,w,0.1,0.1,nan,x\n", "run 'a' needs a cpu_time above 0"),
            ("run,wheel,cpu_time,options\na,w,1,x\n", "run 'a' needs errors"),
            ("run,area_error,cpu_time,options\na,0,1,x\n", "has no 'wheel'"),
        ):
            with self.subTest(text=text), self.assertRaisesRegex(ResultsError, expected):
                read(text)


if __name__ == "__main__":
    unittest.main()
