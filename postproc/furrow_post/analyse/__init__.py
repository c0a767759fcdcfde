# SPDX-License-Identifier: GPL-2.0-or-later
"""Numbers made of results: densities, comparisons, errors, costs, soil parameters, formulas."""
