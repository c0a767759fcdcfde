# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures, plots and tables from the results of Furrow. All statistics come from the program furrow-resistance."""
