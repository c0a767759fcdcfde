# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of a run with a ramp of the slip, at the slips of steady runs."""

from collections.abc import Iterator

import numpy as np

from furrow_post.study.runs import Runs

STRETCHES = {"continuum": 9, "scm": 20}  # of the cruise with the ramp
QUANTITIES = {"net_traction_coefficient": (0.02, False), "drive_torque": (0.05, True), "hub_drop": (0.02, True)}  # limit, relative


def compared(runs: Runs) -> Iterator[dict[str, object]]:
    """Steady runs against the curve of the ramp, which is linear between two stretches."""
    for ground, stretches in STRETCHES.items():
        ramp, steady = runs.one(f"{ground}/ramp"), runs.done(f"{ground}/-*", f"{ground}/0*")
        curve = runs.resistance(ramp, "--curve", stretches) if ramp and len(steady) > 2 else []
        for run in steady if curve else ():
            (point,) = runs.resistance(run, "--csv")
            for quantity, (limit, relative) in QUANTITIES.items():
                names = (quantity, f"{quantity}_error")
                slips = [row["slip"] for row in curve]
                at, at_error = (float(np.interp(point["slip"], slips, [row[name] for row in curve])) for name in names)
                value, error = (point[name] for name in names)
                yield {"ground": ground, "slip": point["slip"], "quantity": quantity, "value": value, "error": error, "at": at,
                       "at_error": at_error, "allowed": limit * value if relative else limit}  # fmt: skip
