# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas and laws: what they predict, and the fit of their parameters to measurements."""
