# SPDX-License-Identifier: GPL-2.0-or-later
"""Sweeps: runs of one scene over values of its variables, as tables and curves."""
