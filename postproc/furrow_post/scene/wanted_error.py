# SPDX-License-Identifier: GPL-2.0-or-later
"""Size and length of a run for a wanted whole error, or for the least error within a time.

A pilot run in coarser cells or grains shows time, value and parts of the error. Its forecast for another size h and
a length L times as long: core time ~ L h^-b, error over time ~ L^-1/2, error of the size as whole_error.py has it.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..uncertainty.budget import Budget
from ..uncertainty.scene_errors import convergence_of
from ..uncertainty.whole_error import SNOW, RunErrors, budgets_of
from ..errors import ResultsError
from ..formatting import duration
from ..read.wheel_run import WheelRun, read_wheel_run
from ..run.script import script_variables
from ..run.summary import Summary
from .catalogue import Variables
from .converging import COARSER, sizes_of
from .one import SceneRun, run_missing

STEPS = tuple(1.26**k for k in range(-4, 5))  # sizes that are tried, over those of the scene
LENGTHS = ("distance", "travel")  # variables of the travel [m]
LONGER = (1.0, 2.0, 4.0)
EXPONENTS = {True: 3.5, False: 3.8}  # b of cells and of grains, where no convergence of the scene shows it
COEFFICIENT_SCALE = 0.25  # a coefficient below counts as this
SAME = 1.05  # errors that differ by less are the same
# Remedies for the largest part of an error
REMEDIES = {
    "model": {
        "snow": "measure sinkage and pull at one depth of your snow",
        "sand": "measure the pull at one slip, or ring shear at your pressure",
        "road": "measure the deflection at your load and pressure",
    },
    "size": "leave out -v for its size, or give more time with --time",
    "time": "roll further, with --until-steady",
    "packing": "average packings, with --sweep and --packings",
    "material": "measure the parameter of the soil that changes most in SCENE.material.json",
    "held": "raise the damping of the rig, or roll further",
}


@dataclass(frozen=True)
class Forecast:
    """Forecast of a run. budgets: of the hub drop and the coefficient; scales: values that errors refer to."""

    variables: Variables
    size: float  # of cells or grains, over that of the scene
    cpu_time: float  # [s] of one core
    budgets: Mapping[str, Budget]
    scales: Mapping[str, float]

    @property
    def errors(self) -> dict[str, float]:
        return {name: budget.total / self.scales[name] for name, budget in self.budgets.items()}

    @property
    def error(self) -> float:
        return max(self.errors.values())

    @property
    def worst(self) -> str:
        return max(self.errors, key=lambda name: self.errors[name])

    @property
    def largest_part(self) -> str:
        budget = self.budgets[self.worst]
        return max(budget.known, key=budget.part)

    def lines(self) -> list[str]:
        """ "hub drop: 18 % (cells 4, model 16; ground, material unknown)"."""
        found = []
        for name, budget in self.budgets.items():
            percents = budget.scaled(100 / self.scales[name])
            found.append(f"  {name.replace('_', ' ')}: {percents.total:.2g} % ({percents.parts_text()})")
        return found


@dataclass(frozen=True)
class ErrorPlan:
    """The run to make, and the pilot that the forecast rests on."""

    forecast: Forecast
    pilot: WheelRun
    wanted: float  # relative error; infinite: the least within a time
    time: float  # [s]; infinite: any

    @property
    def reached(self) -> bool:
        return self.forecast.error <= self.wanted and self.forecast.cpu_time <= self.time

    def lines(self) -> list[str]:
        run = self.forecast
        given = " ".join(f"-v {name} {value}" for name, value in run.variables) or "the sizes of the scene"
        head = f"Plan: {given}, about {duration(run.cpu_time)} of one core; the pilot took {duration(self.pilot.cpu_time)}"
        return [head, "Forecast of the whole error", *run.lines(), *self.why_not()]

    def why_not(self) -> list[str]:
        if self.reached:
            return []
        run = self.forecast
        if run.cpu_time > self.time:
            return [f"Nothing fits into {duration(self.time)}: this is the coarsest run that is tried."]
        return [f"{100 * self.wanted:.2g} % is not within reach: {limit_of(run.budgets[run.worst], run.scales[run.worst], run.worst, self.pilot)}"]


def limit_of(budget: Budget, scale: float, name: str, run: WheelRun) -> str:
    """Remark on the error that the largest part leaves, and on what would reduce it."""
    part = max(budget.known, key=budget.part)
    remedy = REMEDIES.get(part, "")
    if isinstance(remedy, Mapping):
        remedy = remedy["road" if run.ground == "none" else "snow" if run.number("density") < SNOW else "sand"]
    share = 100 * budget.part(part) / scale
    what = f"the part '{budget.label(part)}' leaves {share:.2g} % of the {name.replace('_', ' ')}"
    source = f" (nearest tests: {budget.sources[part]})" if part == "model" else ""
    return f"{what}{source}" + (f"; {remedy}" if remedy else "")


def plan(script: Path, given: Variables, folder: Path, error: float, time: float) -> ErrorPlan:
    """Makes the pilot in a folder below the results, unless it is there. @raises ResultsError, Interrupted, Failed"""
    fixed = dict(given)
    sizes = {name: size for name, size in sizes_of(script, given).items() if name not in fixed}
    length = next((name for name in LENGTHS if name in script_variables(script, fixed).defaults and name not in fixed), "")
    pilot = _pilot(script, given, sizes, folder)
    found = [
        _forecast(pilot, script, sizes, length, finer, longer)
        for finer in (STEPS if sizes else (1.0,))
        for longer in (LONGER if length else (1.0,))
    ]
    return ErrorPlan(_chosen(found, error, time), pilot, error, time)


def _chosen(found: Sequence[Forecast], error: float, time: float) -> Forecast:
    """The cheapest within error and time; else of those in time the least error, of equal ones the cheapest.

    An error that no size reaches is no reason for sizes coarser than the scene's."""
    within = [one for one in found if one.error <= error and one.cpu_time <= time]
    if within and math.isfinite(error):
        return min(within, key=lambda one: one.cpu_time)
    in_time = [one for one in found if one.cpu_time <= time] or [min(found, key=lambda one: one.cpu_time)]
    if math.isfinite(error):
        in_time = [one for one in in_time if one.size <= 1.0] or in_time
    least = min(one.error for one in in_time)
    return min((one for one in in_time if one.error <= SAME * least), key=lambda one: one.cpu_time)


