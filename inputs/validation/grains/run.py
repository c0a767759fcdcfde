#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains: scatter of packings, influence of sizes, stiffness, step, rate and speed, cost. See
README.md.

Makes the runs that are missing and writes results.csv and the tables of README.md. Every variation
is prepared (packed, settled) with its own numbers. Stages are the families; --check fails when a
limit below is missed (ctest study.grains).
"""

import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[2]
sys.path.insert(0, str(PROJECT / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.laboratory.evaluation import evaluate as evaluate_test
from furrow_post.laboratory.reference import reference_error
from furrow_post.read.laboratory import LaboratoryTest, read_oedometer_reference
from furrow_post.read.summary import Summary
from furrow_post.study.case import Case, Value
from furrow_post.study.furrow_cases import laboratory_case, script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study
from furrow_post.study.tables import markdown

SEEDS = [86028121, 49979687, 67867967, 49979693, 67867979]
SCRIPTS = {  # of wheels
    "wheel_sand_grains": PROJECT / "inputs" / "crosscheck" / "wheel_sand_grains.lig",
    "wheel_snow_grains": PROJECT / "inputs" / "validation" / "grains" / "wheel_snow_grains.lig",
}
OEDOMETER = PROJECT / "inputs" / "validation" / "snow_oedometer" / "reference.csv"

Variables = dict[str, float | int]


class Change(NamedTuple):
    """What differs from the base, and how many packings are made of it."""

    variables: Variables
    packings: int


@dataclass(frozen=True)
class Family:
    """A test, its base and what is changed one at a time."""

    name: str
    test: str  # of inputs/laboratory, or of SCRIPTS
    ground: str
    base: Variables
    packings: int  # of the base
    changes: dict[str, Change]
    quantities: tuple[str, ...]  # of the test, or of summary.json

    @property
    def all_changes(self) -> dict[str, Change]:
        return {"base": Change({}, self.packings), **self.changes}


FAMILIES = (
    Family(
        "sand_triaxial",
        "triaxial",
        "sand_dry",
        {"grains": 500, "confinement": 2e4, "rate": 0.4, "strain": 0.15},
        5,
        {
            "1500 grains": Change({"grains": 1500}, 2),
            "grains of 5 mm": Change({"diameter": 0.005}, 2),
            "grains of 20 mm": Change({"diameter": 0.02}, 2),
            "E 1e7 Pa": Change({"young": 1e7, "confined_stiffness": 5e6}, 2),
            "E 3e7 Pa": Change({"young": 3e7, "confined_stiffness": 1e7}, 2),
            "E 3e8 Pa": Change({"young": 3e8, "confined_stiffness": 4e7}, 2),
            "half the step": Change({"step_share": 0.1}, 2),
            "twice the step": Change({"step_share": 0.4}, 2),
            "half the rate": Change({"rate": 0.2}, 2),
            "four times the rate": Change({"rate": 1.6}, 2),
        },
        ("friction_angle_peak", "friction_angle_end"),
    ),
    Family(
        "snow_oedometer",
        "oedometer",
        "snow",
        {"grains": 600, "stress": 1.1e6, "rate": 2, "strain": 1.25},
        5,
        {
            "1500 clusters": Change({"grains": 1500}, 2),
            "clusters of 10 mm": Change({"diameter": 0.01}, 2),
            "clusters of 40 mm": Change({"diameter": 0.04}, 2),
            "stiffness x 2": Change({"stiffness": 6.24e6}, 2),
            "stiffness / 2": Change({"stiffness": 1.56e6}, 2),
            "half the step": Change({"step_share": 0.04}, 2),
            "twice the step": Change({"step_share": 0.16}, 2),
            "half the rate": Change({"rate": 1}, 2),
            "three times the rate": Change({"rate": 6}, 2),
            "120 kg/m3": Change({"bulk": 120, "strain": 1.8}, 1),
            "300 kg/m3": Change({"bulk": 300, "strain": 0.9}, 1),
        },
        ("rms_ln_stress", "density_100kPa"),
    ),
    Family(
        "sand_wheel",
        "wheel_sand_grains",
        "sand_dry",
        {"diameter": 0.045},
        3,
        {
            "grains of 34 mm": Change({"diameter": 0.034}, 2),
            "grains of 27 mm": Change({"diameter": 0.027}, 1),
            "E 1e7 Pa": Change({"young": 1e7}, 1),
            "E 3e7 Pa": Change({"young": 3e7}, 1),
            "half the step": Change({"step_share": 0.1}, 1),
            "twice the step": Change({"step_share": 0.4}, 1),
            "half the speed": Change({"speed": 0.5}, 1),
            "twice the speed": Change({"speed": 2}, 1),
        },
        ("sinkage", "resistance_coefficient"),
    ),
    Family(
        "snow_wheel",
        "wheel_snow_grains",
        "snow",
        {"diameter": 0.045},
        3,
        {
            "clusters of 35 mm": Change({"diameter": 0.035}, 2),
            "clusters of 28 mm": Change({"diameter": 0.028}, 1),
            "stiffness x 2": Change({"stiffness": 6.24e6}, 1),
            "stiffness / 2": Change({"stiffness": 1.56e6}, 1),
            "half the step": Change({"step_factor": 0.5}, 1),
            "twice the step": Change({"step_factor": 2}, 1),
            "half the speed": Change({"speed": 1.1175}, 1),
            "twice the speed": Change({"speed": 4.47}, 1),
        },
        ("sinkage", "resistance_coefficient"),
    ),
)
QUANTITY_NAMES = {
    "friction_angle_peak": "peak angle, degrees",
    "friction_angle_end": "angle at the end, degrees",
    "rms_ln_stress": "rms ln(stress) to Abele and Gow",
    "density_100kPa": "kg/m3 at 100 kPa",
    "sinkage": "sinkage, m",
    "resistance_coefficient": "resistance coefficient",
}
# Limits of the check on the mean of the base's packings: what was reached (README.md), with their
# scatter.
LIMITS = {
    ("sand_triaxial", "friction_angle_end"): (25.0, 30.0),
    ("snow_oedometer", "rms_ln_stress"): (0.10, 0.36),
}


class Planned(NamedTuple):
    """One run of a family."""

    case: Case
    change: str
    seed: int


def planned(family: Family) -> Iterator[Planned]:
    """Every change with its packings, the base first."""
    for change, (variables, packings) in family.all_changes.items():
        for seed in SEEDS[:packings]:
            name = f"{family.name}/{change.replace(' ', '_').replace('/', '_')}_{seed}"
            given: dict[str, Value] = {
                key: f"{value:g}" if isinstance(value, float) else str(value)
                for key, value in (*family.base.items(), *variables.items(), ("seed", seed))
            }
            yield Planned(make_case(family, name, given), change, seed)


def make_case(family: Family, name: str, variables: dict[str, Value]) -> Case:
    stage = family.name
    if family.test in SCRIPTS:
        script = SCRIPTS[family.test]
        return script_case(name, script, {"here": script.parent, **variables}, log=True, stage=stage)
    given: dict[str, Value] = {"ground": family.ground, **variables}
    return laboratory_case(name, family.test, PROJECT, given, stage=stage)


def values(folder: Path, family: Family) -> Floats:
    """Of the family's quantities; NaN for what the run did not reach."""
    if family.test in SCRIPTS:
        summary = Summary(folder)
        steady = [summary.quantity(name) for name in family.quantities]
        return np.array([value.mean if value else math.nan for value in steady])
    test = LaboratoryTest(folder)
    quantities = evaluate_test(test)
    if family.test == "oedometer":
        quantities += reference_error(test, read_oedometer_reference(OEDOMETER))
    found = {quantity.name: quantity.value for quantity in quantities}
    return np.array([found.get(name, math.nan) for name in family.quantities])


