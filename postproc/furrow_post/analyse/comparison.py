# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene on several grounds, with uncertainties and verdicts; compare.txt, compare.csv, compare.h5.

Runs whose conditions differ too far are refused (conditions.py).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pandas as pd

from ..csv_table import in_cells, read_numbers, write_rows
from ..errors import ResultsError
from ..formatting import duration, percent
from ..laws.prediction import Prediction
from ..read.wheel_run import WheelRun
from ..run.summary import SteadyValue
from ..uncertainty.budget import Budget
from ..uncertainty.cost_table import FamilyKey, Row, families
from ..uncertainty.verdict import BEST, COVERAGE, FORMULA, MEASURED, QUANTITIES, RUN, TRACK_DENSITY
from ..uncertainty.verdict import Entry, Quantity, Verdict, conclusion, summed_up, verdict_between
from ..uncertainty.whole_error import Families, RunErrors
from .conditions import TOLERANCES, Difference, incomparable, require_comparable, require_different_labels
from .density import sections, track_density
from .wheel_histories import cruise_history, settling_curve

NAME_IN_RUN = {"sinkage": "hub_drop", "coefficient": "resistance_coefficient"}
NAME_IN_REFERENCE = {"sinkage": "sinkage_m", "coefficient": "resistance"}
NEAR = {"depth": (0.9, 1.1), "density": (0.85, 1.15)}  # measurements near a run, over its depth and density
COLUMNS = {"depth": "depth_m", "density": "density_kgm3"}  # columns of the quantities in a reference.csv
ROUNDING = 1e-9  # of a ratio of two decimal numbers
SHOWN_CONDITIONS = (
    *("load", "speed", "slip", "slip_by_vehicle_speed", "wheel_diameter", "wheel_width", "depth", "density"),
)
Line = dict[str, str | float]


@dataclass
class Comparison:
    """Runs beside each other, beside formulas and measurements."""

    runs: list[WheelRun]
    entries: list[Entry] = field(default_factory=list)
    differences: list[Difference] = field(default_factory=list)
    verdicts: list[Verdict] = field(default_factory=list)
    best_estimates: list[Verdict] = field(default_factory=list)  # on those of the runs
    tracks: dict[str, Entry] = field(default_factory=dict)  # label of a run -> density under its track
    remarks: list[str] = field(default_factory=list)  # differences of the runs besides the two quantities

    def of(self, quantity: Quantity, kind: str | None = None) -> list[Entry]:
        return [e for e in self.entries if e.quantity == quantity and kind in (None, e.kind)]

    def overall(self) -> str:
        """The verdict on the runs among each other in one line; of a single run, with the measurements.

        Empty where there is nothing to compare.
        """
        among, who = [v for v in self.verdicts if not v.with_measurement], "runs"
        if not among and len(self.runs) == 1:
            among, who = self.verdicts, "run and the measurements"
        if among and self.differences:
            names = ", ".join(d.condition for d in self.differences)
            return f"{summed_up(among, who)} They were compared though their conditions differ: {names}."
        return summed_up(among, who)

    def overall_of_best_estimates(self) -> str:
        """Overall verdict on the best estimates of runs; empty for fewer than two."""
        return f"{BEST.capitalize()}: {summed_up(self.best_estimates, 'runs')}" if self.best_estimates else ""

    def findings(self) -> list[str]:
        """The sentences of all verdicts, then the remarks."""
        sentences = [v.sentence for v in (*self.verdicts, *self.best_estimates)]
        return sentences + [f"also: {text}" for text in self.remarks]


def uniquely_labelled(runs: Sequence[WheelRun]) -> list[WheelRun]:
    """The runs; where labels are equal, each gets the name of the folder above its own too."""
    labels = [run.label for run in runs]
    return [
        run.relabelled(f"{run.folder.resolve().parent.name}/{run.label}") if labels.count(run.label) > 1 else run
        for run in runs
    ]


def compare(
    runs: Sequence[WheelRun],
    table: Sequence[Row] | None = None,
    formulas: Sequence[Prediction] = (),
    measured: Path | None = None,
    anyway: bool = False,
) -> Comparison:
    """Runs beside each other. table: of runs of the scene; measured: a reference.csv.

    anyway: also where their conditions differ. @raises ResultsError with every reason why the runs
    are not comparable
    """
    runs = uniquely_labelled(runs)
    result = Comparison(runs, differences=incomparable(runs))
    require_different_labels("runs", [run.label for run in runs])
    require_comparable("runs", result.differences, anyway)
    known = families(table) if table else {}
    for run in runs:
        errors = RunErrors(run, known)
        if run.ground_kind.has_density:
            result.tracks[run.label] = track_entry(errors)
        result.entries += entries_of_run(errors)
        result.entries += best_estimates(run, known)
    for prediction in formulas:
        result.entries += formula_entries(prediction)
    if measured:
        result.entries += measured_entries(measured, runs[0])
    for quantity in QUANTITIES:
        of_runs, estimates = result.of(quantity, RUN), result.of(quantity, BEST)
        result.verdicts += [verdict_between(of_runs[0], other) for other in of_runs[1:]]
        result.best_estimates += [verdict_between(estimates[0], other) for other in estimates[1:]]
        for reference in result.of(quantity, MEASURED):
            result.verdicts += [verdict_between(reference, run) for run in of_runs]
    result.remarks = [remark for other in runs[1:] for remark in _remarks(runs[0], other, result.tracks)]
    return result


