# SPDX-License-Identifier: GPL-2.0-or-later
"""Whether two values agree: an enumeration that programs judge by, and a sentence for people."""

import enum
from collections.abc import Iterable
from dataclasses import dataclass

from ..formatting import in_unit

COVERAGE = 2.0  # standard errors within which two values agree
BARS = f"bars: {COVERAGE:g} standard errors"  # for the legends of figures


class Agreement(enum.Enum):
    """What the difference of two values says, seen against their uncertainty."""

    AGREE = "agree"  # within their uncertainty
    DIFFER = "differ"  # by more than their uncertainty
    INCONCLUSIVE = "inconclusive"  # a part of their uncertainty is unknown, or it is too large


@dataclass(frozen=True)
class Quantity:
    """What is compared; scale: from SI to the unit that people read."""

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
