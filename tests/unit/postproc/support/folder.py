# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests that write files."""

import tempfile
import unittest
from pathlib import Path


class FolderTest(unittest.TestCase):
    """Each test has an empty folder."""

    def setUp(self) -> None:
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name)
