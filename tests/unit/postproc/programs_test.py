# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow_post.programs: which build a command takes its programs from."""

import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from furrow_post.programs import find_program


class FindProgramTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        for build in ("named", "beside"):
            (self.folder / build / "bin").mkdir(parents=True)
            (self.folder / build / "bin" / "furrow-point").touch()
        self.enterContext(
            mock.patch.object(sys, "argv", [str(self.folder / "beside" / "bin" / "furrow-post")])
        )

    def test_program_next_to_the_command_has_priority(self) -> None:
        with mock.patch.dict(os.environ):
            os.environ.pop("FURROW_BUILD", None)
            self.assertEqual(find_program("furrow-point"), self.folder / "beside/bin/furrow-point")

    def test_named_build_folder_has_priority(self) -> None:
        with mock.patch.dict(os.environ, FURROW_BUILD=str(self.folder / "named")):
            self.assertEqual(find_program("furrow-point"), self.folder / "named/bin/furrow-point")


if __name__ == "__main__":
    unittest.main()
