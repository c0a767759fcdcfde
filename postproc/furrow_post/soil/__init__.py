# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil cards: the parameters of vehicle codes from virtual tests, and material files from data."""
