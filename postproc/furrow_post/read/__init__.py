# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of finished runs: history.h5, terrain.h5, summary.json, laboratory tests."""
