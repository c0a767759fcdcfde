# SPDX-License-Identifier: GPL-2.0-or-later
"""An oedometer test from a laboratory's table, and the same test on a material point."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..laws.measurements import Column, read_as, read_columns
from ..laws.point_curves import PointPaths
from ..uncertainty.statistics import rms
from ..arrays import Floats
from ..errors import ResultsError
from .material import require_plausible

NEEDS = (
    "an oedometer is a table with a column of the stress, such as stress_kPa, and one of the strain (%) or of the "
    "void ratio"
)
# keys of columns
STRESS = re.compile("stress|sigma|pressure|^[ps]$")
STRAIN = re.compile("strain|^eps")
VOID_RATIO = re.compile("^(e|voidratio|void)$")


@dataclass(frozen=True)
class Confined:
    """Confined compression: axial stress [Pa] over strain, both increasing.

    unloading: the modulus of its branches with falling stress [Pa], NaN without.
    """

    stress: tuple[float, ...]
    strain: tuple[float, ...]
    origin: str
    guessed: bool = False
    unloading: float = math.nan
    notes: tuple[str, ...] = ()


def read_oedometer(path: Path) -> Confined:
    """A table in the units of its headings, with unloading or without. @raises ResultsError"""
    if not path.is_file():
        raise FileNotFoundError(2, "No such file", str(path))
    columns = read_columns(path)
    stress_column = _find(path, columns, "stress", STRESS)
    strain_column = _find(path, columns, "strain", STRAIN, required=False)
    ratio_column = None if strain_column else _find(path, columns, "strain", VOID_RATIO)
    other = strain_column or ratio_column
    assert stress_column and other
    stress, compression = (c.values for c in read_as(path, {stress_column.heading: "Pa", other.heading: ""}))
    notes = []
    known = np.isfinite(stress) & np.isfinite(compression) & (stress != 0)
    stress, compression = stress[known], compression[known]
    if stress.size == 0:
        raise ResultsError(f"{path}: has no row with stress and strain; {NEEDS}")
    if ratio_column:
        first = compression[0]
        notes.append(f"strain from the void ratio, {first:g} at the first stress")
        compression = (first - compression) / (1 + first)
    stress = _positive(path, "stress", stress, notes)
    if strain_column:
        compression = _positive(path, "strain", compression, notes)
    for row, point in enumerate(zip(stress, compression), 1):
        try:
            require_plausible("stress", float(point[0]))
            require_plausible("strain", max(float(point[1]), 0.0))
        except ResultsError as error:
            raise ResultsError(f"{path}, row {row}: {error}") from error
    return _confined(path, stress, compression, tuple(notes))


def _confined(path: Path, stress: Floats, strain: Floats, notes: tuple[str, ...]) -> Confined:
    """Splits the test into its first loading and the branches of unloading."""
    before = np.maximum.accumulate(np.concatenate([[-math.inf], stress[:-1]]))
    loading = stress > before
    first_stress, first_strain = stress[loading], strain[loading]
    if len(first_stress) < 3 or np.any(np.diff(first_strain) <= 0):
        raise ResultsError(
            f"{path}: needs three rows or more of first loading, with increasing stress and increasing strain"
        )
    branches = _falling(stress)
    modulus = math.nan
    if branches:
        begin, end = max(branches, key=lambda branch: float(stress[branch[0]]))
        fall = float(strain[begin] - strain[end])
        if fall <= 0:
            raise ResultsError(
                f"{path}: the stress falls from {stress[begin]:g} to {stress[end]:g} Pa and the strain does not; "
                "check the order of the rows and the sign of the strain"
            )
        modulus = float(stress[begin] - stress[end]) / fall
        notes += (f"unloading from {stress[begin]:g} to {stress[end]:g} Pa: modulus {modulus:.4g} Pa",)
    return Confined(
        tuple(map(float, first_stress)),
        tuple(map(float, first_strain)),
        f"oedometer {path.name}",
        unloading=modulus,
        notes=notes,
    )


def _falling(stress: Floats) -> list[tuple[int, int]]:
    """First and last row of each stretch of falling stress."""
    falls = np.concatenate([[False], np.diff(stress) < 0, [False]]).astype(int)
    return list(zip(np.flatnonzero(np.diff(falls) == 1), np.flatnonzero(np.diff(falls) == -1)))


def _positive(path: Path, name: str, values: Floats, notes: list[str]) -> Floats:
    """Compression counts as positive."""
    if np.all(values <= 0):
        notes.append(f"{name} is negative in compression: its sign is changed")
        return -values
    if np.any(values < 0):
        raise ResultsError(f"{path}: {name} has values of both signs; compression has one sign")
    return values


def _find(
    path: Path, columns: list[Column], what: str, keys: re.Pattern[str], required: bool = True
) -> Column | None:
    found = [column for column in columns if keys.search(column.key)]
    if len(found) > 1:
        names = ", ".join(f"'{column.heading}'" for column in found)
        raise ResultsError(f"{path}: has the columns {names}, which may all be the {what}; leave one")
    if required and not found:
        names = ", ".join(f"'{column.heading}'" for column in columns) or "none of numbers"
        raise ResultsError(f"{path}: has no column of the {what}; it has {names}; {NEEDS}")
    return found[0] if found else None


def confined_strain(material: Path, stresses: tuple[float, ...]) -> Floats:
    """Strain (a ratio) at these axial stresses [Pa]. @raises ResultsError where furrow-point stops"""
    path = f"{{type: confined, stress: {list(stresses)}, steps: 40}}"
    with PointPaths() as paths:
        columns = paths(material, path)
    strain: Floats = np.interp(
        stresses, columns["axial_stress"], -np.expm1(-columns["axial_strain"])
    )
    return strain


def oedometer_misfit(material: Path, oedometer: Confined) -> float:
    """rms of virtual less measured strain over the greatest measured one."""
    difference = confined_strain(material, oedometer.stress) - np.array(oedometer.strain)
    return rms(difference) / oedometer.strain[-1]
