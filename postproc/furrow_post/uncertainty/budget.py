# SPDX-License-Identifier: GPL-2.0-or-later
"""The error of a value in parts. An unknown part is shown, and never counts as zero."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar

from ..formatting import with_error

SHOWN_SHARE, SHOWN_TIME = 0.05, 0.01  # of the largest part: smaller ones are left out of a text


@dataclass(frozen=True)
class Budget:
    """Standard errors in the unit of the value; NaN: unknown. sources: part -> where it is from."""

    time: float = math.nan  # average over the steady window
    size: float = math.nan  # cells or grains
    domain: float = math.nan  # size of the ground
    packing: float = math.nan
    step: float = math.nan
    contact: float = math.nan
    held: float = math.nan  # load or slip that the rig holds
    material: float = math.nan
    model: float = math.nan
    sources: Mapping[str, str] = field(default_factory=dict, compare=False, kw_only=True)
    elements: str = field(default="cells", compare=False, kw_only=True)  # cells, grains, or mesh, for texts

    NAMES: ClassVar[tuple[str, ...]] = (
        "time", "size", "domain", "packing", "step", "contact", "held", "material", "model",
    )  # fmt: skip
    NUMERICAL: ClassVar[tuple[str, ...]] = NAMES[:4]  # parts from runs of other sizes, grounds and packings

    @classmethod
    def single(cls, part: str, error: float, source: str) -> "Budget":
        """Budget of one known part with its source."""
        return replace(cls(), **{part: error}, sources={part: source})

    def part(self, name: str) -> float:
        value: float = getattr(self, name)
        return value

    @property
    def known(self) -> list[str]:
        return [name for name in self.NAMES if math.isfinite(self.part(name))]

    @property
    def unknown(self) -> list[str]:
        return [name for name in self.NAMES if not math.isfinite(self.part(name))]

    @property
    def total(self) -> float:
        """Root of the sum of the squares of what is known; NaN where nothing is."""
        return math.hypot(*map(self.part, self.known)) if self.known else math.nan

    def scaled(self, factor: float) -> "Budget":
        return replace(self, **{name: abs(factor) * self.part(name) for name in self.NAMES})

    def updated(self, other: "Budget") -> "Budget":
        """The known parts of another budget in place of these, with their sources."""
        sources = {**self.sources, **other.sources}
        return replace(self, **{name: other.part(name) for name in other.known}, sources=sources)

    def label(self, part: str) -> str:
        """Name of a part of the error, as printed."""
        return {"size": self.elements, "domain": "ground"}.get(part, part)

    def text(self, value: float, unit: str = "", names: Sequence[str] = NAMES) -> str:
        """ "94 ± 12 mm (time 0.4, cells 2, model 11; ground, material unknown)". names: parts that count"""
        parts = self.parts_text(names)
        return f"{self.value_text(value)} {unit}".rstrip() + (f" ({parts})" if parts else "")

    def value_text(self, value: float) -> str:
        """ "94 ± 12"; three digits alone where no part is known."""
        return with_error(value, self.total) if self.known else f"{value:.3g}"

    def missing_text(self) -> str:
        """Parts that ± lacks: "+ ground, material unknown", "over time only"; empty where nothing is missing."""
        if self.unknown and [name for name in self.known if self.part(name) > 0] == ["time"]:
            return "over time only"
        return f"+ {', '.join(map(self.label, self.unknown))} unknown" if self.unknown else ""

    def parts_text(self, names: Sequence[str] = NAMES) -> str:
        largest = max((self.part(name) for name in self.known), default=0.0)
        shares = {"time": SHOWN_TIME}
        shown = [name for name in self.known if self.part(name) > shares.get(name, SHOWN_SHARE) * largest]
        texts = [f"{self.label(name)} {rounded(self.part(name))}" for name in shown]
        unknown = ", ".join(self.label(name) for name in self.unknown if name in names)
        return "; ".join(filter(None, [", ".join(texts), f"{unknown} unknown" if unknown else ""]))


IMPOSED = Budget(*(0.0 for _ in Budget.NAMES))  # of what the script sets


def rounded(value: float) -> str:
    """Two digits below 1.5 of a power of ten, else one, without an exponent down to a millionth."""
    if not value:
        return "0"
    power = math.floor(math.log10(value))
    digits = (value < 1.5 * 10.0**power) - power
    return f"{round(value, digits):.{max(digits, 0)}f}" if power > -7 else f"{value:.0e}"
