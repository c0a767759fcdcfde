# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that soils have, from furrow-point: what is far outside has probably another unit."""

from dataclasses import dataclass
from functools import cache

from ..errors import ResultsError
from ..json_text import parse_json
from ..programs import find_program
from ..read.soil_card import EARTH as EARTH
from ..run.tools import answer


@dataclass(frozen=True)
class UsualRange:
    """Values of soils and snow in a unit, and what a value outside may be in."""

    unit: str
    lower: float
    upper: float
    zero: bool  # 0 is usual too
    hint: str


@cache
def usual_ranges() -> dict[str, UsualRange]:
    """By key, as the program prints them. @raises ResultsError without it"""
    table = parse_json(answer([find_program("furrow-point"), "usual"]))
    return {key: UsualRange(**row) for key, row in table.items()}


def require_plausible(name: str, value: float) -> None:
    """name: a key of usual_ranges(). @raises ResultsError that names unit and remedy"""
    known = usual_ranges()[name]
    if known.lower <= value <= known.upper or (known.zero and value == 0):
        return
    unit = f" {known.unit}" if known.unit else ""
    zero = " or 0" if known.zero else ""
    raise ResultsError(
        f"{name} is {value:g}{unit}; soils and snow have {known.lower:g} to {known.upper:g}{unit}{zero}. "
        f"Give SI units: {known.hint}."
    )
