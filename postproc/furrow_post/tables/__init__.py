# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables and figures of a study, which its study.yaml lists: rows of runs, and operations on tables."""
