# SPDX-License-Identifier: GPL-2.0-or-later
"""A fast model of a wheel from a sweep, maps made with it, and soil parameters identified by it."""
