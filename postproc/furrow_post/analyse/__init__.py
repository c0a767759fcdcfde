# SPDX-License-Identifier: GPL-2.0-or-later
"""Readings of runs: densities, stresses, flow and histories, and runs next to each other."""
