# SPDX-License-Identifier: GPL-2.0-or-later
"""Values that soils have: what is far outside has probably another unit."""

from dataclasses import dataclass

from ..errors import ResultsError
from ..read.soil_card import EARTH as EARTH, SMALLEST_K


@dataclass(frozen=True)
class Plausible:
    """What soils and snow have, [low, high], in a unit, and what a value outside may be in."""

    unit: str
    low: float
    high: float
    remedy: str
    zero: bool = False  # 0 is a value too


# From fresh snow to cemented ground: J. Y. Wong, Theory of Ground Vehicles (2008), Table 2.3,
# widened ten times
PLAUSIBLE = {
    "c": Plausible("Pa", 20.0, 5e6, "kPa times 1000, psi times 6895", zero=True),
    "phi": Plausible("degree", 2.0, 48.0, "radians times 57.3"),
    "density": Plausible("kg/m3", 40.0, 3000.0, "g/cm3 times 1000, kN/m3 times 102"),
    "E": Plausible("Pa", 2e4, 1e11, "kPa times 1000, MPa times 1e6"),
    "stress": Plausible("Pa", 100.0, 1e9, "kPa times 1000"),
    "strain": Plausible("", 1e-6, 0.9, "percent over 100", zero=True),
    "k_c": Plausible("N/m^(n+1)", -5e6, 5e7, "kN/m^(n+1) times 1000"),
    "k_phi": Plausible("N/m^(n+2)", 1e4, 1e9, "kN/m^(n+2) times 1000"),
    "n": Plausible("", 0.1, 3.0, "n is a number without unit"),
    "K": Plausible("m", SMALLEST_K, 0.3, "cm over 100, mm over 1000"),
    "cone_index": Plausible("Pa", 5e3, 2e7, "kPa times 1000, psi times 6895"),
}


def require_plausible(name: str, value: float) -> None:
    """name: of PLAUSIBLE. @raises ResultsError that names unit and remedy"""
    known = PLAUSIBLE[name]
    if known.low <= value <= known.high or (known.zero and value == 0):
        return
    unit = f" {known.unit}" if known.unit else ""
    zero = " or 0" if known.zero else ""
    raise ResultsError(
        f"{name} is {value:g}{unit}; soils and snow have {known.low:g} to {known.high:g}{unit}{zero}. "
        f"Give SI units: {known.remedy}."
    )
