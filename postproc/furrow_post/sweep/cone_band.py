# SPDX-License-Identifier: GPL-2.0-or-later
"""Formulas of the cone index of the ground for the runs of a tyre: mean, band, and values outside of the band."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import ResultsError
from ..laws.cone_files import Soil, formula_tyre, soil_of
from ..laws.cone_formulas import Formulas, Tyre, formulas_for
from ..read.wheel_run import WheelRun
from ..uncertainty.verdict import COVERAGE
from .sweep_curves import PULL, RESISTANCE, TORQUE, Axis, Line

SHELL_TYRE = "tyre/darnell"
ROLLING = 1e-6  # slip for formulas of a towed tyre
# Axis -> quantity of the formulas. Those of clay have no tyre that skids.
DRIVEN = {PULL: "net", TORQUE: "gross"}
TOWED = {"sand": {RESISTANCE: "towed_resistance"}, "clay": {RESISTANCE: "resistance"}}


@dataclass(frozen=True)
class ConeBand:
    """Formulas at the points of a line, within their ranges."""

    line: Line
    soil: Soil
    formulas: tuple[Formulas | None, ...]  # of each point; None without an answer
    note: str  # reason why points lack a band; empty if all have one

    @property
    def label(self) -> str:
        return f"formulas, cone index {1e-3 * self.soil.cone_index:.0f} kPa ({self.line.label})"

    def values(self, y: Axis) -> list[tuple[float, float, float, float]]:
        """Rows of x, mean, minimum and maximum; empty if no formula gives y."""
        found = []
        for x, formulas, point in zip(self.line.x, self.formulas, self.line.points):
            quantity = (TOWED[self.soil.kind] if _is_towed(point.runs[0]) else DRIVEN).get(y, "")
            band = formulas.band(quantity) if formulas and quantity else None
            found += [(x, *band)] if band else []
        return found

    def departures(self, y: Axis) -> list[str]:
        """A sentence for each value further than two whole errors from the band; not where the model's error is unknown."""
        bands = {x: band for x, *band in self.values(y)}
        found = []
        for x, point, value in self.line.values(y):
            if x in bands and not math.isnan(value.parts.model):
                _, least, greatest = bands[x]
                if max(least - value.mean, value.mean - greatest) > COVERAGE * value.uncertainty:
                    found.append(
                        f"{self.line.label}, {point.name}: {y.name} {value.mean:.2f} ± {value.uncertainty:.2g} is outside of the "
                        f"formulas, {least:.2f} to {greatest:.2f}"
                    )
        return found


def cone_bands(lines: Sequence[Line]) -> list[ConeBand]:
    """Bands of the lines all of whose runs have a tyre on one soil of known cone index."""
    found = []
    for line in lines:
        try:
            soils = {_soil_of(run) for point in line.points for run in point.runs}
        except ResultsError as error:
            note = f"{line.label}: no formulas of a cone index: {error}"
            found.append(ConeBand(line, Soil("", math.nan), tuple(None for _ in line.points), note))
            continue
        if len(soils) == 1 and (soil := soils.pop()):
            found.append(_band(line, soil))
    return found


def _band(line: Line, soil: Soil) -> ConeBand:
    formulas: list[Formulas | None] = []
    reasons = []
    for point in line.points:
        run = point.runs[0]
        try:
            slip = ROLLING if _is_towed(run) else run.number("slip")
            formulas.append(formulas_for(soil.kind, soil.cone_index, _tyre_of(run), slip))
        except ResultsError as error:
            formulas.append(None)
            reasons.append(f"{line.label}: no formula at {point.name}: {error}")
    return ConeBand(line, soil, tuple(formulas), reasons[0] if reasons else "")


def _is_towed(run: WheelRun) -> bool:
    return run.text("mode") == "towed"


def _soil_of(run: WheelRun) -> Soil | None:
    """None without a shell tyre on one material, or where the material has no cone index. @raises ResultsError"""
    if run.ground != "continuum" or not run.deformable:
        return None
    styles = run.results.styles()
    wheel, ground = styles.of_kind("wheel"), styles.of_kind("terrain")
    if wheel is None or wheel.style != SHELL_TYRE or ground is None:
        return None
    if not ground.has("material") or ground.has("patches"):
        return None
    file = _file(run, ground.text("material"))
    return soil_of(file) if file.is_file() else None


def _file(run: WheelRun, name: str) -> Path:
    """A file that a script names, from the folder of the script on."""
    return Path(run.results.run.get("script", "")).parent / name


def _tyre_of(run: WheelRun) -> Tyre:
    """@raises ResultsError where the tyre's file is gone"""
    style = run.results.styles().of_kind("wheel")
    assert style is not None  # of a run with a tyre
    return formula_tyre(_file(run, style.text("file")), run.number("pressure"), run.number("load"))
