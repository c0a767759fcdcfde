# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas and laws: predictions, and the fit of parameters to measurements."""
