# SPDX-License-Identifier: GPL-2.0-or-later
"""The error that ends a command with a message instead of a traceback."""


class ResultsError(Exception):
    """Something asked for is not in the results; the message names file and remedy."""
