# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that studies take from their runs: the ratio of their costs."""

import math
import unittest

from furrow_post.analyse.evaluations import cost_ratio


class CostRatioTest(unittest.TestCase):
    PAIRS = [("dear_1", "cheap_1"), ("dear_2", "cheap_2"), ("dear_3", "cheap_3")]

    def test_mean_of_the_pairs_with_its_standard_error(self) -> None:
        seconds = {"dear_1": 20.0, "cheap_1": 10.0, "dear_2": 40.0, "cheap_2": 10.0, "dear_3": 5.0}
        (row,) = cost_ratio("dear over cheap", seconds, self.PAIRS)  # the third pair is incomplete
        self.assertEqual((row["run"], row["pairs"], row["ratio"]), ("dear over cheap", 2, 3.0))
        self.assertEqual(row["ratio_error"], round(math.sqrt(2) / math.sqrt(2), 3))

    def test_single_pair_has_no_error(self) -> None:
        self.assertEqual(cost_ratio("", {"dear_1": 30.0, "cheap_1": 9.0}, self.PAIRS), [])


if __name__ == "__main__":
    unittest.main()
