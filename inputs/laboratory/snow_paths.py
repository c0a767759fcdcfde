# SPDX-License-Identifier: GPL-2.0-or-later
"""The laboratory tests on clusters of snow as paths of a material point, run by furrow-point."""

import math
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np

from snow_record import STRAINS, TRIAXIAL_STRAIN, Row, Values

from furrow_post.analyse.evaluations import last_piece
from furrow_post.laws.fitter import NotComputed
from furrow_post.laws.point_curves import PointPaths
from furrow_post.arrays import Floats
from furrow_post.run.tools import Tools

TENSION_STRAIN = 0.03  # strain at which every law here has reached its tensile strength
REBOUND = 0.1  # of strain when compacted snow is released, at most
SHEAR_STRAIN = 0.2  # up to which shear is compared

Columns = dict[str, Floats]
Evaluation = tuple[str, Callable[[Columns, Row], float]]  # a path, and a row's value on it
Run = Callable[[str], Columns | None]  # a path on the law


class Points(PointPaths):
    """Paths of furrow-point, in one folder."""

    def __init__(self, tools: Tools, folder: Path) -> None:
        super().__init__(tools.program("furrow-point"))
        self.folder = folder

    def run(self, sections: str, path: str) -> Columns | None:
        """Columns of point.csv; None where the law finds no state on the path."""
        material = self.folder / "material.yaml"
        material.write_text(f"title: snow\n{sections}", encoding="utf-8")
        try:
            return self(material, path)
        except NotComputed:
            return None


def confined(stresses: Iterable[float]) -> str:
    """Confined compression, a segment to each axial stress [Pa]."""
    return f"{{type: confined, stress: [{', '.join(f'{s:.6g}' for s in stresses)}], steps: 20}}"


def end_of(columns: Columns, segment: int) -> int:
    """Number of the last row of a segment; the first segment is 1."""
    return int(np.flatnonzero(columns["segment"] == segment)[-1])


def _oedometer(_: float, __: float, rows: Sequence[Row], ___: Run) -> Evaluation:
    levels = sorted({row.level for row in rows} - {0.0})

    def value(columns: Columns, row: Row) -> float:
        if not row.level:
            return float(columns["density"][0])
        end = end_of(columns, levels.index(row.level) + 1)
        if row.quantity == "density":
            return float(columns["density"][end])
        return float(columns["stress_xx"][end] / columns["stress_zz"][end])

    return confined(levels), value


def _after_compaction(compaction: float, strain: float) -> str:
    """Confined compression, release, then axial strain (tension positive) with free sides. Targets
    are strains from the start, so what the law gives back when released comes on top."""
    released = "{stress_xx: 0, stress_yy: 0, stress_zz: 0}"
    before = f"{{strain_zz: {-compaction:.6g}}}, {released}, " if compaction else ""
    last = f"{{stress_xx: 0, stress_yy: 0, strain_zz: {strain - compaction:.6g}}}"
    return f"{{type: table, steps: 400, rows: [{before}{last}]}}"


def _last(columns: Columns) -> tuple[Floats, Floats, Floats]:
    """Last piece of a path: axial and lateral strain since its start, axial stress;
    compression positive."""
    piece = last_piece(columns)
    axial, lateral = -piece["strain_zz"], -piece["strain_xx"]
    return axial - axial[0], lateral - lateral[0], -piece["stress_zz"]


def _tension(compaction: float, _: float, __: Sequence[Row], ___: Run) -> Evaluation:
    def value(columns: Columns, row: Row) -> float:
        axial, _, stress = _last(columns)
        if row.quantity == "strength":
            return float(np.max(-stress))
        return float(stress[1] / axial[1])

    return _after_compaction(compaction, TENSION_STRAIN + REBOUND), value


def _unconfined(compaction: float, _: float, __: Sequence[Row], ___: Run) -> Evaluation:
    def value(columns: Columns, row: Row) -> float:
        axial, lateral, stress = _last(columns)
        if row.quantity == "stress":
            return float(np.interp(row.level, axial, stress))
        return float(-np.interp(row.level, axial, lateral) / row.level)

    return _after_compaction(compaction, -STRAINS[-1] - REBOUND), value


def _shear(compaction: float, normal: float, _: Sequence[Row], run: Run) -> Evaluation:
    """Confined compression and release from all sides; then the normal stress, and shear of level
    planes under it, between sides that stay where the release has left them."""
    head = "type: table, motion: shear, steps: 400"
    before = ""
    if compaction:
        released = "{stress_xx: 0, stress_yy: 0, stress_zz: 0}"
        before = f"{{strain_zz: {-compaction:.6g}}}, {released}"
        columns = run(f"{{{head}, rows: [{before}]}}")
        side = 0.0 if columns is None else columns["strain_xx"][-1]
        before += f", {{strain_xx: {side:.9g}, strain_yy: {side:.9g}, stress_zz: 0}}, "
    rows = f"{before}{{stress_zz: {-normal:.6g}}}, {{strain_xz: {SHEAR_STRAIN:g}}}"

    def value(columns: Columns, row: Row) -> float:
        piece = last_piece(columns)
        if row.quantity == "density":
            return float(piece["density"][0])
        return float(np.max(np.abs(piece["stress_xz"])))

    return f"{{{head}, rows: [{rows}]}}", value


def _triaxial(_: float, confinement: float, __: Sequence[Row], ___: Run) -> Evaluation:
    strain = f"axial_strain: [{TRIAXIAL_STRAIN:g}]"
    path = f"{{type: triaxial, confinement: {confinement:g}, {strain}, steps: 400}}"

    def value(columns: Columns, row: Row) -> float:
        axial, lateral, stress = _last(columns)
        if row.quantity == "deviator":
            return float(np.interp(row.level, axial, stress)) - confinement
        if row.quantity == "lateral_ratio":
            return float(-np.interp(row.level, axial, lateral) / row.level)
        return float(np.interp(row.level, axial, columns["density"][-len(axial) :]))

    return path, value


PATHS: dict[str, Callable[[float, float, Sequence[Row], Run], Evaluation]] = {
    "oedometer": _oedometer,
    "tension": _tension,
    "unconfined": _unconfined,
    "shear": _shear,
    "triaxial": _triaxial,
}


def predicted(sections: str, record: Sequence[Row], points: Points) -> Values:
    """Values of a law in each place of a record; NaN where it has no state."""
    found: Values = {}
    paths: dict[tuple[str, float, float], list[Row]] = {}
    for row in record:
        paths.setdefault((row.test, row.compaction, row.confinement), []).append(row)
    for (test, compaction, confinement), rows in paths.items():
        path, evaluate = PATHS[test](
            compaction, confinement, rows, lambda way: points.run(sections, way)
        )
        columns = points.run(sections, path)
        for row in rows:
            found[row.place] = math.nan if columns is None else evaluate(columns, row)
    return found
