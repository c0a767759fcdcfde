# SPDX-License-Identifier: GPL-2.0-or-later
"""Faults of a user as rows of a table: what was asked for, and what the one line must say."""

import contextlib
import io
import unittest
from collections.abc import Callable
from typing import NamedTuple


class Outcome(NamedTuple):
    """Outcome of a program that ran in this process."""

    status: object
    said: str  # on stderr


def outcome(program: Callable[[], int]) -> Outcome:
    """Runs a program to its end, also where it exits by itself."""
    printed, said = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(said):
        try:
            status: object = program()
        except SystemExit as end:
            status = end.code
    return Outcome(status, said.getvalue())


class FaultsTest(unittest.TestCase):
    """A case for tables of faults."""

    def expect(self, fault: str, found: Outcome, message: str) -> None:
        """The program ended with status 1 or 2 and a last line that says this."""
        with self.subTest(fault=fault):
            self.assertIn(found.status, (1, 2), found.said)
            self.assertNotIn("Traceback", found.said)
            self.assertNotIn("internal error", found.said)
            self.assertIn(message, found.said.splitlines()[-1])
