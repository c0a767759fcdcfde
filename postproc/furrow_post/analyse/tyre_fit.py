# SPDX-License-Identifier: GPL-2.0-or-later
"""Fits the parameters of a tyre file to tests on a rigid plane, computed by furrow-tyre.

The parameters' guesses count as measurements with their spreads, so that a fit has an answer for
any number of tests, and the change of a parameter's error by the tests says what they determine.
Parameters x are logarithms over their guess, in units of its spread. With J the derivatives of the
tests' logarithms over their errors, the covariance of x is (J'J + 1)^-1. A singular value of J
above 1 is a combination of parameters that the tests determine better than the guesses do.
"""

import math
import subprocess
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..csv_table import read_numbers
from ..errors import ResultsError
from ..programs import find_program
from .tyre_estimate import Catalogue, Guess, guesses, tyre_sections, tyre_text

# Columns of a test, as furrow-tyre prints them -> relative error of a measurement
MEASURED = {"deflection_cm": 0.03, "perimeter_area_cm2": 0.05, "section_width_cm": 0.02}
STEP = 0.5  # of the derivatives, in units of x
STEPS, HALVINGS = 6, 4  # of one series of Gauss-Newton steps, and of one step
CONVERGED = 0.05  # length of a step, in units of x
CORRECTIONS = 1  # of the coarse mesh by the fine one after the first


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
            raise ResultsError(
                f"{path}: row {number} needs a pressure and a load above 0, and one of "
                f"{', '.join(MEASURED)}"
            )
        if wrong := [name for name, value in measured.items() if value <= 0.0]:
            raise ResultsError(f"{path}: row {number}: {wrong[0]} must be above 0")
        tests.append(PlateTest(row["pressure_kPa"], row["load_N"], measured))
    if not tests:
        raise ResultsError(
            f"{path}: has no test; a row has pressure_kPa, load_N and what was measured"
        )
    return tests


class NotAtRest(ResultsError):
    """There is no such tyre, or furrow-tyre does not bring it to rest."""


Mesh = tuple[int, int]  # elements across and around
States = list[dict[str, float]]
Solver = Callable[[str, Sequence[PlateTest], Mesh], States]
COARSE, FINE = (2, 60), (4, 72)