def _remarks(first: WheelRun, other: WheelRun, tracks: dict[str, Entry]) -> list[str]:
    """Differences of two runs in slip, pressure half way down, and density under the track."""
    sentences, allowed = [], TOLERANCES["slip"].absolute
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
    if first.label in tracks and other.label in tracks:
        one, two = tracks[first.label], tracks[other.label]
        if abs(two.value - one.value) > max(COVERAGE * math.hypot(one.uncertainty, two.uncertainty), 0.05 * one.value):
            sentences.append(f"under the track {first.label} has {one.text()} kg/m3 and {other.label} {two.text()} kg/m3")
    return sentences


# ---- values of the compared runs


def entries_of_run(errors: RunErrors) -> list[Entry]:
    """Each quantity of a run with its whole error."""
    run, entries = errors.run, []
    for quantity in QUANTITIES:
        name = NAME_IN_RUN[quantity.key]
        value = run.values[name]
        parts, note = errors.of(name, value), "" if value.steady else "not called steady"
        entries.append(Entry(quantity, run.label, value.mean, parts, RUN, note, run.cpu_time, value.steady))
    return entries


def track_entry(errors: RunErrors) -> Entry:
    """Density under the track. No series of sizes and no test has one, so most parts of its error are unknown."""
    density, error = track_density(errors.run)
    parts = errors.of(TRACK_DENSITY.key, SteadyValue(density, error, TRACK_DENSITY.unit, True))
    return Entry(TRACK_DENSITY, errors.run.label, density, parts, RUN)


def best_estimates(run: WheelRun, known: Families) -> list[Entry]:
    """Best estimates of each quantity, where a table's families have more than one size."""
    entries = []
    family = known.get(FamilyKey(run.ground, run.model, run.wheel))
    for quantity in QUANTITIES:
        steady = run.values[NAME_IN_RUN[quantity.key]]
        best = family and family.best_estimate(quantity.key, run.size, steady.mean, steady.standard_error)
        if best:
            value, parts = best
            entries.append(Entry(quantity, run.label, value, parts, BEST, steady=steady.steady))
    return entries


def formula_entries(prediction: Prediction) -> list[Entry]:
    note = "extrapolated" if prediction.outside else ""
    values = (prediction.sinkage, prediction.coefficient)
    scatters = (prediction.sinkage_scatter, prediction.coefficient_scatter)
    return [
        Entry(quantity, prediction.method, value, Budget(time=scatter if scatter > 0 else math.nan), FORMULA, note)
        for quantity, value, scatter in zip(QUANTITIES, values, scatters)
    ]


def measured_near(
    path: Path, depth: float, density: float = math.nan, near: dict[str, tuple[float, float]] = NEAR
) -> pd.DataFrame:
    """Rows of a reference.csv near this depth [m] and density [kg/m3]; NaN: not known.

    Columns depth_m, sinkage_m, resistance, density_kgm3; near: least and greatest ratio. @raises ResultsError
    where a column is missing or fewer than three rows are near
    """
    rows = pd.DataFrame(read_numbers(path))
    if rows.empty:
        raise ResultsError(f"{path}: has no rows; a scatter needs three")
    conditions = {name: value for name, value in (("depth", depth), ("density", density)) if math.isfinite(value)}
    for column in (*(COLUMNS[name] for name in conditions), *NAME_IN_REFERENCE.values()):
        if column not in rows:
            needed = "depth_m, sinkage_m, resistance, density_kgm3"
            raise ResultsError(f"{path}: has no column '{column}'; needed are {needed}")
    for name, value in conditions.items():
        low, high = near[name]  # included: 0.18/0.2 is 0.9, whatever its last binary digit
        rows = rows[(rows[COLUMNS[name]] / value).between(low - ROUNDING, high + ROUNDING)]
    if len(rows) < 3:
        and_density = f" and near {density:.0f} kg/m3" if "density" in conditions else ""
        raise ResultsError(
            f"{path}: has {len(rows)} rows within {100 * (near['depth'][1] - 1):.0f} % of a depth of "
            f"{depth:.3g} m{and_density}; a scatter needs three"
        )
    return rows


