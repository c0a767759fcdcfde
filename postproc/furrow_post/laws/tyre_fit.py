# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits the parameters of a tyre file to tests on a rigid plane, computed by furrow-tyre.

The parameters' guesses count as measurements with their spreads, so that a fit has an answer for
any number of tests, and the change of a parameter's error by the tests shows what they determine.
Parameters x are logarithms over their guess, in units of its spread. With J the derivatives of the
tests' logarithms over their errors, the covariance of x is (J'J + 1)^-1. A singular value of J
above 1 is a combination of parameters that the tests determine better than the guesses do.
"""

import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd

from ..arrays import Floats
from ..csv_table import read_numbers
from ..errors import ResultsError
from ..programs import find_program
from ..run.tools import Refused, answer
from .fitter import NotComputed, Parameter, Residuals, Search, assess, fit, slopes
from .tyre_estimate import Catalogue, Guess, guesses, tyre_text

# Columns of a test, as furrow-tyre prints them -> relative error of a measurement
MEASURED = {"deflection_cm": 0.03, "perimeter_area_cm2": 0.05, "section_width_cm": 0.02}
# Steps of half a spread; slopes by differences once, which Broyden's updates keep, for each state takes furrow-tyre a second
SEARCH = Search(step=0.5, central=False, update=True, ftol=1e-3, xtol=1e-3, scale=1.0, evaluations=12)


@dataclass(frozen=True)
class PlateTest:
    """A tyre pressed on a rigid plane; what was measured, by names of MEASURED."""

    pressure: float  # [kPa]
    load: float  # [N]
    measured: dict[str, float]


def read_tests(path: Path) -> list[PlateTest]:
    """Rows with pressure_kPa, load_N and at least one column of MEASURED; empty: not measured.

    Rows without load, such as furrow-tyre's inflated tyre, are left out.
    @raises OSError, ResultsError
    """
    tests = []
    for number, row in enumerate(read_numbers(path), 1):
        if missing := {"pressure_kPa", "load_N"} - row.keys():
            raise ResultsError(f"{path}: has no column {', '.join(sorted(missing))}")
        if row["load_N"] == 0.0:
            continue
        measured = {name: row[name] for name in MEASURED if not math.isnan(row.get(name, math.nan))}
        if not (row["pressure_kPa"] > 0.0 and row["load_N"] > 0.0 and measured):
            needed = f"a pressure and a load above 0, and one of {', '.join(MEASURED)}"
            raise ResultsError(f"{path}: row {number} needs {needed}")
        if wrong := [name for name, value in measured.items() if value <= 0.0]:
            raise ResultsError(f"{path}: row {number}: {wrong[0]} must be above 0")
        tests.append(PlateTest(row["pressure_kPa"], row["load_N"], measured))
    if not tests:
        raise ResultsError(f"{path}: has no test; a row has pressure_kPa, load_N and what was measured")
    return tests


Mesh = tuple[int, int]  # elements across and around
States = list[dict[str, float]]
Solver = Callable[[str, Sequence[PlateTest], Mesh], States]
COARSE, FINE = (2, 60), (4, 72)


def press(text: str, tests: Sequence[PlateTest], mesh: Mesh = FINE) -> States:
    """The states of a tyre, given as the text of its file, under the tests' pressures and loads.

    @raises NotComputed with furrow-tyre's message, where there is no such tyre or it does not come to rest
    """
    program = find_program("furrow-tyre")
    states: dict[tuple[float, float], dict[str, float]] = {}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "tyre.yaml"
        file.write_text(text, encoding="utf-8")
        for pressure in sorted({test.pressure for test in tests}):
            loads = sorted({test.load for test in tests if test.pressure == pressure})
            command = [str(program), str(file), "--half", "--mesh", *map(str, mesh)]
            command += ["--pressure", f"{pressure!r}", "--load", *(f"{load!r}" for load in loads)]
            table = Path(folder) / "states.csv"
            try:
                table.write_text(answer(command), encoding="utf-8")
            except Refused as refused:
                raise NotComputed(refused.cause.replace(str(file), "the tyre")) from refused
            for load, row in zip(loads, read_numbers(table)[1:]):  # the first is without load
                states[pressure, load] = row
    return [states[test.pressure, test.load] for test in tests]


@dataclass(frozen=True)
class FittedTyre:
    """A parameter after the fit."""

    name: str
    value: float
    error: float  # relative standard error
    determined: float  # share of the guess's variance that the tests removed, 0 to 1
    guess: Guess

    def verdict(self) -> str:
        if self.determined > 0.7:
            return "determined by the tests"
        return "guess, improved by the tests" if self.determined > 0.2 else "guess"

    def note(self) -> str:
        text = f"{self.verdict()} ({100 * self.error:.0f} %)"
        return text if self.determined > 0.7 else f"{text}: {self.guess.source}"


@dataclass(frozen=True)
class TyreFit:
    """The result of a fit, or of an estimate without tests."""

    known: Catalogue
    tests: Sequence[PlateTest]
    states: Sequence[dict[str, float]]  # of the fitted tyre in the tests
    parameters: list[FittedTyre]
    singular_values: Floats  # of J, falling
    correlation: Floats
    stretch: float  # factor on the assumed errors of the tests, from the misfit

    def values(self) -> dict[str, float]:
        return {parameter.name: parameter.value for parameter in self.parameters}

    def misfits(self) -> dict[str, float]:
        """rms relative misfit of each measured quantity."""
        measured = pd.DataFrame([test.measured for test in self.tests])
        computed = pd.DataFrame(list(self.states), columns=measured.columns)
        return dict((computed / measured - 1.0).pow(2).mean().pow(0.5))

    def file_text(self, title: str, comments: list[str]) -> str:
        notes = {parameter.name: parameter.note() for parameter in self.parameters}
        return tyre_text(title, comments, self.known, self.values(), notes)


def fit_tyre(known: Catalogue, tests: Sequence[PlateTest], solve: Solver = press) -> TyreFit:
    """@raises ResultsError where the guessed tyre does not come to rest in all tests"""
    start = guesses(known)
    # x: logarithm over the guess, in units of its spread
    parameters = [Parameter(name, "", 0.0, -math.inf, math.inf, spread=1.0) for name in start]
    errors = np.array([MEASURED[name] for test in tests for name in test.measured])
    solved = cache(lambda text, mesh: solve(text, tests, mesh))

    def values(x: Floats) -> dict[str, float]:
        pairs = zip(start.items(), x)
        return {name: float(guess.value * math.exp(guess.spread * shift)) for (name, guess), shift in pairs}

    def states(x: Floats, mesh: Mesh) -> States:
        try:
            text = tyre_text("trial", [], known, values(x), dict.fromkeys(start, ""))
        except ResultsError as error:
            raise NotComputed(str(error)) from error
        found: States = solved(text, mesh)
        return found

    def misfit(x: Floats, mesh: Mesh) -> Floats:
        """Logarithms over measurements, in errors of a measurement."""
        pairs = zip(tests, states(x, mesh))
        ratios = [state[name] / value for test, state in pairs for name, value in test.measured.items()]
        logarithms: Floats = np.log(ratios) / errors
        return logarithms

    def coarse(at: Floats) -> Residuals:
        """Misfit by a coarse mesh, which at one place reproduces that by the fine one."""
        correction = misfit(at, FINE) - misfit(at, COARSE)
        return lambda x: misfit(x, COARSE) + correction

    found = assess(parameters, np.zeros(len(start)), np.zeros(0), np.zeros((0, len(start))))
    if tests:
        found = fit(parameters, coarse(found.z), SEARCH)
        slope = slopes(parameters, coarse(found.z), found.z, SEARCH)
        found = assess(parameters, found.z, misfit(found.z, FINE), slope)
    results = zip(start.items(), values(found.z).values(), found.parameters)
    fitted = [
        FittedTyre(name, value, guess.spread * one.deviation, one.share, guess)
        for (name, guess), value, one in results
    ]
    at_end, singular = states(found.z, FINE) if tests else [], found.singular_values / found.scatter
    return TyreFit(known, tests, at_end, fitted, singular, found.correlation, found.scatter)
