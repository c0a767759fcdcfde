# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures, plots, tables and studies from the results of Furrow.

Rooms, each of which imports only from those to its left: read (files), analyse (numbers), figures,
study (runs and their tables), cli (the command furrow-post). Steady values and their standard
errors come from the program furrow-resistance, never from here.
"""

__version__ = "0.1.0"  # of the whole project: pyproject.toml and CMakeLists.txt read this line
