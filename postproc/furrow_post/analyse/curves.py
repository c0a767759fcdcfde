# SPDX-License-Identifier: GPL-2.0-or-later
"""Comparison of curves on grains, on continuum, as measured.

Plates: pressure against sinkage. Their folder has curve.txt (fix ave/time: step, sinkage [m], force
[N], pressure [Pa]) and facts.txt (name value pairs). Oedometers: compression against stress. Their
folder is one of inputs/laboratory, or one of furrow-point (point.csv).
"""

import enum
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from ..arrays import Floats
from ..csv_table import in_cells, write_rows
from ..errors import ResultsError, content_of
from ..formatting import percent
from ..read.laboratory import LaboratoryTest, PointRun, cell_curve
from ..read.ground_kinds import ground_kind
from ..uncertainty.statistics import rms
from ..uncertainty.verdict import COVERAGE, conclusion
from .conditions import Difference, Tolerance, require_comparable, require_different_labels

PLATE_LEVELS = (0.05, 0.1, 0.2, 0.3, 0.5)  # sinkage over depth of the ground
STRESS_LEVELS = (2e3, 1e4, 5e4, 1e5, 2e5, 5e5)  # [Pa]
PARTS = 40  # of the curve of a plate, each with its mean
SAME = 1e-3  # of a value: curves of material points without an error agree within it
TOLERANCES = {"size": Tolerance(0.02), "depth": Tolerance(0.06), "density": Tolerance(0.1), "speed": Tolerance(0.02)}


class CurveKind(enum.Enum):
    """Kind of a curve: its quantities x and y."""

    PLATE = "plate"  # sinkage [m], pressure [Pa]
    OEDOMETER = "oedometer"  # axial stress [Pa], density over that at the start

    @property
    def compared(self) -> str:
        if self is CurveKind.PLATE:
            return "pressure at equal sinkage"
        return "compression (density over that at the start) at equal stress"

    def level_text(self, level: float) -> str:
        """Text of a value of x."""
        if self is CurveKind.PLATE:
            return f"{1e3 * level:.3g} mm"
        return f"{level / 1e3:.3g} kPa"


@dataclass
class Curve:
    """A curve of one test; x rises."""

    label: str
    kind: CurveKind
    ground: str  # grains, continuum, made, ...
    x: Floats
    y: Floats
    facts: dict[str, float]  # size, depth, box [m], density [kg/m3], cell, diameter [m], ...
    noise: Floats  # standard deviation about the smoothed curve, in y's unit

    @property
    def size(self) -> float:
        """Size of cells or grains [m], NaN where it is not known."""
        return self.facts.get("cell", self.facts.get("diameter", math.nan))

    @property
    def unknown(self) -> list[str]:
        """Unknown parts of the error, for example "size of soft"; none for a material point."""
        parts = ["domain"] if self.kind is CurveKind.PLATE else []
        if ground_kind(self.ground).random:
            parts.append("packing")
        if parts:
            parts.append("size")
        return [f"{part} of {self.label}" for part in parts]

    @property
    def box(self) -> float:
        """Width of the ground [m], NaN where it is not known."""
        return self.facts.get("box", math.nan)


def is_curve(folder: Path | str) -> bool:
    """True where a results folder is that of a plate or an oedometer."""
    return any((Path(folder) / name).is_file() for name in ("facts.txt", "point.csv"))


def read_curve(folder: Path | str, label: str | None = None) -> Curve:
    """@raises ResultsError for a folder of another test"""
    folder = Path(folder)
    if (folder / "point.csv").is_file():
        point = PointRun(folder)
        return _oedometer(label or point.label, "continuum", *_compression(point), {})
    test = LaboratoryTest(folder)
    if test.kind == "plate":
        return _plate(label or folder.name, test)
    if test.kind != "oedometer":
        raise ResultsError(f"{folder}: compare takes plates and oedometers, not '{test.kind}'")
    with content_of(folder, "run the test again"):
        _, stress, density = cell_curve(test.curve())
    # the density of the facts is of a grain's substance
    return _oedometer(label or test.label, "grains", stress[:, 2], density, test.numbers)


