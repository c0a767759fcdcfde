# SPDX-License-Identifier: GPL-2.0-or-later
"""Quartz sand of a cone index: NorSand, as dense or as moist as the virtual cone asks for."""

import math

import numpy as np

from ..csv_table import read_rows
from .material import find_ground

BASE = "sand_medium"
TABLE = "cone_on_quartz_sand.csv"  # in inputs/soils, by rising index
CELLS = "2"  # across the cone, of the rows that are used
GRAINS = 2650.0  # density of quartz [kg/m3]


def quartz_sand(title: str, index: float) -> str | None:
    """Text of a material file of the sand with this cone index [Pa]; None beyond the table.

    The path through the table leads from loose to dense dry sand, then to dense sand that moisture holds together.
    """
    base = find_ground(BASE)
    rows = [row for row in read_rows(base.parents[1] / "soils" / TABLE) if row["across"] == CELLS]
    places = np.log([float(row["index_Pa"]) for row in rows])
    place = float(np.log(index))
    if not places[0] <= place <= places[-1]:
        return None
    e0 = float(np.interp(place, places, [float(row["e0"]) for row in rows]))
    pt = math.exp(float(np.interp(place, places, np.log([float(row["pt_Pa"]) for row in rows]))))
    return (
        f"title: {title}\n"
        f"# Void ratio, and tensile strength of moisture, by the virtual cone ({TABLE}).\n"
        f"base: {base}\n"
        f"law: {{density: {GRAINS / (1 + e0):.5g}, e0: {e0:.4g}, pt: {pt:.4g}}}\n"
    )
