# SPDX-License-Identifier: GPL-2.0-or-later
"""Tests of inputs/laboratory: what each says, what several say together, and the report."""