def _plate(label: str, test: LaboratoryTest) -> Curve:
    """Means over equal parts of the curve, and the standard error of each."""
    rows = test.curve()
    rows = rows[rows[:, 1] > 0]
    if len(rows) < 2:
        raise ResultsError(f"{test.folder}: the plate does not come into the ground; run it longer")
    groups = np.array_split(rows[:, [1, 3]], min(PARTS, len(rows)))
    x, y = np.array([group.mean(axis=0) for group in groups]).T
    noise = [group[:, 1].std(ddof=1) / math.sqrt(len(group)) if len(group) > 1 else 0.0 for group in groups]
    return Curve(label, CurveKind.PLATE, test.facts.get("family", "grains"), x, y, test.numbers, np.array(noise))


def _compression(point: PointRun) -> tuple[Floats, Floats]:
    """Axial stress [Pa] and density [kg/m3] of a path. @raises ResultsError where it is no compression"""
    stress, density = point.columns["axial_stress"], point.columns["density"]
    if len(stress) < 2 or not (stress.max() > 1.0 and density.min() > 0):
        raise ResultsError(
            f"{point.columns.file}: is no compression; compare takes oedometers ('furrow-point "
            "run' of a confined path)"
        )
    return stress, density


def _oedometer(label: str, ground: str, stress: Floats, density: Floats, facts: dict[str, float]) -> Curve:
    """Curve of an oedometer up to the greatest stress."""
    end = int(np.argmax(stress)) + 1
    floor = 1e-3 if ground == "grains" else 1.0  # [Pa]
    rising = np.maximum.accumulate(stress[:end])
    kept = rising > 1.0 if ground == "continuum" else np.full(end, True)
    x, y = np.maximum(rising, floor)[kept], (density[:end] / density[0])[kept]
    return Curve(label, CurveKind.OEDOMETER, ground, x, y, {**facts, "density": float(density[0])}, np.zeros(len(x)))


@dataclass
class CurveComparison:
    """Curves at common levels of x, the first against the others."""

    curves: list[Curve]
    levels: list[float]
    values: Floats  # (levels, curves)
    errors: Floats  # (levels, curves): noise of the curves, in y's unit
    findings: list[str] = field(default_factory=list)
    differences: list[Difference] = field(default_factory=list)  # of conditions, compared all the same

    @property
    def kind(self) -> CurveKind:
        return self.curves[0].kind

    @property
    def unknown(self) -> list[str]:
        return [part for curve in self.curves for part in curve.unknown]

    def verdict(self) -> str:
        """The curves agree, differ, or that is inconclusive, in one line."""
        if self.unknown:
            return f"Inconclusive in {self.kind.compared}; unknown: {', '.join(self.unknown)}."
        allowed = COVERAGE * np.hypot(self.errors[:, 1:], self.errors[:, :1]) + SAME * self.values[:, :1]
        agree = bool(np.all(np.abs(self.values[:, 1:] - self.values[:, :1]) <= allowed))
        return f"The curves {'agree' if agree else 'differ'} in {self.kind.compared}."


