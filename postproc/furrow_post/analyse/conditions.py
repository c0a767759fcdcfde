# SPDX-License-Identifier: GPL-2.0-or-later
"""Conditions of runs, such as load and speed: how far they may differ to be compared."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..errors import ResultsError
from ..read.wheel_run import WheelRun
from ..uncertainty.statistics import commonest


class Tolerance(NamedTuple):
    """Largest difference of a condition; the larger of the two counts."""

    relative: float
    absolute: float = 0.0

    def exceeded(self, values: Sequence[float]) -> bool:
        """True where values of a condition differ by more."""
        allowed = max(self.relative * max(abs(v) for v in values), self.absolute)
        return max(values) - min(values) > allowed * (1 + 1e-9)

    def text(self, unit: str = "") -> str:
        limit = f"{100 * self.relative:g} %" if self.relative else f"{self.absolute:g} {unit}".rstrip()
        return f"they may differ by {limit}"


TOLERANCES = {
    "load": Tolerance(0.02),
    "speed": Tolerance(0.02),
    "wheel_diameter": Tolerance(0.02),
    "wheel_width": Tolerance(0.03),
    "pressure": Tolerance(0.02),
    "depth": Tolerance(0.06),
    "density": Tolerance(0.1),
    "slip": Tolerance(0.0, 0.03),
    "slip_angle": Tolerance(0.0, 0.5),
    "camber": Tolerance(0.0, 0.5),
    "slope": Tolerance(0.0, 0.5),
    "side_slope": Tolerance(0.0, 0.5),
    "gravity": Tolerance(0.01),
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


def incomparable(runs: Sequence[WheelRun]) -> list[Difference]:
    """Every condition in which runs differ beyond its tolerance.

    A quantity that is the ground's answer in all of them does not count.
    """
    found = []
    for condition in ("wheel", "slip_definition"):
        if len({run.text(condition) for run in runs} - {""}) > 1:
            text = "; ".join(f"{run.label}: {run.text(condition)}" for run in runs)
            found.append(Difference(condition.replace("_", " "), text))
    answers = answers_of_ground(runs)
    for name, tolerance in TOLERANCES.items():
        have = [run for run in runs if np.isfinite(run.number(name))]
        if len(have) > 1 and name not in answers and tolerance.exceeded([run.number(name) for run in have]):
            text = "; ".join(f"{run.label}: {run.text(name)}" for run in have)
            found.append(Difference(name, f"{text} ({tolerance.text(have[0].conditions[name].unit)})"))
    return found


def require_different_labels(what: str, labels: Sequence[str]) -> None:
    """what: "runs". @raises ResultsError for two equal labels"""
    if len(set(labels)) < len(labels):
        raise ResultsError(f"two {what} are called '{commonest(labels)}'; write LABEL=FOLDER")


def require_comparable(what: str, differences: Sequence[Difference], anyway: bool) -> None:
    """what: "runs". @raises ResultsError with every difference unless compared anyway"""
    if differences and not anyway:
        reasons = "\n".join(f"  {d.condition}: {d.text}" for d in differences)
        raise ResultsError(
            f"these {what} are not comparable:\n{reasons}\n  --anyway compares them all the same, and says so"
        )