@dataclass(frozen=True)
class Outcome:
    """What one run gave."""

    plan: Planned
    values: Floats
    cpu_time: float  # [s]


def outcomes(runner: Runner, family: Family) -> list[Outcome]:
    """Of the runs that are there."""
    return [
        Outcome(plan, values(runner.folder(plan.case), family), round(record.cpu_time, 1))
        for plan in planned(family)
        if (record := runner.record(plan.case))
    ]


@dataclass(frozen=True)
class Packings:
    """The packings of one change: means, standard deviation of one packing (NaN of one alone)."""

    count: int
    means: Floats
    scatter: Floats
    cpu_time: float  # mean [s]


def by_change(found: Sequence[Outcome]) -> dict[str, Packings]:
    groups: dict[str, list[Outcome]] = {}
    for outcome in found:
        groups.setdefault(outcome.plan.change, []).append(outcome)
    result = {}
    for change, group in groups.items():
        table = np.array([outcome.values for outcome in group])
        alone = np.full(table.shape[1], math.nan)
        scatter = table.std(axis=0, ddof=1) if len(group) > 1 else alone
        cpu_time = float(np.mean([outcome.cpu_time for outcome in group]))
        result[change] = Packings(len(group), table.mean(axis=0), scatter, cpu_time)
    return result