def press(text: str, tests: Sequence[PlateTest], mesh: Mesh = FINE) -> States:
    """The states of a tyre, given as the text of its file, under the tests' pressures and loads.

    @raises NotAtRest with furrow-tyre's message
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
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                message = done.stderr.replace(str(file), "the tyre").strip()
                raise NotAtRest(message.removeprefix("furrow-tyre: "))
            table = Path(folder) / "states.csv"
            table.write_text(done.stdout, encoding="utf-8")
            for load, row in zip(loads, read_numbers(table)[1:]):  # the first is without load
                states[pressure, load] = row
    return [states[test.pressure, test.load] for test in tests]


@dataclass(frozen=True)
class Fitted:
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
    parameters: list[Fitted]
    singular_values: Floats  # of J, falling
    correlation: Floats
    stretch: float  # how much larger than assumed the misfit makes the tests' errors

    def values(self) -> dict[str, float]:
        return {parameter.name: parameter.value for parameter in self.parameters}

    def misfits(self) -> dict[str, float]:
        """rms relative misfit of each measured quantity."""
        squares: dict[str, list[float]] = {}
        for test, state in zip(self.tests, self.states):
            for name, value in test.measured.items():
                squares.setdefault(name, []).append((state[name] / value - 1.0) ** 2)
        return {name: math.sqrt(sum(all_) / len(all_)) for name, all_ in squares.items()}

    def file_text(self, title: str, comments: list[str]) -> str:
        notes = {parameter.name: parameter.note() for parameter in self.parameters}
        return tyre_text(title, comments, tyre_sections(self.known, self.values(), notes))


@dataclass
class _Fit:
    """The residuals of a trial tyre, by a coarse mesh corrected to a fine one."""

    known: Catalogue
    tests: Sequence[PlateTest]
    solve: Solver
    start: dict[str, Guess]

    def __post_init__(self) -> None:
        self.errors = np.array([MEASURED[name] for test in self.tests for name in test.measured])
        self.correction = np.zeros(len(self.errors))
        self.known_states: dict[tuple[str, Mesh], States] = {}

    def values(self, x: Floats) -> dict[str, float]:
        return {
            name: guess.value * math.exp(guess.spread * float(shift))
            for (name, guess), shift in zip(self.start.items(), x)
        }

    def states(self, x: Floats, mesh: Mesh) -> States:
        blank = {name: "" for name in self.start}
        try:
            sections = tyre_sections(self.known, self.values(x), blank)
        except ResultsError as error:
            raise NotAtRest(str(error)) from error
        text = tyre_text("trial", [], sections)
        if (text, mesh) not in self.known_states:
            self.known_states[text, mesh] = self.solve(text, self.tests, mesh)
        return self.known_states[text, mesh]

    def misfit(self, states: Sequence[dict[str, float]]) -> Floats:
        """Logarithms over measurements, in errors of a measurement."""
        pairs = [
            state[name] / value
            for test, state in zip(self.tests, states)
            for name, value in test.measured.items()
        ]
        misfit: Floats = np.log(pairs) / self.errors
        return misfit

    def coarse(self, x: Floats) -> Floats:
        return self.misfit(self.states(x, COARSE)) + self.correction

    def correct(self, x: Floats) -> list[dict[str, float]]:
        """The states by the fine mesh, which the coarse one reproduces at x from here on."""
        states = self.states(x, FINE)
        self.correction += self.misfit(states) - self.coarse(x)
        return states

    def derivatives(self, x: Floats, here: Floats) -> Floats:
        columns = []
        for i in range(len(x)):
            step = np.zeros(len(x))
            step[i] = STEP
            try:
                there = self.coarse(x + step)
            except NotAtRest:  # then the other way
                step = -step
                there = self.coarse(x + step)
            columns.append((there - here) / step[i])
        return np.array(columns).T

    def improve(self, x: Floats, jacobian: Floats) -> Floats:
        """Gauss-Newton steps with Broyden's update of the derivatives."""
        here = self.coarse(x)
        for _ in range(STEPS):
            information = jacobian.T @ jacobian + np.eye(len(x))
            step = -np.linalg.solve(information, jacobian.T @ here + x)
            there = here
            for _ in range(HALVINGS):
                try:
                    there = self.coarse(x + step)
                    if there @ there + (x + step) @ (x + step) < here @ here + x @ x:
                        break
                except NotAtRest:
                    pass
                step = 0.5 * step
            else:
                return x  # no better tyre in this direction
            jacobian += np.outer(there - here - jacobian @ step, step) / (step @ step)
            x, here = x + step, there
            if np.abs(step).max() < CONVERGED:
                break
        return x


def fit_tyre(known: Catalogue, tests: Sequence[PlateTest], solve: Solver = press) -> TyreFit:
    """@raises ResultsError where the guessed tyre does not come to rest in all tests"""
    start = guesses(known)
    fit = _Fit(known, tests, solve, start)
    x = np.zeros(len(start))
    jacobian = np.zeros((0, len(x)))
    misfit = np.zeros(0)
    states: list[dict[str, float]] = []
    if tests:
        fit.correct(x)
        for _ in range(CORRECTIONS):
            x = fit.improve(x, fit.derivatives(x, fit.coarse(x)))
            states = fit.correct(x)
        misfit = fit.misfit(states)
        jacobian = fit.derivatives(x, fit.coarse(x))
    stretch = _stretch(jacobian, misfit)
    covariance = np.linalg.inv(jacobian.T @ jacobian / stretch**2 + np.eye(len(x)))
    deviations = np.sqrt(np.diag(covariance))
    fitted = [
        Fitted(
            name,
            value,
            float(start[name].spread * deviation),
            float(1 - deviation**2),
            start[name],
        )
        for (name, value), deviation in zip(fit.values(x).items(), deviations)
    ]
    singular = np.linalg.svd(jacobian / stretch, compute_uv=False) if tests else np.zeros(0)
    correlation = covariance / np.outer(deviations, deviations)
    return TyreFit(known, tests, states, fitted, singular, correlation, stretch)


def _stretch(jacobian: Floats, misfit: Floats) -> float:
    """Factor of the tests' errors with which the misfit is as large as they are, at least 1."""
    if not len(misfit):
        return 1.0
    information = jacobian.T @ jacobian
    used = float(np.trace(np.linalg.solve(information + np.eye(len(information)), information)))
    free = max(len(misfit) - used, 1.0)
    return max(1.0, math.sqrt(float(misfit @ misfit) / free))
