# SPDX-License-Identifier: GPL-2.0-or-later
"""The same scene on several grounds: aligned, with uncertainties and verdicts.

Refused are runs whose conditions differ too far (conditions.py).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..errors import ResultsError
from ..formatting import percent
from ..read.wheel_run import WheelRun
from ..run.summary import SteadyValue
from ..uncertainty import cost_table
from ..uncertainty.budget import Budget
from .conditions import TOLERANCES, Difference, incomparable
from .density import track_density
from ..uncertainty.judgement import judge, summed_up
from .measured import measured_entries
from ..laws.prediction import Prediction
from ..uncertainty.statistics import commonest
from ..uncertainty.verdict import BEST, COVERAGE, FORMULA, MEASURED, QUANTITIES, RUN, TRACK_DENSITY, Entry, Quantity, Verdict
from .wheel_histories import settling_curve
from ..uncertainty.whole_error import Families, budget_of, budgets

NAME_IN_RUN = {"sinkage": "hub_drop", "coefficient": "resistance_coefficient"}


@dataclass
class Comparison:
    """Runs beside each other, beside formulas and measurements."""

    runs: list[WheelRun]
    entries: list[Entry] = field(default_factory=list)
    differences: list[Difference] = field(default_factory=list)
    verdicts: list[Verdict] = field(default_factory=list)
    best_estimates: list[Verdict] = field(default_factory=list)  # on those of the runs
    tracks: dict[str, Entry] = field(default_factory=dict)  # label of a run -> density under its track
    remarks: list[str] = field(default_factory=list)  # what differs apart from the two quantities

    def of(self, quantity: Quantity, kind: str | None = None) -> list[Entry]:
        return [e for e in self.entries if e.quantity == quantity and kind in (None, e.kind)]


def uniquely_labelled(runs: Sequence[WheelRun]) -> list[WheelRun]:
    """The runs; where labels are equal, each gets the name of the folder above its own too."""
    labels = [run.label for run in runs]
    return [
        run.relabelled(f"{run.folder.resolve().parent.name}/{run.label}")
        if labels.count(run.label) > 1
        else run
        for run in runs
    ]


def compare(
    runs: Sequence[WheelRun],
    table: Sequence[cost_table.Row] | None = None,
    formulas: Sequence[Prediction] = (),
    measured: Path | None = None,
    anyway: bool = False,
) -> Comparison:
    """Runs beside each other. table: of runs of the scene; measured: a reference.csv.

    anyway: also where their conditions differ. @raises ResultsError with every reason why the runs
    are not comparable
    """
    runs = uniquely_labelled(runs)
    labels = [run.label for run in runs]
    if len(set(labels)) < len(labels):
        raise ResultsError(f"two runs are called '{commonest(labels)}'; write LABEL=FOLDER")
    differences = incomparable(runs)
    if differences and not anyway:
        raise ResultsError(
            "these runs are not comparable:\n"
            + "\n".join(f"  {d.condition}: {d.text}" for d in differences)
            + "\n  --anyway compares them all the same, and says so"
        )
    result = Comparison(runs, differences=differences)
    known = cost_table.families(table) if table else {}
    for run in runs:
        if run.has_density:
            result.tracks[run.label] = track_entry(run)
        result.entries += entries_of_run(run, known)
        result.entries += best_estimates(run, known)
    for prediction in formulas:
        result.entries += formula_entries(prediction)
    if measured:
        result.entries += measured_entries(measured, runs[0])
    for quantity in QUANTITIES:
        first, *others = result.of(quantity, RUN)
        result.verdicts += [judge(first, other) for other in others]
        estimates = result.of(quantity, BEST)
        result.best_estimates += [judge(estimates[0], other) for other in estimates[1:]]
        for reference in result.of(quantity, MEASURED):
            result.verdicts += [judge(reference, run) for run in (first, *others)]
    result.remarks = remarks(result)
    return result


def remarks(result: Comparison) -> list[str]:
    """The first run against the others: pressure half way down, density under the track."""
    first = result.runs[0]
    sentences = []
    allowed = TOLERANCES["slip"].absolute
    for other in result.runs[1:]:
        slips = [run.number("slip") for run in (first, other)]
        if abs(slips[1] - slips[0]) > allowed:
            sentences.append(
                f"{first.label} slips by {percent(slips[0])} and {other.label} by {percent(slips[1])}, "
                f"more than {100 * allowed:.0f} % apart"
            )
        z = 0.5 * min(run.values["hub_drop"].mean for run in (first, other))
        curves = [settling_curve(run) for run in (first, other)]
        if all(len(x) > 10 and x.min() < z < x.max() for x, _ in curves):
            # the first passage: the wheel may bounce later
            a, b = (float(pressure[np.argmax(x >= z)]) for x, pressure in curves)
            if min(a, b) > 0 and not 1 / 1.5 < b / a < 1.5:
                sentences.append(
                    f"while the wheel is lowered, at {1e3 * z:.0f} mm, {first.label} bears "
                    f"{a / 1e3:.3g} kPa and {other.label} {b / 1e3:.3g} kPa"
                )
        if first.label in result.tracks and other.label in result.tracks:
            one, two = result.tracks[first.label], result.tracks[other.label]
            if abs(two.value - one.value) > max(COVERAGE * math.hypot(one.uncertainty, two.uncertainty), 0.05 * one.value):
                sentences.append(f"under the track {first.label} has {one.text()} kg/m3 and {other.label} {two.text()} kg/m3")
    return sentences


def overall(result: Comparison) -> str:
    """The verdict on the runs among each other in one line; of a single run, with the measurements.

    Empty where there is nothing to compare.
    """
    among = [v for v in result.verdicts if not v.with_measurement]
    who = "runs" if among else "run and the measurements"
    among = among or (result.verdicts if len(result.runs) == 1 else [])
    if not among:
        return ""
    verdict = summed_up(among, who)
    if result.differences:
        names = ", ".join(d.condition for d in result.differences)
        verdict += f" They were compared though their conditions differ: {names}."
    return verdict


def overall_of_best_estimates(result: Comparison) -> str:
    """The same of the runs' best estimates; empty where fewer than two are known."""
    among = result.best_estimates
    return f"{BEST.capitalize()}: {summed_up(among, 'runs')}" if among else ""


