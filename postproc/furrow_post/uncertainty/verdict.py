# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that are compared, each with its whole error, and whether two agree."""

import enum
import math
from collections.abc import Iterable
from dataclasses import dataclass

from ..formatting import in_unit, value_text
from .budget import Budget

COVERAGE = 2.0  # standard errors within which two values agree
BARS = f"bars: {COVERAGE:g} standard errors"  # for the legends of figures

# Kinds of entries; BEST: estimate for a run from the sizes of its family (grid_convergence.py)
RUN, BEST, FORMULA, MEASURED = "run", "best estimate", "formula", "measured"


class Agreement(enum.Enum):
    """Judgement of the difference of two values by their uncertainty."""

    AGREE = "agree"  # within their uncertainty
    DIFFER = "differ"  # by more than their uncertainty
    INCONCLUSIVE = "inconclusive"  # a part of their uncertainty is unknown, or it is too large


@dataclass(frozen=True)
class Quantity:
    """Quantity that is compared; scale: from SI to the unit that people read."""

    key: str
    name: str
    unit: str
    scale: float

    @property
    def label(self) -> str:
        """ "hub drop [mm]"."""
        return self.name + in_unit(self.unit)


# key: the column of inputs/costs/*.csv
HUB_DROP = Quantity("sinkage", "hub drop", "mm", 1e3)
COEFFICIENT = Quantity("coefficient", "resistance coefficient", "", 1.0)
QUANTITIES = (HUB_DROP, COEFFICIENT)
TRACK_DENSITY = Quantity("track_density", "density under the track", "kg/m3", 1.0)  # without a verdict


@dataclass(frozen=True)
class Entry:
    """One value of one quantity in the comparison, SI."""

    quantity: Quantity
    source: str  # label of a run, name of a formula, "measured"
    value: float
    parts: Budget
    kind: str  # RUN, BEST, FORMULA, MEASURED
    note: str = ""
    cpu_time: float = math.nan
    steady: bool = True  # else the time average has no error that is known

    @property
    def label(self) -> str:
        """The source, "grains, best estimate" of one."""
        return f"{self.source}, {BEST}" if self.kind == BEST else self.source

    @property
    def of_run(self) -> bool:
        """True where the uncertainty of the entry has the parts of a run's."""
        return self.kind in (RUN, BEST)

    @property
    def uncertainty(self) -> float:
        """NaN where nothing of it is known."""
        return self.parts.total

    @property
    def unknown(self) -> list[str]:
        """Parts of its numerical uncertainty that are not known."""
        if not self.of_run:
            return []
        missing = [name for name in self.parts.NUMERICAL if name in self.parts.unknown]
        return missing if self.steady or "time" in missing else ["time", *missing]

    def text(self) -> str:
        """The value with its uncertainty in the unit of the quantity."""
        scale = self.quantity.scale
        return value_text(scale * self.value, scale * self.uncertainty)


@dataclass(frozen=True)
class Verdict:
    """The verdict on two values of one quantity."""

    quantity: Quantity
    first: str  # whose values: labels of runs, or "measured"
    second: str
    agreement: Agreement
    sentence: str
    with_measurement: bool = False
    unknown: tuple[str, ...] = ()  # parts of the uncertainty that are not known, "size of a"


def quantities_with(verdicts: Iterable[Verdict], *agreements: Agreement) -> list[str]:
    """Names of the quantities that have one of these verdicts, in their order."""
    names = [v.quantity.name for v in verdicts if v.agreement in agreements]
    return list(dict.fromkeys(names))


def joined(names: Iterable[str]) -> str:
    """ "a and b"."""
    return " and ".join(names)
