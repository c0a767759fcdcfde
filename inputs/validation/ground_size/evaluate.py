# SPDX-License-Identifier: GPL-2.0-or-later
"""Changes of an answer over the distance of an edge of the ground: a exp(-x/c)."""

from typing import Any

import numpy as np
import pandas
from scipy.optimize import least_squares

from furrow_post.uncertainty.statistics import rms

NOISE, SHARE = 0.02, 0.2  # of a change: what a fit may miss, at small and at large changes


def distance(v: Any, edge: str) -> float:
    """Distance of an edge of the ground, in widths of the body: from its side, from the surface, from below its middle."""
    body, width = (v.size, v.box) if hasattr(v, "box") else (0.272, v.width)
    side = 0.5 * (width / body - 1.0)
    places = {"all": 0.0, "width": side, "absorbing": side, "depth": v.depth / body, "length": 0.5 * v.get("length", 0.0) / body}
    return float(places[edge])


def effects(frame: pandas.DataFrame, known: Any) -> pandas.DataFrame:
    """A row for each kind of ground, body, edge and quantity: a fit to the ground with the clearest changes, 0 where none is clear."""
    rows: list[dict[str, Any]] = []
    sizes = frame.assign(size=frame["change"].abs() / np.hypot(frame["error"].to_numpy(float), 0.3 * NOISE))
    for key, runs in sizes.groupby(["kind", "body", "edge", "quantity"], sort=False):
        one = runs[runs["ground"] == runs.groupby("ground")["size"].sum().astype(float).idxmax()]
        x, y, size = (one[name].to_numpy(float) for name in ("x", "change", "size"))
        a, c = 0.0, 1.0
        if size.max() > 3.0:
            sign, sigma = np.sign(y[size.argmax()]), np.sqrt(NOISE**2 + one["error"].to_numpy(float) ** 2 + (SHARE * y) ** 2)
            a, c = least_squares(lambda p: (p[0] * np.exp(-x / p[1]) - y) / sigma, [sign, 0.5], bounds=([100 * min(sign, 0), 0.05], [100 * max(sign, 0), 1])).x
        rows.append({**dict(zip(["kind", "body", "edge", "quantity"], key)), "a": a, "c": c, "residual": rms(a * np.exp(-x / c) - y), "runs": len(runs)})
    return pandas.DataFrame(rows)
