# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions of runs, such as load and speed: how far they may differ to be compared."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..read.wheel_run import WheelRun


class Tolerance(NamedTuple):
    """Largest difference of a condition; the larger of the two counts."""

    relative: float
    absolute: float


TOLERANCES = {
    "load": Tolerance(0.02, 0.0),
    "speed": Tolerance(0.02, 0.0),
    "wheel_diameter": Tolerance(0.02, 0.0),
    "wheel_width": Tolerance(0.03, 0.0),
    "pressure": Tolerance(0.02, 0.0),
    "depth": Tolerance(0.06, 0.0),
    "density": Tolerance(0.1, 0.0),
    "slip": Tolerance(0.0, 0.03),
    "slip_angle": Tolerance(0.0, 0.5),
    "camber": Tolerance(0.0, 0.5),
    "slope": Tolerance(0.0, 0.5),
    "side_slope": Tolerance(0.0, 0.5),
    "gravity": Tolerance(0.01, 0.0),
}


@dataclass(frozen=True)
class Difference:
    """A condition in which runs differ beyond its tolerance."""

    condition: str
    text: str


def answers_of_ground(runs: Iterable[WheelRun]) -> set[str]:
    """Conditions that the ground answers in all runs: slip of towed wheels, and speed of free
    ones."""
    runs = list(runs)
    if all(run.text("travel") == "free" for run in runs):
        return {"slip", "speed"}
    return {"slip"} if all(run.text("mode") == "towed" for run in runs) else set()


def differ(values: Sequence[float], tolerance: Tolerance) -> bool:
    """True where values of a condition differ beyond its tolerance."""
    allowed = max(tolerance.relative * max(abs(v) for v in values), tolerance.absolute)
    return max(values) - min(values) > allowed * (1 + 1e-9)


def incomparable(
    runs: Sequence[WheelRun], tolerances: Mapping[str, Tolerance] = TOLERANCES
) -> list[Difference]:
    """Every condition in which runs differ beyond its tolerance.

    A quantity that is the ground's answer in all of them does not count.
    """
    found = []
    answers = answers_of_ground(runs)
    if len({run.wheel for run in runs}) > 1:
        text = "; ".join(f"{run.label}: {run.wheel}" for run in runs)
        found.append(Difference("wheel", text))
    if len({run.text("slip_definition") for run in runs} - {""}) > 1:
        text = "; ".join(f"{run.label}: {run.text('slip_definition')}" for run in runs)
        found.append(Difference("slip definition", text))
    for name, tolerance in tolerances.items():
        have = [run for run in runs if np.isfinite(run.number(name))]
        if len(have) < 2 or name in answers:
            continue
        if differ([run.number(name) for run in have], tolerance):
            text = "; ".join(f"{run.label}: {run.text(name)}" for run in have)
            unit = have[0].conditions[name].unit
            relative, absolute = tolerance
            limit = f"{100 * relative:g} %" if relative else f"{absolute:g} {unit}".strip()
            found.append(Difference(name, f"{text} (they may differ by {limit})"))
    return found