def measured_entries(path: Path, run: WheelRun) -> list[Entry]:
    """Mean and scatter of the measurements near a run's conditions."""
    if not math.isfinite(run.number("depth")):
        raise ResultsError(f"{run.label}: has no terrain; --measured needs its depth")
    rows = measured_near(path, run.number("depth"), run.number("density"))
    note = f"mean and scatter of {len(rows)} tests"
    columns = [(quantity, rows[NAME_IN_REFERENCE[quantity.key]]) for quantity in QUANTITIES]
    return [Entry(q, MEASURED, column.mean(skipna=False), Budget(time=column.std(skipna=False)), MEASURED, note) for q, column in columns]


# ---- output as text and as files


def table_rows(result: Comparison) -> list[Line]:
    """Lines of compare.csv: texts and SI numbers."""
    lines: list[Line] = []
    for e in (*result.entries, *result.tracks.values()):
        parts = e.parts if e.of_run else Budget()
        line: Line = {"quantity": e.quantity.name, "source": e.source, "kind": e.kind, "value": e.value}
        line |= {"uncertainty": e.uncertainty, **{f"u_{name}": parts.part(name) for name in Budget.NAMES}}
        lines.append({**line, "cpu_time": e.cpu_time, "note": e.note})
    return lines


def parts_cell(entry: Entry) -> str:
    """Parts of an entry's uncertainty in its unit, and what is unknown; empty for others than runs."""
    return entry.parts.scaled(entry.quantity.scale).parts_text() if entry.of_run else ""


def comparison_report(result: Comparison) -> str:
    """Text with the tables and the verdict."""
    wide = max([len(e.label) for e in result.entries] + [10])
    lines = ["Conditions"]
    for name in SHOWN_CONDITIONS:
        texts = [run.text(name, "?") for run in result.runs]
        lines.append(f"  {name.replace('_', ' '):22} " + "   ".join(dict.fromkeys(texts)))
    for run in result.runs:
        size = f"{run.ground}, {run.describe_size()}, {run.model} model, {run.elements} {run.ground_kind.elements}"
        lines.append(f"  {run.label:{wide}}  {size}")
    for quantity in QUANTITIES:
        lines += ["", f"  {quantity.label:{wide}}  {'':18} {'cost':9}parts of the error"]
        for e in result.of(quantity):
            notes = ", ".join(filter(None, [parts_cell(e), e.note]))
            lines.append(f"  {e.label:{wide}}  {e.text():18} {duration(e.cpu_time):9}{notes}".rstrip())
    if result.tracks:
        lines += ["", f"  {TRACK_DENSITY.label:{wide}}  {'':27} parts of the error"]
        lines += [f"  {e.label:{wide}}  {e.text():27} {parts_cell(e)}" for e in result.tracks.values()]
    lines += ["", "± is one standard error, from the parts that are known. Verdicts allow two."]
    if result.differences:
        lines += ["", "COMPARED ALTHOUGH CONDITIONS DIFFER"]
        lines += [f"  {d.condition}: {d.text}" for d in result.differences]
    verdicts = (result.overall(), result.overall_of_best_estimates())
    unknown = [part for verdict in (*result.verdicts, *result.best_estimates) for part in verdict.unknown]
    return "\n".join([*lines, "", *conclusion(verdicts, result.findings(), unknown)])


def write_comparison(result: Comparison, folder: Path) -> None:
    """Writes compare.txt, compare.csv and compare.h5."""
    folder.mkdir(parents=True, exist_ok=True)
    report = comparison_report(result)
    (folder / "compare.txt").write_text(report + "\n", encoding="utf-8")
    lines = table_rows(result)
    head = "# SI units; uncertainties are one standard error; empty: not known"
    write_rows(folder / "compare.csv", [in_cells(line, 9) for line in lines], [head])
    with h5py.File(folder / "compare.h5", "w") as content:
        _write_hdf5(content, result, lines)


def _write_hdf5(content: Any, result: Comparison, lines: list[Line]) -> None:
    table = content.create_group("table")
    for name, sample in lines[0].items():
        values = [line[name] for line in lines]
        kind = h5py.string_dtype() if isinstance(sample, str) else np.float64
        table[name] = np.array(values, dtype=kind)
    content.attrs["verdict"] = result.overall()
    content.attrs["unit"] = "SI; uncertainties are one standard error, NaN: not known"
    for run in result.runs:
        group = content.create_group(f"runs/{run.label.replace('/', '_')}")
        for name, values in cruise_history(run)._asdict().items():
            group[f"history/{name}"] = values
        for name, values in settling_curve(run)._asdict().items():
            group[f"settling/{name}"] = values
        for name, condition in run.conditions.items():
            group.attrs[name] = condition.value
        if run.ground_kind.has_density:
            for name, cut in zip(("lengthwise", "across"), sections(run)):
                part = group.create_group(f"density/{name}")
                part["density"], part["edges"] = cut.density, cut.across_edges
                part["z_edges"] = cut.z_edges
