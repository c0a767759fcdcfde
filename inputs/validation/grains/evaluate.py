# SPDX-License-Identifier: GPL-2.0-or-later
"""Every run's quantities; every change against the base, with the scatter of packings; limits."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from furrow_post.arrays import Floats
from furrow_post.laboratory.evaluation import evaluate as evaluate_test
from furrow_post.laboratory.reference import reference_error
from furrow_post.read.laboratory import LaboratoryTest, read_oedometer_reference
from furrow_post.run.summary import Summary
from furrow_post.study.output import Output
from furrow_post.study.runs import Run, Runs

OEDOMETER = Path(__file__).resolve().parents[1] / "snow_oedometer" / "reference.csv"
WHEEL = ("sinkage", "resistance_coefficient")  # of summary.json
FAMILIES = {  # stage -> quantities
    "sand_triaxial": ("friction_angle_peak", "friction_angle_end"),
    "snow_oedometer": ("rms_ln_stress", "density_100kPa"),
    "sand_wheel": WHEEL,
    "snow_wheel": WHEEL,
}
# Limits of the check on the mean of the base's packings: what was reached, with their scatter
LIMITS = {
    ("sand_triaxial", "friction_angle_end"): (25.0, 30.0),
    ("snow_oedometer", "rms_ln_stress"): (0.10, 0.36),
}

Row = dict[str, Any]


def values(run: Run) -> list[float]:
    """Of the family's quantities; NaN for what the run did not reach."""
    names = FAMILIES[run.case.stage]
    if names == WHEEL:
        summary = Summary(run.folder)
        steady = [summary.quantity(name) for name in names]
        return [value.mean if value else math.nan for value in steady]
    test = LaboratoryTest(run.folder)
    quantities = evaluate_test(test)
    if run.case.stage == "snow_oedometer":
        quantities += reference_error(test, read_oedometer_reference(OEDOMETER))
    found = {quantity.name: quantity.value for quantity in quantities}
    return [found.get(name, math.nan) for name in names]


def row_of(run: Run) -> Row:
    family, _, name = run.name.partition("/")
    row: Row = {"family": family, "run": name, "change": run.what, "seed": name.rpartition("_")[2]}
    for k, (quantity, value) in enumerate(zip(FAMILIES[family], values(run)), 1):
        row[f"quantity_{k}"], row[f"value_{k}"] = quantity, f"{value:.6g}"
    return {**row, "cpu_s": run.seconds}


@dataclass(frozen=True)
class Packings:
    """The packings of one change: means, standard deviation of one packing (NaN of one alone)."""

    count: int
    means: Floats
    scatter: Floats


def by_change(rows: Sequence[Mapping[str, Any]]) -> dict[str, Packings]:
    """Of the rows of one family."""
    groups: dict[str, list[list[float]]] = {}
    for row in rows:
        groups.setdefault(row["change"], []).append([float(row["value_1"]), float(row["value_2"])])
    result = {}
    for change, group in groups.items():
        table = np.array(group)
        alone = np.full(table.shape[1], math.nan)
        scatter = table.std(axis=0, ddof=1) if len(group) > 1 else alone
        result[change] = Packings(len(group), table.mean(axis=0), scatter)
    return result


def change_rows(family: str, found: Mapping[str, Packings]) -> Iterator[Row]:
    """Every change against the base; the error of the difference comes from the scatter of the
    base's packings. Nothing where fewer than two packings of the base were run."""
    base = found.get("base")
    if base is None or base.count < 2:
        return
    for change, packings in found.items():
        for k, quantity in enumerate(FAMILIES[family]):
            scatter = base.scatter[k]
            error = scatter * math.sqrt(1 / packings.count + 1 / base.count)
            is_base = change == "base"
            yield {
                "family": family,
                "change": change,
                "packings": packings.count,
                "quantity": quantity,
                "mean": f"{packings.means[k]:.6g}",
                "scatter": f"{scatter:.3g}" if is_base else "",
                "difference": "" if is_base else f"{packings.means[k] - base.means[k]:.4g}",
                "difference_error": "" if is_base else f"{error:.3g}",
            }


def missed_limits(family: str, found: Mapping[str, Packings]) -> Iterator[str]:
    for k, quantity in enumerate(FAMILIES[family]):
        if (family, quantity) not in LIMITS:
            continue
        low, high = LIMITS[family, quantity]
        if "base" not in found or found["base"].count < 2:
            yield f"{family}: fewer than two packings of the base were run"
        elif not low <= found["base"].means[k] <= high:
            mean = found["base"].means[k]
            yield f"{family}: {quantity} {mean:.3f} is not in [{low}, {high}]"


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    rows = [row_of(run) for run in runs.done(*FAMILIES)]
    output.table("results.csv", rows)
    found = {family: by_change([row for row in rows if row["family"] == family]) for family in FAMILIES}
    changes = [row for family, packings in found.items() for row in change_rows(family, packings)]
    output.table("changes.csv", changes)
    return [text for family, packings in found.items() for text in missed_limits(family, packings)]
