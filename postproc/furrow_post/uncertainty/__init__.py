# SPDX-License-Identifier: GPL-2.0-or-later
"""The error of a number: its parts, where they come from, and whether two numbers agree."""