# ---- values


def entries_of_run(run: WheelRun, families: Families) -> list[Entry]:
    """Each quantity of a run with its whole error. families: of a table of runs of the scene, may be empty"""
    entries = []
    errors = budgets(run, families)
    for quantity in QUANTITIES:
        value = run.values[NAME_IN_RUN[quantity.key]]
        parts = errors[NAME_IN_RUN[quantity.key]]
        note = "" if value.steady else "not called steady"
        entries.append(Entry(quantity, run.label, value.mean, parts, RUN, note, run.cpu_time, value.steady))
    return entries


def track_entry(run: WheelRun) -> Entry:
    """Density under the track. No series of sizes and no test has one, so most parts of its error are unknown."""
    density, error = track_density(run)
    parts = budget_of(run, TRACK_DENSITY.key, SteadyValue(density, error, TRACK_DENSITY.unit, True))
    return Entry(TRACK_DENSITY, run.label, density, parts, RUN)


def best_estimates(run: WheelRun, families: Families) -> list[Entry]:
    """Best estimates of each quantity, where a table's families have more than one size."""
    entries = []
    family = families.get(cost_table.FamilyKey(run.ground, run.model, run.wheel))
    for quantity in QUANTITIES:
        steady = run.values[NAME_IN_RUN[quantity.key]]
        best = family and family.best_estimate(
            quantity.key, run.size, steady.mean, steady.standard_error
        )
        if best:
            value, parts = best
            entries.append(Entry(quantity, run.label, value, parts, BEST, steady=steady.steady))
    return entries


def formula_entries(prediction: Prediction) -> list[Entry]:
    note = "extrapolated" if prediction.outside else ""
    values = (
        (prediction.sinkage, prediction.sinkage_scatter),
        (prediction.coefficient, prediction.coefficient_scatter),
    )
    return [
        Entry(
            quantity,
            prediction.method,
            value,
            Budget(time=scatter) if scatter > 0 else Budget(),
            FORMULA,
            note,
        )
        for quantity, (value, scatter) in zip(QUANTITIES, values)
    ]
