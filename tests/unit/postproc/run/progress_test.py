# SPDX-License-Identifier: GPL-2.0-or-later
"""The line over all runs: what is done, and the time that is left."""

import tempfile
import unittest
from pathlib import Path

from furrow_post.run.process import SCREEN
from furrow_post.run.progress import Progress, share_done
from furrow_post.run.record import Record


def record(wall_time: float, error: str = "") -> Record:
    return Record({}, "", {}, "", "2026-01-01T00:00:00Z", wall_time, 1.0, 0.1, error=error)


class ProgressTest(unittest.TestCase):
    def test_time_left_follows_shares_until_a_run_ends(self) -> None:
        progress = Progress(5, 2)
        self.assertEqual(progress.line([(1.0, 0.0)]), "0 of 5 done, 1 running (0 %)")
        # 40 s each: 30 + 20 of those running, three more, two at a time
        self.assertEqual(
            progress.line([(10.0, 0.25), (20.0, 0.5)]),
            "0 of 5 done, 2 running (25 %, 50 %), about 85 s left",
        )

    def test_time_left_follows_earlier_runs(self) -> None:
        progress = Progress(4, 1)
        progress.report("a", Path("a"), record(100.0))
        progress.report("b", Path("b"), record(60.0, "it broke"))
        self.assertEqual(
            progress.line([(30.0, 0.9)]),
            "2 of 4 done, 1 failed, 1 running (90 %), about 2.2 min left",  # 50 s and 80 s
        )

    def test_share_done_is_read_from_the_last_line(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder)
            self.assertEqual(share_done(path), 0.0)
            text = "x\n" * 5000 + "[bed] 100.0 %  elapsed\n[roll]  37.5 %  elapsed 1:12\nother\n"
            (path / SCREEN).write_text(text)
            self.assertEqual(share_done(path), 0.375)


if __name__ == "__main__":
    unittest.main()
