# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of results; drawn without a display."""

import matplotlib

matplotlib.use("Agg")
