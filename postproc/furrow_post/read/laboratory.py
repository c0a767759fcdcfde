# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders of laboratory tests on grains, and of furrow-point, the same paths on a law."""

from pathlib import Path

import numpy as np

from ..arrays import Fields, Floats
from ..csv_table import number_or_text, read_columns, read_matrix, read_numbers
from ..errors import ResultsError, content_of

REMEDY = "run the test again, with inputs/laboratory/run.py"
COLUMNS = {  # of curve.txt, at least
    "oedometer": 8,
    "triaxial": 9,
    "extension": 9,
    "plane_strain": 9,
    "unconfined": 8,
    "tension": 8,
    "shear": 10,
    "plate": 4,
}
KINDS = (*COLUMNS, "collapse", "repose")


class LaboratoryTest:
    """One results folder: facts.txt (name value pairs), and its curve or dumps."""

    def __init__(self, folder: Path | str) -> None:
        """@raises ResultsError where there is no facts.txt, or it is of no known test"""
        self.folder = Path(folder)
        path = self.folder / "facts.txt"
        try:
            with content_of(path, REMEDY):
                pairs = path.read_text(encoding="utf-8").split()
        except OSError as error:
            raise ResultsError(
                f"{self.folder}: has no facts.txt; name the results folder of a laboratory test "
                "that came to its end"
            ) from error
        if len(pairs) % 2:
            raise ResultsError(f"{path}: '{pairs[-1]}' has no value; {REMEDY}")
        self.facts = dict(zip(pairs[::2], pairs[1::2]))
        self.kind = self.facts.get("test", "")
        if self.kind not in KINDS:
            raise ResultsError(f"{path}: test '{self.kind}' is not one of {', '.join(KINDS)}")

    def number(self, name: str) -> float:
        """A fact. @raises ResultsError where there is none, or it is no number"""
        with content_of(self.folder / "facts.txt", REMEDY):
            return float(self.facts[name])

    @property
    def numbers(self) -> dict[str, float]:
        """Facts that are numbers."""
        known = {name: number_or_text(text) for name, text in self.facts.items()}
        return {name: value for name, value in known.items() if isinstance(value, float)}

    @property
    def label(self) -> str:
        name = self.facts.get("ground", self.folder.name)
        if "confinement" not in self.facts:
            return name
        return f"{name}, {self.number('confinement') / 1e3:g} kPa"

    def curve(self) -> Floats:
        """(n, columns) of curve.txt (fix ave/time) without its first row, which has no forces yet.

        Plates: step, sinkage [m], force [N], pressure [Pa]. Cells: see cell_curve. @raises
        ResultsError for fewer than ten rows, too few columns, or what is no finite number
        """
        path, columns = self.folder / "curve.txt", COLUMNS.get(self.kind, 1)
        rows = read_matrix(path, 1)
        if len(rows) < 10:
            raise ResultsError(f"{path}: has fewer than ten rows; was the run stopped? {REMEDY}")
        if rows.shape[1] < columns or not np.isfinite(rows).all():
            raise ResultsError(
                f"{path}: a {self.kind} has {columns} columns of finite numbers; {REMEDY}"
            )
        return rows[1:]

    def grains(self, name: str) -> Floats:
        """(n, 4): x, y, z, radius [m] of a dump."""
        return read_matrix(self.folder / f"{name}.dump", 5, head=9)[:, 1:5]


def cell_curve(rows: Floats) -> tuple[Floats, Floats, Floats]:
    """Curves of the rows of fix cell/servo: strains (n, 3), stresses (n, 3) [Pa], density (n) [kg/m3].

    Strain is logarithmic; compression is positive. @raises ValueError for a cell without volume
    """
    edges = rows[:, 1:4]
    if not ((edges > 0).all() and (rows[:, 7] > 0).all()):
        raise ValueError("edges or densities of the cell are not above 0")
    return -np.log(edges / edges[0]), rows[:, 4:7], rows[:, 7]


class PointRun:
    """A run of furrow-point; columns: of its point.csv, SI."""

    def __init__(self, folder: Path | str) -> None:
        """@raises ResultsError where the folder has no point.csv"""
        self.folder = Path(folder)
        path = self.folder / "point.csv"
        if not path.is_file():
            raise ResultsError(
                f"{path}: no such file; name the results folder of 'furrow-point run'"
            )
        remedy = "run 'furrow-point run' again"
        self.columns = Fields(path, read_columns(path), remedy)
        self.columns.require_finite("axial_stress", "density")
        first = path.read_text(encoding="utf-8").splitlines()[0]
        self.label = first.lstrip("# ").split(" (")[0]


def read_oedometer_reference(path: Path) -> list[tuple[float, float]]:
    """(density [kg/m3], axial stress [Pa]), rising, of the columns rho_kgm3 and sigma1_Pa.

    @raises ResultsError where a column or rows are missing, or a number is not above 0
    """
    needed = "a reference of an oedometer has columns rho_kgm3 and sigma1_Pa of numbers above 0"
    with content_of(path, needed):
        pairs = sorted((row["rho_kgm3"], row["sigma1_Pa"]) for row in read_numbers(path))
        if not pairs or not (np.isfinite(pairs).all() and np.min(pairs) > 0):
            raise ValueError("no rows of such numbers")
        return pairs
