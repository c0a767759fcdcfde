# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that write files."""

import shutil
import tempfile
import unittest
from pathlib import Path


class FolderTest(unittest.TestCase):
    """Each test has an empty folder."""

    def setUp(self) -> None:
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)


class SharedFolderTest(unittest.TestCase):
    """The tests of a class have one folder, which setUpClass of the class fills."""

    folder: Path

    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
