# SPDX-License-Identifier: GPL-2.0-or-later
"""The column that collapses, verdicts on laws, and the cone of the soil card."""

from pathlib import Path

import numpy as np

from furrow_post.read.soil_card import read_card
from furrow_post.study.runs import Runs


def heightmap(length: float, height: float, radius: float = 0.08, step: float = 0.005) -> str:
    """A cylinder on level ground, as ESRI ASCII grid."""
    places = (np.arange(round(length / step) + 1) - round(length / step) / 2) * step
    heights = np.where(np.hypot(*np.meshgrid(places, places)) < radius, height, 0.0)
    head = f"ncols {len(places)}\nnrows {len(places)}\nxllcenter {places[0]:g}\nyllcenter {places[0]:g}\ncellsize {step}\n"
    return head + "\n".join(" ".join(f"{value:g}" for value in row) for row in heights) + "\n"


def verdict(off: float, error: float, goal: float) -> str:
    """Missed where two errors do not explain it, met where the error is small."""
    met = "met" if abs(off) <= goal and error <= goal else "inconclusive"
    return "missed" if abs(off) > goal + 2 * error else met if abs(off) < np.inf else ""


def cone_of_card(runs: Runs) -> list[dict[str, object]]:
    index = read_card(Path(__file__).parents[2] / "soils" / "sand_dry.yaml").cone.index  # type: ignore[union-attr]
    return [{"test": "cone", "at": "80 mm wide", "quantity": "index", "mean": index.value, "error": index.error}]
