# SPDX-License-Identifier: GPL-2.0-or-later
"""Files of a sweep: sweep.csv, sweep.h5, sweep.png and report.html in a folder, and parts.png
where the runs know what their resistance is made of."""

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..uncertainty import cost_table
from ..laws.empirical import require_formulas
from ..errors import ResultsError
from ..figures.page import condition_rows, render
from ..figures.resistance_parts import CAPTION as PARTS_CAPTION
from ..csv_table import in_columns
from .cone_band import ConeBand, cone_bands
from .sweep_curves import Figure, arrange
from .drawing import CAPTION, draw_parts_of_sweep, draw_sweep
from .sweep_formulas import FormulaLine, formula_lines
from .sweep_measured import MeasuredPoints, read_measured_points, require_measured
from .series import Series, read_series, uniquely_labelled
from .table import shown_rows, write_table

TABLE, NUMBERS, PICTURE, REPORT = "sweep.csv", "sweep.h5", "sweep.png", "report.html"
PARTS = "parts.png"  # of the resistance


@dataclass(frozen=True)
class Named:
    """A folder or file, and its name in tables and legends."""

    path: Path
    label: str | None = None


@dataclass(frozen=True)
class Wanted:
    """Settings of a sweep's figure: its x axis, and references to draw beside the curves."""

    against: str | None = None  # condition on the x axis; None: the first variable of the sweep
    errors: Path | None = None  # table of runs of the scene (inputs/costs)
    formulas: Sequence[str] = ()
    measured: Sequence[Named] = ()
    extrapolate: bool = False

    def check(self) -> None:
        """@raises ResultsError for a formula or a file that there is none of"""
        require_formulas(self.formulas)
        for file in (*self.measured, *([Named(self.errors)] if self.errors else [])):
            if not file.path.is_file():
                raise ResultsError(f"{file.path}: no such file")
        for file in self.measured:
            require_measured(file.path)


@dataclass(frozen=True)
class SweepResult:
    """Data of the figures of a sweep."""

    series: Sequence[Series]
    figure: Figure
    formulas: Sequence[FormulaLine]
    bands: Sequence[ConeBand]
    measured: Sequence[MeasuredPoints]

    def remarks(self) -> list[str]:
        """Remarks on runs that are not in the curves, one sentence each."""
        found = []
        for one in self.series:
            found += [f"{one.label}: {r.folder} failed: {r.text}" for r in one.failures]
            found += [f"{one.label}: {r.folder} gave no values: {r.text}" for r in one.unread]
            found += [f"{one.label}: {r.folder}: {r.text}" for r in one.unsteady]
            if len(one.makers) > 1:
                found.append(f"{one.label}: its points are of different programs or scripts; repeat the command that made the sweep")
            if one.missing:
                names = ", ".join(one.missing)
                found.append(f"{one.label}: {len(one.missing)} points were not run: {names}")
        points = [point for one in self.series for point in one.points]
        moving = sum(not point.steady for point in points)
        if moving:
            found.append(
                f"{moving} of {len(points)} points are not called steady in hub drop and "
                "resistance; the reasons are in their summary.txt"
            )
        imposed = dict.fromkeys(
            name.replace("_", " ")
            for point in points
            for name, value in point.quantities.items()
            if value.imposed
        )
        if imposed:
            found.append(f"imposed by the script, without an error: {', '.join(imposed)}")
        found += [note for note in (*(one.note for one in self.formulas), *(one.note for one in self.bands)) if note]
        return found + [text for band in self.bands for curve in self.figure.curves for text in band.departures(curve.y)]


def evaluate(folders: Sequence[Named], wanted: Wanted) -> SweepResult:
    """@raises ResultsError where no point has values, or the axes are not determined"""
    wanted.check()
    families = {}
    if wanted.errors:
        families = cost_table.families(cost_table.read_table(wanted.errors)[0])
    series = uniquely_labelled([read_series(f.path, f.label, families) for f in folders])
    if not any(one.points for one in series):
        reasons = [r.text for one in series for r in (*one.failures, *one.unread)]
        why = f": {reasons[0]}" if reasons else ""
        raise ResultsError(f"{folders[0].path}: no point has steady values of a wheel{why}")
    figure = arrange(series, wanted.against)
    measured = [
        points
        for file in wanted.measured
        for points in read_measured_points(file.path, file.label, figure)
    ]
    formulas = formula_lines(figure.lines, wanted.formulas, wanted.extrapolate)
    return SweepResult(series, figure, formulas, cone_bands(figure.lines), measured)


def write_sweep(result: SweepResult, folder: Path) -> list[str]:
    """All files of the result, each in one step. @return their names"""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder, prefix=".sweep") as scratch:
        part = Path(scratch)
        write_table(result.series, part / TABLE, part / NUMBERS)
        draw_sweep(result.figure, result.formulas, result.measured, part / PICTURE, result.bands)
        parts = part / PARTS if draw_parts_of_sweep(result.figure, part / PARTS) else None
        (part / REPORT).write_text(_page(result, part / PICTURE, parts), encoding="utf-8")
        names = sorted(file.name for file in part.iterdir())
        for name in names:
            (part / name).replace(folder / name)
        return names


def report_lines(result: SweepResult) -> list[str]:
    """The table of the figure for a terminal, and the remarks."""
    head, rows = shown_rows(result.figure)
    lines = [line.rstrip() for line in in_columns([head, *rows])]
    return [*lines, "", CAPTION_OF_TABLE, *result.remarks()]


CAPTION_OF_TABLE = "± is one standard error, from the parts that are known."


def _page(result: SweepResult, picture: Path, parts: Path | None) -> str:
    names = [curve.name for curve in result.figure.curves]
    title = " and ".join(dict.fromkeys(one.title for one in result.series))
    head, rows = shown_rows(result.figure)
    lines = [line for line in result.figure.lines if line.points]
    # Conditions that the sweep changes are in the points
    runs = [line.points[0].runs[0] for line in lines]
    return render(
        "sweep.html",
        f"{title}: {', '.join(names)}",
        curves=picture,
        caption=CAPTION,
        parts=parts,
        parts_caption=PARTS_CAPTION,
        head=head,
        rows=rows,
        caption_of_table=CAPTION_OF_TABLE,
        remarks=result.remarks(),
        conditions_head=["", *(line.label for line in lines)],
        conditions=condition_rows(runs, result.figure.x.key),
        numbers=(TABLE, NUMBERS),
    )
