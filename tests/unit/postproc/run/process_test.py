# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow_post.run.process without a program."""

import errno
import os
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from furrow_post.run.process import CHECKPOINT, keep_checkpoint


class KeepCheckpointTest(unittest.TestCase):
    def test_link_in_the_place_of_the_part_is_not_followed(self) -> None:
        """From another disk the checkpoint is copied."""
        with tempfile.TemporaryDirectory() as name:
            start, results, notes = Path(name) / "start", Path(name) / "results", Path(name) / "notes"
            start.mkdir()
            results.mkdir()
            notes.write_text("of the user")
            (start / "restart_forced_liggghts_7.data").write_text("checkpoint")
            (results / f"{CHECKPOINT}.part").symlink_to(notes)
            with mock.patch.object(os, "rename", side_effect=OSError(errno.EXDEV, "other disk")):
                self.assertTrue(keep_checkpoint(start, results, since=0))
            self.assertEqual(notes.read_text(), "of the user")
            self.assertEqual((results / CHECKPOINT).read_text(), "checkpoint")
            self.assertFalse((results / CHECKPOINT).is_symlink())


if __name__ == "__main__":
    unittest.main()