def family_section(family: Family, found: Mapping[str, Packings]) -> list[str]:
    """Markdown: every change against the base.

    The error of the difference comes from the scatter of the base's packings.
    """
    base = found["base"]
    head = ["", "packings"]
    for name in family.quantities:
        head += [QUANTITY_NAMES[name], "against base"]
    rows = []
    for change, packings in found.items():
        cells = [change, str(packings.count)]
        for k in range(len(family.quantities)):
            digits = 1 if abs(base.means[k]) > 10 else 3
            mean, scatter = packings.means[k], base.scatter[k]
            if change == "base":
                cells += [f"{mean:.{digits}f}, scatter {scatter:.{digits}f}", ""]
                continue
            error = scatter * math.sqrt(1 / packings.count + 1 / base.count)
            difference = f"{mean - base.means[k]:+.{digits}f} ± {error:.{digits}f}"
            cells += [f"{mean:.{digits}f}", difference]
        rows.append([*cells, f"{packings.cpu_time:.0f}"])
    numbers = ", ".join(f"{key} {value:g}" for key, value in family.base.items())
    title = f"**{family.name.replace('_', ' ')}**: {numbers}"
    return [title, "", *markdown([*head, "CPU s"], rows), ""]


def table_rows(family: Family, found: Sequence[Outcome]) -> list[dict[str, object]]:
    """Lines of results.csv."""
    rows = []
    for outcome in found:
        row: dict[str, object] = {
            "family": family.name,
            "run": outcome.plan.case.name.partition("/")[2],
            "change": outcome.plan.change,
            "seed": outcome.plan.seed,
        }
        for k, (name, value) in enumerate(zip(family.quantities, outcome.values), 1):
            row[f"quantity_{k}"], row[f"value_{k}"] = name, f"{value:.6g}"
        row["cpu_s"] = outcome.cpu_time
        rows.append(row)
    return rows


def missed_limits(family: Family, found: Mapping[str, Packings]) -> Iterator[str]:
    """found: empty where fewer than two packings of the base were run."""
    for k, quantity in enumerate(family.quantities):
        if (family.name, quantity) not in LIMITS:
            continue
        low, high = LIMITS[family.name, quantity]
        if not found:
            yield f"{family.name}: fewer than two packings of the base were run"
        elif not low <= found["base"].means[k] <= high:
            mean = found["base"].means[k]
            yield f"{family.name}: {quantity} {mean:.3f} is not in [{low}, {high}]"


def evaluate(runner: Runner, output: Output) -> Sequence[str]:
    rows: list[dict[str, object]] = []
    lines: list[str] = []
    missed: list[str] = []
    for family in FAMILIES:
        own = outcomes(runner, family)
        rows += table_rows(family, own)
        found = by_change(own)
        if "base" not in found or found["base"].count < 2:
            found = {}
        else:
            lines += family_section(family, found)
        missed += missed_limits(family, found)
    output.table("results.csv", rows)
    output.section(lines)
    return missed


CASES = tuple(plan.case for family in FAMILIES for plan in planned(family))

if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", CASES, evaluate)))
