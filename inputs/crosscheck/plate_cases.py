# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates on several grounds, with formulas and measurements."""

import math
from collections.abc import Iterator

import numpy as np

from cases import BASE, INPUTS, Made, Planned
from lines import OutputRow, line_of
from wheel_cases import BEKKER

from furrow_post.analyse import curves, plates
from furrow_post.uncertainty.budget import Budget
from furrow_post.analyse.curves import Curve
from furrow_post.uncertainty.verdict import FORMULA, MEASURED, Entry
from furrow_post.laws.terrain_values import terrain
from furrow_post.csv_table import read_numbers
from furrow_post.figures.curves_figure import Line, draw_curves
from furrow_post.study.study_files import Output

MEASURED_PLATE = INPUTS / "validation" / "snow_plate" / "reference.csv"
# [m], deeper than a grain
LEVELS = {"plate_on_snow": (0.1, 0.2286), "plate_on_sand": (0.03, 0.045)}


class PlateCase:
    """The bases of a case, each with the curves of its checks."""

    def __init__(self, case: str, made: Made) -> None:
        self.case, self.made = case, made
        self.bases = [planned for planned in made.plans if planned.role == BASE]
        self.curves = {planned.run.name: self.read(planned) for planned in made.plans}

    def read(self, planned: Planned) -> Curve:
        return curves.read_curve(self.made.folder(planned), planned.ground)

    def entries(self, planned: Planned, level: float) -> list[Entry]:
        checks = [
            self.curves[other.run.name]
            for other in self.made.plans
            if other.is_check and other.ground == planned.ground
        ]
        return plates.plate_entries(self.curves[planned.run.name], checks, level)

    def lines(self) -> Iterator[OutputRow]:
        for level in LEVELS[self.case]:
            for planned in self.bases:
                size = self.curves[planned.run.name].size
                for entry in self.entries(planned, level):
                    yield line_of(self.case, BASE, entry, size, self.made.program(planned))
            for entry in (*self.formulas(level), *self.measured(level)):
                yield line_of(self.case, BASE, entry)

    def formulas(self, level: float) -> Iterator[Entry]:
        for line in self.formula_lines():
            pressure = float(np.interp(level, line.x, line.y))
            yield Entry(plates.pressure_at(level), line.label, pressure, Budget(), FORMULA)

    def formula_lines(self) -> list[Line]:
        """Formulas for the plate on sand; b of a round plate is its radius."""
        if "sand" not in self.case:
            return []
        z = np.linspace(1e-3, max(LEVELS[self.case]), 60)
        radius = 0.5 * next(iter(self.curves.values())).facts["size"]
        return [
            Line(f"Bekker, {name}", z, terrain(name).plate_pressure(z, radius))
            for name in BEKKER
        ]

    def measured(self, level: float) -> Iterator[Entry]:
        """The peak of the load, where the plate was pushed that far."""
        if "snow" not in self.case:
            return
        for row in read_numbers(MEASURED_PLATE):
            if math.isclose(row["sinkage_m"], level):
                pressure = row["peak_load_N"] / (0.25 * math.pi * row["diameter_m"] ** 2)
                yield Entry(plates.pressure_at(level), MEASURED, pressure, Budget(), MEASURED)

    def draw(self, output: Output) -> None:
        result = curves.compare_curves(
            [self.curves[planned.run.name] for planned in self.bases], anyway=True
        )
        draw_curves(result, output.path(f"{self.case}.png"), formulas=self.formula_lines())
