# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantities that colour moving grains and particles, with scales that fit whole runs."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays import Floats
from ..read.motion import Motion, evenly_chosen
from .style import MILLIMETRE, round_up

COLOURS = 255  # levels of a scale: 0 ... 254; 255: not known
SAMPLES = 12  # frames from which a scale is taken
KNOWN = (  # key, name, unit, factor, whether the scale begins at 0
    ("density", "density", "kg/m³", 1.0, False),
    ("displacement", "displacement", "mm", MILLIMETRE, True),
    ("speed", "speed", "m/s", 1.0, True),
)


@dataclass(frozen=True)
class Quantity:
    """Quantity that colours points; the scale is shared by all runs of a page."""

    key: str
    name: str
    unit: str
    factor: float  # from SI to this unit
    low: float  # [unit]
    high: float

    def levels(self, values: Floats) -> Any:
        """Levels 0 to 254 of values, and 255 for NaN."""
        share = (self.factor * values - self.low) / (self.high - self.low)
        level = np.round((COLOURS - 1) * np.clip(np.nan_to_num(share), 0, 1))
        return np.where(np.isfinite(values), level, COLOURS).astype(np.uint8)


def quantities_of(motions: Sequence[Motion]) -> list[Quantity]:
    """Quantities of a run; those that all points of all runs have come first. @raises ResultsError"""
    samples: dict[str, list[Floats]] = {}
    lacking: set[str] = set()  # quantities that a cloud of points lacks at the end
    for motion in motions:
        for cloud in motion.clouds:
            for time in evenly_chosen(motion.times, SAMPLES):  # the last is the end
                fields = cloud.at(time).fields
                for key, values in fields.items():
                    samples.setdefault(key, []).append(values[np.isfinite(values)])
            lacking |= {key for key, *_ in KNOWN} - fields.keys()
    found = []
    for key, name, unit, factor, from_zero in KNOWN:
        values = factor * np.concatenate(samples.get(key, [np.empty(0)]))
        if not len(values):
            continue
        low, high = (float(value) for value in np.percentile(values, [0.5, 99.8]))
        low, high = (0.0, round_up(high)) if from_zero else (float(np.floor(low)), high)
        found.append(Quantity(key, name, unit, factor, low, max(high, low + 1e-6)))
    return sorted(found, key=lambda one: one.key in lacking)
