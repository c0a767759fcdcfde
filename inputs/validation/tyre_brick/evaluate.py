# SPDX-License-Identifier: GPL-2.0-or-later
"""Error of the largest contact stress in meshes of one tyre."""

from typing import Any

import pandas


def mesh_error(rows: pandas.DataFrame, tables: Any, constants: Any, by: str) -> pandas.DataFrame:
    """Change of the peak to the next finer mesh, of the finest to the next coarser; of two meshes at least."""
    made = []
    for _, mine in rows.groupby(by, sort=False):
        peaks = list(mine["largest_kPa"])
        others = [*peaks[1:], *peaks[-2:-1]]
        if len(peaks) > 1:
            made.append(mine.assign(mesh_error=[round(abs(other / peak - 1), 4) for peak, other in zip(peaks, others)]))
    return pandas.concat(made) if made else rows.iloc[:0]
