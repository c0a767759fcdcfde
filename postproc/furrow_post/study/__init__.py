# SPDX-License-Identifier: GPL-2.0-or-later
"""Studies: runs that are made when they are missing, and their tables and figures."""
