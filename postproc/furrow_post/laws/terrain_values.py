# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressure-sinkage and shear values of terrains: terrains.csv and soil cards. SI units."""

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats
from ..csv_table import read_rows
from ..errors import ResultsError
from ..read.soil_card import read_card

VALUES = ("n", "c", "phi", "K", "c1", "c2")


@dataclass(frozen=True)
class TerrainValues:
    """One row of terrains.csv, whose head explains the columns; NaN: not in the source."""

    name: str
    kind: str
    pressure: str  # author of the pressure-sinkage law: "bekker" or "reece"
    k_1: float
    k_2: float
    n: float
    c: float  # cohesion [Pa]
    phi: float  # friction angle [degrees]
    K: float  # shear displacement [m]
    c1: float
    c2: float
    deepest: float = math.inf  # sinkage of the plates behind the values [m]
    assumed: tuple[str, ...] = ()  # values that no source of this ground has, in words

    def report(self) -> str:
        """Text of the values in one line."""
        names = ("k_c", "k_phi") if self.pressure == "bekker" else ("k_1", "k_2")
        values = (*zip(names, (self.k_1, self.k_2)), *((name, getattr(self, name)) for name in VALUES))
        return ", ".join(f"{name} {value:.6g}" for name, value in values if math.isfinite(value))

    def modulus(self, width: float) -> float:
        """k of p = k z^n [Pa/m^n] under a contact of this width [m].

        @raises ResultsError where the ground would not resist
        """
        if self.pressure == "bekker":
            modulus = self.k_1 / width + self.k_2
        else:
            modulus = float((self.k_1 + self.k_2 * width) / width**self.n)
        if not modulus > 0:
            raise ResultsError(
                f"'{self.name}' does not resist under a contact {width:g} m wide: its modulus is {modulus:.3g} "
                "Pa/m^n; take a wider one"
            )
        return modulus

    def plate_pressure(self, sinkage: Floats, width: float) -> Floats:
        """Mean pressure [Pa] under a plate at this sinkage [m]."""
        pressure: Floats = self.modulus(width) * np.asarray(sinkage) ** self.n
        return pressure


def terrains() -> dict[str, TerrainValues]:
    """Name -> values, from terrains.csv."""
    found: dict[str, TerrainValues] = {}
    for row in read_rows(Path(__file__).with_name("terrains.csv")):
        values: dict[str, Any] = {name: float(row[name] or "nan") for name in ("k_1", "k_2", *VALUES)}
        found[row["name"]] = TerrainValues(row["name"], row["kind"], row["pressure"], **values)
    return found


CARD = (".yaml", ".yml", ".json")  # endings of a soil card
LOOSE_SAND = "Wong-Reece loose sand"


def with_stress_place(ground: TerrainValues) -> TerrainValues:
    """No plate gives c1 and c2, the place of the greatest stress: without them, those of loose sand."""
    sand, assumed = terrains()[LOOSE_SAND], ground.assumed
    for name in ("c1", "c2"):
        if math.isnan(getattr(ground, name)):
            value = getattr(sand, name)
            ground = replace(ground, **{name: value})
            assumed += (f"{name} {value:g}, that of {LOOSE_SAND}; give --{name}",)
    return replace(ground, assumed=assumed)


def terrain_of_card(path: Path) -> TerrainValues:
    """Terrain values of a soil card. @raises OSError, ResultsError"""
    card = read_card(path)
    plate, shear = card.bekker_and_shear()
    parameters = (plate.k_c, plate.k_phi, plate.n, shear.c, shear.phi, shear.K)
    values: dict[str, Any] = {name: one.value for name, one in zip(("k_1", "k_2", *VALUES), parameters)}
    return TerrainValues(card.title, "card", "bekker", **values, c1=card.c1, c2=card.c2, deepest=plate.sinkage.high)


def terrain(name: str) -> TerrainValues:
    """A row of terrains.csv, or a soil card by its file. @raises ResultsError for an unknown name"""
    if name.endswith(CARD):
        return with_stress_place(terrain_of_card(Path(name)))
    known = terrains()
    if name not in known:
        raise ResultsError(f"there is no terrain '{name}'; name a soil card, or one of {', '.join(known)}")
    return known[name]