def _pilot(script: Path, given: Variables, sizes: Mapping[str, float], folder: Path) -> WheelRun:
    variables = [*((name, f"{COARSER * size:.6g}") for name, size in sizes.items()), *given]
    run_missing(folder, [SceneRun(script, folder / "pilot", variables)])
    try:
        return read_wheel_run(folder / "pilot")
    except ResultsError as trouble:
        raise ResultsError(f"the pilot gives no error to plan with ({trouble}); start the scene without --error and --time") from trouble


def _forecast(
    pilot: WheelRun, script: Path, sizes: Mapping[str, float], length: str, finer: float, longer: float
) -> Forecast:
    ratio = finer / (COARSER if sizes else 1.0)  # of the sizes to those of the pilot
    variables = [(name, f"{finer * size:.4g}") for name, size in sizes.items()] if finer != 1.0 else []
    if longer > 1.0:
        usual = float(script_variables(script, {}).defaults[length])
        variables.append((length, f"{longer * usual:.4g}"))
    found = RunErrors(replace(pilot, size=ratio * pilot.size)).all()
    names = ["hub_drop", _coefficient(pilot)]
    parts = {name: replace(found[name], time=found[name].time / math.sqrt(longer)) for name in names}
    values = {name: abs(pilot.values[name].mean) if name in pilot.values else 0.0 for name in names}
    scales = {name: max(value, COEFFICIENT_SCALE) if name != "hub_drop" else value for name, value in values.items()}
    return Forecast(variables, finer, pilot.cpu_time * longer * ratio ** -_exponent(pilot), parts, scales)


def _coefficient(run: WheelRun) -> str:
    return next((name for name in Summary(run.folder).headline if name.endswith("coefficient")), "resistance_coefficient")


def _exponent(run: WheelRun) -> float:
    """b of core time ~ size^-b."""
    stored = convergence_of(run)
    if stored and all(map(math.isfinite, stored.cpu_times)):
        return -float(np.polyfit(np.log(stored.sizes), np.log(stored.cpu_times), 1)[0])
    return EXPONENTS[not run.ground_kind.random]


def outcome(made: ErrorPlan, folder: Path) -> list[str]:
    """Remarks on whether the finished run is within the error, and which part dominates. @raises ResultsError"""
    run = read_wheel_run(folder)
    found = budgets_of(folder)
    parts = {name: found[name] for name in made.forecast.budgets}
    scales = {name: max(abs(run.values[name].mean) if name in run.values else 0.0, made.forecast.scales[name]) for name in parts}
    scales["hub_drop"] = abs(run.values["hub_drop"].mean)
    result = replace(made.forecast, budgets=parts, scales=scales, cpu_time=run.cpu_time)
    state = "" if math.isinf(made.wanted) else f", within {100 * made.wanted:.2g} %" if result.error <= made.wanted else (
        f", above {100 * made.wanted:.2g} %: {limit_of(parts[result.worst], scales[result.worst], result.worst, run)}")
    return [f"Whole error {100 * result.error:.2g} % ({result.worst.replace('_', ' ')}) in {duration(run.cpu_time)} of one core{state}."]
