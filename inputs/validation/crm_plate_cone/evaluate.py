# SPDX-License-Identifier: GPL-2.0-or-later
"""Best estimates: zero cell size, with the effect of the speed of the cone."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from furrow_post.uncertainty.grid_convergence import grid_convergence
from furrow_post.study.runs import Runs
from furrow_post.tables.element_measures import cone_resistance, plate


def estimates(runs: Runs) -> Iterator[dict[str, Any]]:
    """Slower runs of the cone in coarse cells give the ratio of its resistance at zero speed. This ratio may be another
    in finer cells. The estimate is the middle between it and 1, and half of their distance is a standard error."""
    sinkage: dict[str, Any] = {one.name: np.interp([10e3, 20e3, 30e3], (p := plate(one))["pressure"], 1e3 * p["sinkage"]) for one in runs.done("plate")}
    kilopascal: dict[str, Any] = {one.name: [1e-3 * p for p in cone_resistance(one, (0.05, 0.10, 0.15), 0.005)["resistance"]] for one in runs.done("cone")}
    for quantity, known, stage in (("sinkage_{}_mm", sinkage, "plate"), ("resistance_{}_kPa", kilopascal, "cone")):
        series = [one for one in runs.done(stage) if one.name.count("_") == 1]
        slower = runs.done("cone_7", "cone_7_half", "cone_7_quarter") if stage == "cone" else []
        for k, place in enumerate((10, 20, 30) if stage == "plate" else (5, 10, 15)) if len(series) > 2 else ():
            cells = grid_convergence([one.number("cell") for one in series], [known[one.name][k] for one in series])
            ratio, ratio_error = 1.0, 0.0
            if len(slower) > 2:
                still, fast = grid_convergence([one.number("speed") for one in slower], [known[one.name][k] for one in slower]), known["cone_7"][k]
                ratio, ratio_error = still.value / fast, still.error / fast
            middle, parts = 0.5 * (1.0 + ratio), (0.5 * (1.0 - ratio) * cells.value, cells.value * ratio_error)
            yield {"quantity": quantity.format(place), "best_estimate": cells.value * middle, "error": np.linalg.norm([cells.error * middle, *parts]),
                   "order": cells.order, "extrapolated": cells.extrapolated, "ratio": ratio, "ratio_error": ratio_error}  # fmt: skip
