# SPDX-License-Identifier: GPL-2.0-or-later
"""What studies take from their runs: the ratio of the costs of repeated runs."""

import math
import unittest
from types import SimpleNamespace
from typing import Any

from furrow_post.analyse.evaluations import cost_ratio


def runs(**seconds: list[float]) -> Any:
    """Runs of a study that took these core seconds, by the beginning of their names."""

    def done(pattern: str) -> list[Any]:
        times = seconds.get(pattern.removesuffix("_*"), [])
        return [SimpleNamespace(record=SimpleNamespace(cpu_time=time)) for time in times]

    return SimpleNamespace(done=done)


class CostRatioTest(unittest.TestCase):
    def test_error_is_that_of_the_means(self) -> None:
        (row,) = cost_ratio(runs(dear=[30.0, 30.0], cheap=[9.0, 11.0]), "dear", "cheap")
        self.assertEqual((row["ratio"], row["repeats"]), (3.0, 2))
        # the standard error of the second mean is a tenth of it
        self.assertEqual(row["ratio_error"], round(3.0 * math.hypot(0.0, 0.1), 3))

    def test_one_timing_has_no_error(self) -> None:
        self.assertEqual(cost_ratio(runs(dear=[30.0], cheap=[9.0, 11.0]), "dear", "cheap"), [])


if __name__ == "__main__":
    unittest.main()
