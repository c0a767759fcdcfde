# SPDX-License-Identifier: GPL-2.0-or-later
"""The run: what is run, its record, the executor, the reader of its results as a row of a table."""
