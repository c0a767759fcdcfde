# SPDX-License-Identifier: GPL-2.0-or-later
"""Operations on tables: packings, differences, size series, comparisons; expressions and their faults."""

import math
import unittest
from typing import Any


from furrow_post.errors import ResultsError
from furrow_post.tables.frames import frame_of, rows_of
from furrow_post.tables.operations import OPERATIONS, Known


def done(name: str, rows: list[dict[str, Any]], others: dict[str, Any] | None = None, **arguments: Any) -> list[dict[str, Any]]:
    tables = {key: frame_of(value) for key, value in (others or {}).items()}
    return rows_of(OPERATIONS[name](frame_of(rows), Known(tables, {}), **arguments))


class FramesTest(unittest.TestCase):
    def test_cells_are_read_back_unchanged(self) -> None:
        rows = [{"run": "a", "n": "3", "x": "0.50", "text": "10"}, {"run": "b", "n": "", "x": "1e-3", "text": "k"}]
        frame = frame_of(rows)
        self.assertEqual(list(frame["text"]), ["10", "k"])
        self.assertEqual(rows_of(frame)[1], {"run": "b", "n": "", "x": 0.001, "text": "k"})

    def test_empty_column_is_text(self) -> None:
        self.assertEqual(list(frame_of([{"failure": ""}, {"failure": ""}])["failure"]), ["", ""])


class PackingsTest(unittest.TestCase):
    ROWS = [{"change": "base", "value": 28.0}, {"change": "half", "value": 30.0}, {"change": "base", "value": 30.0}]

    def test_packings_give_mean_and_scatter(self) -> None:
        base, half = done("packings", self.ROWS, by="change")
        self.assertEqual((base["packings"], base["mean"], half["scatter"]), (2, 29.0, ""))
        self.assertAlmostEqual(base["scatter"], math.sqrt(2))

    def test_every_row_has_the_base_of_its_group(self) -> None:
        base, half = done("against", done("packings", self.ROWS, by="change"), base='change == "base"')
        self.assertEqual((half["mean"] - half["base_mean"], base["base_packings"]), (1.0, 2))
        self.assertEqual(done("against", self.ROWS, base='change == "none"'), [])


    def test_error_of_the_finest_grains_is_scatter_and_last_difference(self) -> None:
        rows = [{"d": d, "value": value} for d, value in ((0.05, 90.0), (0.05, 110.0), (0.07, 70.0))]
        (row,) = done("finest", rows, by=[], size="d")
        self.assertEqual(row["mean"], 100.0)
        self.assertAlmostEqual(row["error"], math.hypot(10, 30))

    def test_scatter_of_one_run_comes_from_pairs_of_one_point(self) -> None:
        rows = [{"h": 8.0, "f": -0.2}, {"h": 8.0, "f": -0.16}, {"h": 6.0, "f": 5.0}]
        found = done("pair_scatter", rows, by="h", values={"u": "f"})
        self.assertAlmostEqual(found[2]["u"], 0.04 / math.sqrt(2))

    def test_rows_of_a_group_share_a_column(self) -> None:
        found = done("transform", self.ROWS, by="change", columns={"n": "count", "middle": "value.mean()"})
        self.assertEqual([(row["n"], row["middle"]) for row in found], [(2, 29.0), (1, 30.0), (2, 29.0)])


class SeriesTest(unittest.TestCase):
    def test_power_law_is_extrapolated_to_zero_size(self) -> None:
        rows = [{"law": law, "h": h, "z": z + 0.1 * h, "z_error": 1e-4} for law, z in (("a", 1.0), ("b", 2.0)) for h in (8.0, 4.0, 2.0)]
        first, second = done("size_series", rows, by="law", size="h", values={"z": "z_error"})
        self.assertAlmostEqual(first["value"], 1.0, delta=2e-3)
        self.assertAlmostEqual(second["value"], 2.0, delta=2e-3)
        self.assertAlmostEqual(first["order"], 1.0, delta=0.02)
        self.assertEqual(done("size_series", rows[:2], size="h", values="z"), [])

    def test_points_are_compared_with_straight_lines(self) -> None:
        line = [{"rig": "a", "s": s, "s_error": 0.0, "p": 2 * s, "p_error": 0.03} for s in (0.0, 1.0)]
        points = [{"rig": "b", "s": 0.5, "s_error": 0.01, "p": 1.2, "p_error": 0.04}, {"rig": "b", "s": 1.5, "s_error": 0, "p": 9, "p_error": 0}]
        (row,) = done("off_curve", [*line, *points], x="s", by="rig", base='rig == "a"', values=["p"])
        self.assertAlmostEqual(row["difference"], 0.2)
        self.assertAlmostEqual(row["difference_error"], math.hypot(0.015, 0.015, 0.02, 0.04))


class TablesTest(unittest.TestCase):
    def test_columns_of_another_table_are_joined(self) -> None:
        (row,) = done("join", [{"p": 3, "z": 1.1}], {"reference.csv": [{"at": 3, "z": 1.0}]}, table="reference.csv", keys={"p": "at"}, prefix="measured_")
        self.assertEqual((row["z"], row["measured_z"]), (1.1, 1.0))

    def test_groups_keep_the_order_of_their_rows(self) -> None:
        rows = [{"law": "b", "off": 3.0}, {"law": "a", "off": 1.0}, {"law": "b", "off": -4.0}]
        found = done("summary", rows, by="law", columns={"n": "count", "rms": "round(rms(off), 3)"})
        self.assertEqual(found, [{"law": "b", "n": 2, "rms": 3.536}, {"law": "a", "n": 1, "rms": 1.0}])

    def test_columns_are_stacked_and_unstacked(self) -> None:
        rows = [{"run": "a", "first": 1, "second": 2}]
        long = done("stack", rows, keep="run", quantity=["first", "second"], value=["first", "second"])
        self.assertEqual([row["value"] for row in long], [1, 2])
        long = [{"run": "a", "law": "x", "value": 1}, {"run": "a", "law": "y", "value": 2}]
        self.assertEqual(done("pivot", long, keep="run", columns="law"), [{"run": "a", "x": 1, "y": 2}])

    def test_table_is_transposed(self) -> None:
        found = done("transpose", [{"case": "a", "z": 1.5}, {"case": "b", "z": 2.5}], key="case")
        self.assertEqual(found, [{"quantity": "z", "a": 1.5, "b": 2.5}])

    def test_unknown_name_is_refused_with_the_existing_ones(self) -> None:
        with self.assertRaisesRegex(ResultsError, "column c: name 'speed' is not defined; known names are slip"):
            done("select", [{"slip": 1}], c="speed")
        with self.assertRaisesRegex(ResultsError, "'slip / 0' fails \\(division by zero\\)"):
            done("where", [{"slip": 1}], condition="slip / 0")


if __name__ == "__main__":
    unittest.main()