def compare_curves(curves: Sequence[Curve], anyway: bool = False) -> CurveComparison:
    """Values at common levels. @raises ResultsError where tests are not the same"""
    require_different_labels("curves", [curve.label for curve in curves])
    if len({curve.kind for curve in curves}) > 1:
        what = ", ".join(f"{c.label} is a {c.kind.value}" for c in curves)
        raise ResultsError(f"these tests are not comparable: {what}")
    kind, differences = curves[0].kind, _differences(curves)
    require_comparable("tests", differences, anyway)
    plate = kind is CurveKind.PLATE
    depth = curves[0].facts.get("depth", 1.0)
    wanted = [share * depth for share in PLATE_LEVELS] if plate else list(STRESS_LEVELS)
    levels = [v for v in wanted if all(c.x[0] <= v <= c.x[-1] for c in curves)]
    if not levels:
        ranges = "; ".join(f"{c.label}: {c.x[0]:.3g} to {c.x[-1]:.3g}" for c in curves)
        raise ResultsError(f"these tests have no common range: {ranges}")
    values = np.column_stack([_at_levels(c, levels, c.y) for c in curves])
    errors = np.column_stack([_at_levels(c, levels, c.noise) for c in curves])
    result = CurveComparison(list(curves), levels, values, errors, differences=differences)
    for k, curve in enumerate(curves[1:], 1):
        ratio = np.log(values[:, k] / values[:, 0])
        worst = int(np.argmax(np.abs(ratio)))
        mean, most = (percent(math.exp(v) - 1) for v in (ratio.mean(), ratio[worst]))
        result.findings.append(
            f"{kind.compared}: {curve.label} over {curves[0].label}: {mean} on average, "
            f"rms ln-ratio {rms(ratio):.3f}, most at {kind.level_text(levels[worst])}: {most}"
        )
    return result


def _at_levels(curve: Curve, levels: Sequence[float], y: Floats) -> Floats:
    """y at the levels, interpolated in x, of oedometers in ln x."""
    if curve.kind is CurveKind.OEDOMETER:
        return np.interp(np.log(levels), np.log(curve.x), y)
    return np.interp(levels, curve.x, y)


def _differences(curves: Sequence[Curve]) -> list[Difference]:
    """Facts that differ beyond TOLERANCES."""
    differences = []
    for name, tolerance in TOLERANCES.items():
        have = {curve.label: curve.facts[name] for curve in curves if name in curve.facts}
        if len(have) > 1 and tolerance.exceeded(list(have.values())):
            texts = "; ".join(f"{label}: {value:.4g}" for label, value in have.items())
            differences.append(Difference(name, f"{texts} ({tolerance.text()})"))
    return differences


def curve_report(result: CurveComparison) -> str:
    """Text with the table and the result."""
    plate = result.kind is CurveKind.PLATE
    wide = max([len(c.label) for c in result.curves] + [12]) + 2
    scale, unit = (1e-3, "kPa") if plate else (1.0, "density over that at the start")
    head = "".join(f"{c.label:>{wide}}" for c in result.curves)
    lines = [f"{'sinkage' if plate else 'axial stress':14}{head}   [{unit}]"]
    for level, row in zip(result.levels, result.values):
        cells = "".join(f"{scale * v:{wide}.4g}" for v in row)
        lines.append(f"{result.kind.level_text(level):14}{cells}")
    lines += ["", *(f"COMPARED ALTHOUGH THEY DIFFER: {d.condition}: {d.text}" for d in result.differences)]
    return "\n".join([*lines, *conclusion([result.verdict()], result.findings, result.unknown)])


def write_curves(result: CurveComparison, folder: Path) -> None:
    """Writes compare.txt, compare.csv and compare.h5."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compare.txt").write_text(curve_report(result) + "\n", encoding="utf-8")
    names = ["level", *(c.label for c in result.curves)]
    rows = [dict(zip(names, row)) for row in np.column_stack([result.levels, result.values]).tolist()]
    head = "# plate: sinkage [m], pressure [Pa]; oedometer: axial stress [Pa], density over that at the start"
    write_rows(folder / "compare.csv", [in_cells(row, 6) for row in rows], [head])
    with h5py.File(folder / "compare.h5", "w") as content:
        for c in result.curves:
            group = content.create_group(f"curves/{c.label.replace('/', '_')}")
            group["x"], group["y"] = c.x, c.y
            group.attrs["kind"], group.attrs["ground"] = c.kind.value, c.ground
