# SPDX-License-Identifier: GPL-2.0-or-later
"""Results of laboratory tests on clusters of snow, in rows that a law can be compared with:
confined compression; triaxial compression; tension, compression with free sides and shear of snow
that was compressed in confined compression before."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.csv_table import in_cells, read_rows, write_rows
from furrow_post.errors import ResultsError, content_of
from furrow_post.laboratory.curve_tests import around_peak
from furrow_post.read.laboratory import LaboratoryTest, cell_curve

LEVELS = (3e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6)  # [Pa] axial stresses of the oedometer
STRAINS = (0.1, 0.2)  # axial, where compression with free sides is compared
TRIAXIAL_STRAIN = 0.2
ELASTIC = 5e-5  # axial strain up to which a cell that is pulled is elastic


class Place(NamedTuple):
    """Test of a row, and the place where it is compared."""

    test: str  # oedometer, tension, unconfined, shear or triaxial
    compaction: float  # logarithmic strain of the confined compression before
    confinement: float  # [Pa] lateral stress; of shear: normal stress
    level: float  # axial stress [Pa] of the oedometer, axial strain of the others
    quantity: str


@dataclass(frozen=True)
class Row:
    """A measured value: mean and standard deviation of the packings."""

    test: str
    compaction: float
    confinement: float
    level: float
    quantity: str
    value: float
    scatter: float
    packings: int

    @property
    def place(self) -> Place:
        return Place(self.test, self.compaction, self.confinement, self.level, self.quantity)


Values = dict[Place, float]
Found = dict[tuple[float, str], float]  # (level, quantity) -> value, of one test


def oedometer_values(rows: Floats) -> Found:
    _, stress, density = cell_curve(rows)
    end = int(np.argmax(stress[:, 2])) + 1
    axial = np.maximum.accumulate(np.maximum(stress[:end, 2], 1.0))
    lateral = 0.5 * (stress[:end, 0] + stress[:end, 1])
    found = {(0.0, "density"): float(density[0])}
    for level in LEVELS:
        near = np.abs(np.log(axial / level)) < 0.1
        if near.any() and axial[0] < level <= axial[-1]:
            found[level, "density"] = float(np.interp(level, axial, density[:end]))
            found[level, "K0"] = float(np.mean(lateral[near] / axial[near]))
    return found


def tension_values(rows: Floats) -> Found:
    strain, stress, _ = cell_curve(rows)
    pulled, pull = -strain[:, 2], -stress[:, 2]
    first = pulled <= ELASTIC
    found = {(0.0, "strength"): float(pull.max())}
    if first.sum() > 3 and np.ptp(pulled[first]) > 0:
        found[0.0, "modulus"] = float(np.polyfit(pulled[first], pull[first], 1)[0])
    return found


def unconfined_values(rows: Floats) -> Found:
    strain, stress, _ = cell_curve(rows)
    axial, lateral = strain[:, 2], strain[:, :2].mean(axis=1)
    found = {}
    for level in STRAINS:
        near = np.abs(axial - level) < 0.05 * level
        if near.any():
            found[level, "stress"] = float(stress[near, 2].mean())
            found[level, "lateral_ratio"] = float(np.mean(-lateral[near] / axial[near]))
    return found


def shear_values(rows: Floats) -> Found:
    """Shear stress is the column after those of the cell and the displacement."""
    _, _, density = cell_curve(rows)
    _, _, strength = around_peak(rows[:, 9])
    return {(0.0, "density"): float(density[0]), (0.0, "strength"): strength}


def triaxial_values(rows: Floats) -> Found:
    strain, stress, density = cell_curve(rows)
    found = {(0.0, "density"): float(density[0])}
    near = np.abs(strain[:, 2] - TRIAXIAL_STRAIN) < 0.05 * TRIAXIAL_STRAIN
    if near.any():
        deviator = stress[near, 2] - 0.5 * (stress[near, 0] + stress[near, 1])
        found[TRIAXIAL_STRAIN, "deviator"] = float(deviator.mean())
        found[TRIAXIAL_STRAIN, "density"] = float(density[near].mean())
        lateral = strain[near, :2].mean(axis=1)
        found[TRIAXIAL_STRAIN, "lateral_ratio"] = float(np.mean(-lateral / strain[near, 2]))
    return found


MEASURES: dict[str, Callable[[Floats], Found]] = {
    "oedometer": oedometer_values,
    "tension": tension_values,
    "unconfined": unconfined_values,
    "shear": shear_values,
    "triaxial": triaxial_values,
}


def values_at(test: LaboratoryTest) -> Values:
    """@raises ResultsError of a test of another kind, or one whose curve is none"""
    if test.kind not in MEASURES:
        kinds = ", ".join(MEASURES)
        raise ResultsError(f"{test.folder}: is a test '{test.kind}'; name results of {kinds}")
    facts = test.numbers
    compaction, confinement = facts.get("compaction", 0.0), facts.get("confinement", 0.0)
    with content_of(test.folder, "make the test again"):
        found = MEASURES[test.kind](test.curve())
    return {
        Place(test.kind, compaction, confinement, level, quantity): value
        for (level, quantity), value in found.items()
    }


def record_of(tests: Iterable[LaboratoryTest]) -> list[Row]:
    """Tests that differ in their packing alone make one row of each value."""
    packings: dict[Place, list[float]] = {}
    for test in tests:
        for place, value in values_at(test).items():
            packings.setdefault(place, []).append(value)
    rows = [row_of(place, values) for place, values in sorted(packings.items())]
    if not any(row.test == "oedometer" for row in rows):
        raise ResultsError("the hardening is that of the oedometer; name results of that test too")
    return rows


def row_of(place: Place, values: Sequence[float]) -> Row:
    scatter = float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
    return Row(*place, float(np.mean(values)), scatter, len(values))


def write_record(path: Path, rows: Sequence[Row]) -> None:
    head = "# Laboratory tests on grains, written by inputs/laboratory/identify_snow.py"
    write_rows(path, [in_cells(asdict(row), 4) for row in rows], [head])


def read_record(path: Path) -> list[Row]:
    """@raises OSError; ResultsError of a table with other columns"""
    with content_of(path, "make it again: identify_snow.py record"):
        kinds: dict[str, Any] = {field.name: field.type for field in fields(Row)}
        return [Row(**{n: kind(row[n]) for n, kind in kinds.items()}) for row in read_rows(path)]
