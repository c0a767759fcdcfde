# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies: runs, which start if they are missing, with tables and figures."""
