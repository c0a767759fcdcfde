# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow_post.run.process without a program."""

import errno
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from furrow_post.run.process import CHECKPOINT, keep_checkpoint
from support.folder import FolderTest
from support.runs import write_run


class KeepCheckpointTest(unittest.TestCase):
    def test_link_at_the_temporary_name_is_not_followed(self) -> None:
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


class ProcessesTest(FolderTest):
    def test_program_that_draws_during_runs_ends(self) -> None:
        """Files are read by a copy of the program, which must not take the signals of runs."""
        write_run(self.folder)
        code = (
            "import furrow_post\n"
            "from furrow_post.run.process import Processes\n"
            f"with Processes():\n    print(furrow_post.load({str(self.folder)!r}).title)\n"
        )
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
