# SPDX-License-Identifier: GPL-2.0-or-later
"""The same scene on several grounds: aligned, with uncertainties and verdicts.

Refused are runs whose conditions differ beyond TOLERANCES. Uncertainties are standard deviations:
of the time average from the run itself; of the size of elements or grains, of the domain and of the
packing from a table of runs of the scene (cost_table.py), which also gives what each run comes to
at size zero. Two values agree when they differ by no more than COVERAGE times the root of the sum
of their squares; what is not known is named, not taken as zero.
"""

import csv
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np

from ..csv_table import read_numbers
from ..errors import ResultsError
from ..formatting import duration, in_unit, value_text, with_error
from ..read.wheel_run import WheelRun
from . import cost_table, empirical
from .cost_table import Components, Family, FamilyKey
from .density import sections, track_density
from .statistics import commonest
from .verdict import COVERAGE, QUANTITIES, Agreement, Quantity, Verdict, joined, quantities_with
from .wheel_histories import cruise_history, settling_curve

VAGUE = 0.3  # beyond this part of the value, agreement says nothing
NAME_IN_RUN = {"sinkage": "sinkage", "coefficient": "resistance_coefficient"}
# Kinds of entries; LIMIT: what a run comes to at size zero
RUN, LIMIT, FORMULA, MEASURED = "run", "size zero", "formula", "measured"


class Tolerance(NamedTuple):
    """Largest difference of a condition; the larger of the two counts."""

    relative: float
    absolute: float


TOLERANCES = {
    "load": Tolerance(0.02, 0.0),
    "speed": Tolerance(0.02, 0.0),
    "wheel_diameter": Tolerance(0.02, 0.0),
    "wheel_width": Tolerance(0.03, 0.0),
    "pressure": Tolerance(0.02, 0.0),
    "depth": Tolerance(0.06, 0.0),
    "density": Tolerance(0.1, 0.0),
    "slip": Tolerance(0.0, 0.03),
    "slip_angle": Tolerance(0.0, 0.5),
    "camber": Tolerance(0.0, 0.5),
    "slope": Tolerance(0.0, 0.5),
    "gravity": Tolerance(0.01, 0.0),
}


@dataclass(frozen=True)
class Entry:
    """One value of one quantity in the comparison, SI."""

    quantity: Quantity
    source: str  # label of a run, name of a formula, "measured"
    value: float
    parts: Components
    kind: str  # RUN, LIMIT, FORMULA, MEASURED
    note: str = ""
    cpu_time: float = math.nan

    @property
    def label(self) -> str:
        """The source, "grains at size zero" for a limit."""
        return f"{self.source} at {LIMIT}" if self.kind == LIMIT else self.source

    @property
    def of_run(self) -> bool:
        """Whether its uncertainty has the parts of a run's."""
        return self.kind in (RUN, LIMIT)

    @property
    def uncertainty(self) -> float:
        """NaN where nothing of it is known."""
        return self.parts.total

    @property
    def unknown(self) -> list[str]:
        """Parts of its uncertainty that are not known."""
        return self.parts.unknown if self.of_run else []

    def text(self) -> str:
        """The value with its uncertainty in the unit of the quantity."""
        scale = self.quantity.scale
        return value_text(scale * self.value, scale * self.uncertainty)


@dataclass(frozen=True)
class Difference:
    """A condition in which runs differ beyond its tolerance."""

    condition: str
    text: str


@dataclass
class Comparison:
    """Runs beside each other, beside formulas and measurements."""

    runs: list[WheelRun]
    entries: list[Entry] = field(default_factory=list)
    differences: list[Difference] = field(default_factory=list)
    verdicts: list[Verdict] = field(default_factory=list)
    at_size_zero: list[Verdict] = field(default_factory=list)  # on the runs' limits
    tracks: dict[str, tuple[float, float]] = field(default_factory=dict)  # density, error [kg/m3]
    remarks: list[str] = field(default_factory=list)  # what differs apart from the two quantities

    def of(self, quantity: Quantity, kind: str | None = None) -> list[Entry]:
        return [e for e in self.entries if e.quantity == quantity and kind in (None, e.kind)]


def answers_of_ground(runs: Iterable[WheelRun]) -> set[str]:
    """Conditions that the ground answers in all runs: slip of towed wheels, and speed of free
    ones."""
    runs = list(runs)
    if all(run.text("travel") == "free" for run in runs):
        return {"slip", "speed"}
    return {"slip"} if all(run.text("mode") == "towed" for run in runs) else set()


def differ(values: Sequence[float], tolerance: Tolerance) -> bool:
    """Whether values of a condition differ beyond its tolerance."""
    allowed = max(tolerance.relative * max(abs(v) for v in values), tolerance.absolute)
    return max(values) - min(values) > allowed * (1 + 1e-9)


def incomparable(
    runs: Sequence[WheelRun], tolerances: Mapping[str, Tolerance] = TOLERANCES
) -> list[Difference]:
    """Every condition in which runs differ beyond its tolerance.

    What is the ground's answer in all of them does not count.
    """
    found = []
    answers = answers_of_ground(runs)
    if len({run.wheel for run in runs}) > 1:
        text = "; ".join(f"{run.label}: {run.wheel}" for run in runs)
        found.append(Difference("wheel", text))
    for name, tolerance in tolerances.items():
        have = [run for run in runs if np.isfinite(run.number(name))]
        if len(have) < 2 or name in answers:
            continue
        if differ([run.number(name) for run in have], tolerance):
            text = "; ".join(f"{run.label}: {run.text(name)}" for run in have)
            unit = have[0].conditions[name].unit
            relative, absolute = tolerance
            limit = f"{100 * relative:g} %" if relative else f"{absolute:g} {unit}".strip()
            found.append(Difference(name, f"{text} (they may differ by {limit})"))
    return found


def uniquely_labelled(runs: Sequence[WheelRun]) -> list[WheelRun]:
    """The runs; where labels are equal, each gets the name of the folder above its own too."""
    labels = [run.label for run in runs]
    return [
        run.relabelled(f"{run.folder.resolve().parent.name}/{run.label}")
        if labels.count(run.label) > 1
        else run
        for run in runs
    ]


def entries_of_run(run: WheelRun, families: Mapping[FamilyKey, Family]) -> list[Entry]:
    """Each quantity of a run, with the parts of its error that a table's families know."""
    entries = []
    family = families.get(FamilyKey(run.ground, run.model, run.wheel))
    for quantity in QUANTITIES:
        value = run.values[NAME_IN_RUN[quantity.key]]
        if family:
            parts = family.components(quantity.key, run.size, value.standard_error)
        else:
            packing = 0.0 if run.ground == "continuum" else math.nan
            parts = Components(time=value.standard_error, packing=packing)
        note = "" if value.steady else "not called steady"
        entries.append(Entry(quantity, run.label, value.mean, parts, RUN, note, run.cpu_time))
    return entries


def limits_of_run(run: WheelRun, families: Mapping[FamilyKey, Family]) -> list[Entry]:
    """Each quantity at size zero, as far as a table's families have more than one size."""
    entries = []
    family = families.get(FamilyKey(run.ground, run.model, run.wheel))
    for quantity in QUANTITIES:
        steady = run.values[NAME_IN_RUN[quantity.key]]
        limit = family and family.at_size_zero(
            quantity.key, run.size, steady.mean, steady.standard_error
        )
        if limit:
            value, parts = limit
            entries.append(Entry(quantity, run.label, value, parts, LIMIT))
    return entries


def formula_entries(prediction: empirical.Prediction) -> list[Entry]:
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
            Components(time=scatter) if scatter > 0 else Components(),
            FORMULA,
            note,
        )
        for quantity, (value, scatter) in zip(QUANTITIES, values)
    ]


class Measured(NamedTuple):
    """Mean and scatter of measurements near a run's conditions."""

    sinkage: float  # [m]
    sinkage_scatter: float  # standard deviation [m]
    coefficient: float
    coefficient_scatter: float
    tests: int


def read_measured(
    path: Path,
    depth: float,
    density: float | None = None,
    depth_range: tuple[float, float] = (0.9, 1.1),
    density_range: tuple[float, float] = (0.85, 1.15),
) -> Measured:
    """Of the rows of a reference.csv near this depth [m] and density [kg/m3].

    Columns depth_m, sinkage_m, resistance, density_kgm3; ranges are relative. @raises ResultsError
    where a column is missing or fewer than three rows are near
    """
    try:
        near = [
            row
            for row in read_numbers(path)
            if depth_range[0] <= row["depth_m"] / depth <= depth_range[1]
            and (
                density is None
                or density_range[0] <= row["density_kgm3"] / density <= density_range[1]
            )
        ]
        sinkage = np.array([row["sinkage_m"] for row in near])
        coefficient = np.array([row["resistance"] for row in near])
    except KeyError as error:
        raise ResultsError(
            f"{path}: has no column {error}; needed are depth_m, sinkage_m, resistance, "
            "density_kgm3"
        ) from error
    if len(near) < 3:
        and_density = f" and near {density:.0f} kg/m3" if density else ""
        raise ResultsError(
            f"{path}: has {len(near)} rows within {100 * (depth_range[1] - 1):.0f} % of a depth of "
            f"{depth:.3g} m{and_density}; a scatter needs three"
        )
    return Measured(
        float(sinkage.mean()),
        float(sinkage.std(ddof=1)),
        float(coefficient.mean()),
        float(coefficient.std(ddof=1)),
        len(near),
    )


def measured_entries(path: Path, run: WheelRun) -> list[Entry]:
    density = run.number("density") if "density" in run.conditions else None
    if not math.isfinite(run.number("depth")):
        raise ResultsError(f"{run.label}: has no terrain; --measured needs its depth")
    measured = read_measured(path, run.number("depth"), density)
    note = f"mean and scatter of {measured.tests} tests"
    values = (
        (measured.sinkage, measured.sinkage_scatter),
        (measured.coefficient, measured.coefficient_scatter),
    )
    return [
        Entry(quantity, MEASURED, value, Components(time=scatter), MEASURED, note)
        for quantity, (value, scatter) in zip(QUANTITIES, values)
    ]


def judge(a: Entry, b: Entry) -> Verdict:
    """The verdict on two entries of a quantity."""
    quantity = a.quantity
    name = f"{quantity.name} at {LIMIT}" if a.kind == LIMIT else quantity.name
    measured = MEASURED in (a.kind, b.kind)
    difference = b.value - a.value
    relative = f"{100 * difference / a.value:+.0f} %" if a.value else ""
    no_uncertainty = [e.source for e in (a, b) if not math.isfinite(e.uncertainty)]
    if no_uncertainty:
        sentence = (
            f"{name}: {b.source} against {a.source}: {relative}; no verdict, "
            f"{', '.join(no_uncertainty)} has no uncertainty"
        )
        return Verdict(quantity, a.source, b.source, Agreement.UNKNOWN, sentence, measured)
    allowed = COVERAGE * math.hypot(a.uncertainty, b.uncertainty)
    unknown = tuple(sorted({f"{part} of {e.source}" for e in (a, b) for part in e.unknown}))
    agreement, what, share = Agreement.AGREE, "agree", ""
    if abs(difference) > allowed:
        agreement, what = Agreement.DIFFER, "differ"
    elif allowed > VAGUE * abs(a.value):
        agreement, what = Agreement.UNDECIDED, "cannot be told apart"
        share = f", {100 * allowed / abs(a.value):.0f} % of the value"
    unit = f" {quantity.unit}" if quantity.unit else ""
    sentence = (
        f"{name}: {a.source} and {b.source} {what}: "
        f"{quantity.scale * difference:+.3g}{unit} ({relative}), "
        f"{quantity.scale * allowed:.2g} allowed{share}"
    )
    if unknown:
        sentence += f"; not known: {', '.join(unknown)}"
    return Verdict(quantity, a.source, b.source, agreement, sentence, measured, unknown)


def compare(
    runs: Sequence[WheelRun],
    table: Sequence[cost_table.Row] | None = None,
    formulas: Sequence[empirical.Prediction] = (),
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
        if run.ground != "none":
            result.tracks[run.label] = track_density(run)
        result.entries += entries_of_run(run, known)
        result.entries += limits_of_run(run, known)
    for prediction in formulas:
        result.entries += formula_entries(prediction)
    if measured:
        result.entries += measured_entries(measured, runs[0])
    for quantity in QUANTITIES:
        first, *others = result.of(quantity, RUN)
        result.verdicts += [judge(first, other) for other in others]
        limits = result.of(quantity, LIMIT)
        result.at_size_zero += [judge(limits[0], other) for other in limits[1:]]
        for reference in result.of(quantity, MEASURED):
            result.verdicts += [judge(reference, run) for run in (first, *others)]
    result.remarks = remarks(result)
    return result


def remarks(result: Comparison) -> list[str]:
    """The first run against the others: pressure half way down, density under the track."""
    first = result.runs[0]
    sentences = []
    for other in result.runs[1:]:
        z = 0.5 * min(run.values["sinkage"].mean for run in (first, other))
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
            (a, a_error), (b, b_error) = result.tracks[first.label], result.tracks[other.label]
            if abs(b - a) > max(COVERAGE * math.hypot(a_error, b_error), 0.05 * a):
                sentences.append(
                    f"under the track {first.label} has {with_error(a, a_error)} kg/m3 and "
                    f"{other.label} {with_error(b, b_error)} kg/m3"
                )
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


def overall_at_size_zero(result: Comparison) -> str:
    """The same of the runs' limits; empty where fewer than two are known."""
    among = result.at_size_zero
    return f"At {LIMIT}: {summed_up(among, 'runs')}" if among else ""


def summed_up(among: Sequence[Verdict], who: str) -> str:
    """Several verdicts in one line; who: were judged."""
    differing = quantities_with(among, Agreement.DIFFER)
    undecided = quantities_with(among, Agreement.UNDECIDED)
    unknown = quantities_with(among, Agreement.UNKNOWN)
    agreed = [
        name
        for name in quantities_with(among, Agreement.AGREE)
        if name not in differing + undecided + unknown
    ]
    verdict = ""
    if differing:
        known = " as far as their uncertainty is known" if any(v.unknown for v in among) else ""
        verdict = f"The {who} do not agree in {joined(differing)}{known}."
    elif undecided:
        if agreed:
            verdict = f"The {who} agree in {joined(agreed)} within their uncertainty; "
        verdict += f"in {joined(undecided)} they" if agreed else f"In {joined(undecided)} the {who}"
        verdict += " cannot be told apart: the uncertainty is too large."
    elif not unknown:
        verdict = f"The {who} agree within their uncertainty in sinkage and resistance."
    elif agreed:
        verdict = f"The {who} agree in {joined(agreed)} within their uncertainty."
    if unknown:
        verdict += f" There is no verdict in {joined(unknown)}: an uncertainty is not known."
    return verdict.strip()


def table_rows(result: Comparison) -> list[dict[str, str | float]]:
    """Lines of compare.csv: texts and SI numbers."""
    nothing = {f"u_{part}": math.nan for part in Components.NAMES}
    lines: list[dict[str, str | float]] = []
    for e in result.entries:
        known = {f"u_{part}": e.parts.part(part) for part in Components.NAMES}
        lines.append(
            {
                "quantity": e.quantity.name,
                "source": e.source,
                "kind": e.kind,
                "value": e.value,
                "uncertainty": e.uncertainty,
                **(known if e.of_run else nothing),
                "cpu_time": e.cpu_time,
                "note": e.note,
            }
        )
    for label, (value, error) in result.tracks.items():
        lines.append(
            {
                "quantity": "density under the track",
                "source": label,
                "kind": RUN,
                "value": value,
                "uncertainty": error,
                **nothing,
                "u_time": error,
                "cpu_time": math.nan,
                "note": "",
            }
        )
    return lines


def component_cells(entry: Entry) -> list[str]:
    """Parts of an entry's uncertainty in its unit, "?" for what is not known; empty for others."""
    if not entry.of_run:
        return [""] * len(Components.NAMES)
    scale = entry.quantity.scale
    return [f"{scale * p:.2g}" if math.isfinite(p) else "?" for p in entry.parts.parts()]


SHOWN_CONDITIONS = (
    "load",
    "speed",
    "slip",
    "slip_by_vehicle_speed",
    "wheel_diameter",
    "wheel_width",
    "depth",
    "density",
)


def comparison_report(result: Comparison) -> str:
    """The tables and the verdict for a person."""
    wide = max([len(e.label) for e in result.entries] + [10])
    lines = ["Conditions"]
    for name in SHOWN_CONDITIONS:
        texts = [run.text(name, "?") for run in result.runs]
        lines.append(f"  {name.replace('_', ' '):22} " + "   ".join(dict.fromkeys(texts)))
    lines += [
        f"  {run.label:{wide}}  {run.ground}, {run.describe_size()}, {run.model} model, "
        f"{run.elements} {run.elements_name}"
        for run in result.runs
    ]
    for quantity in QUANTITIES:
        columns = f"{'of which time':>13} {'size':>8} {'domain':>8} {'packing':>8}   cost"
        lines += ["", quantity.label, f"  {'':{wide}}  {'':18} {columns}"]
        for e in result.of(quantity):
            time, size, domain, packing = component_cells(e)
            lines.append(
                f"  {e.label:{wide}}  {e.text():18} {time:>13} {size:>8} {domain:>8} {packing:>8}"
                f"   {duration(e.cpu_time):9}{e.note}".rstrip()
            )
    if result.tracks:
        lines += ["", f"density under the track{in_unit('kg/m3')}"]
        lines += [
            f"  {label:{wide}}  {with_error(*track)}" for label, track in result.tracks.items()
        ]
    lines += [
        "",
        "± is one standard deviation, from the parts that are known; '?' is not known. Verdicts "
        "allow two.",
    ]
    if result.differences:
        lines += ["", "COMPARED ALTHOUGH CONDITIONS DIFFER"]
        lines += [f"  {d.condition}: {d.text}" for d in result.differences]
    lines += ["", "Verdict", "  " + overall(result)]
    if result.at_size_zero:
        lines.append("  " + overall_at_size_zero(result))
    lines += [f"  - {sentence}" for sentence in findings(result)]
    return "\n".join(lines)


def findings(result: Comparison) -> list[str]:
    """The sentences of all verdicts, then the remarks."""
    sentences = [v.sentence for v in (*result.verdicts, *result.at_size_zero)]
    return sentences + [f"also: {text}" for text in result.remarks]


def write_comparison(result: Comparison, folder: Path) -> None:
    """compare.txt, compare.csv, compare.h5."""
    folder.mkdir(parents=True, exist_ok=True)
    report = comparison_report(result)
    (folder / "compare.txt").write_text(report + "\n", encoding="utf-8")
    lines = table_rows(result)
    with open(folder / "compare.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(lines[0]), lineterminator="\n")
        file.write("# SI units; uncertainties are standard deviations; empty: not known\n")
        writer.writeheader()
        for line in lines:
            unknown = {k: "" for k, v in line.items() if isinstance(v, float) and math.isnan(v)}
            writer.writerow({**line, **unknown})
    with h5py.File(folder / "compare.h5", "w") as content:
        _write_hdf5(content, result, lines)


def _write_hdf5(content: Any, result: Comparison, lines: list[dict[str, str | float]]) -> None:
    table = content.create_group("table")
    for name, sample in lines[0].items():
        values = [line[name] for line in lines]
        kind = h5py.string_dtype() if isinstance(sample, str) else np.float64
        table[name] = np.array(values, dtype=kind)
    content.attrs["verdict"] = overall(result)
    content.attrs["unit"] = "SI; uncertainties are standard deviations, NaN: not known"
    for run in result.runs:
        group = content.create_group(f"runs/{run.label.replace('/', '_')}")
        for name, values in cruise_history(run)._asdict().items():
            group[f"history/{name}"] = values
        for name, values in settling_curve(run)._asdict().items():
            group[f"settling/{name}"] = values
        for name, condition in run.conditions.items():
            group.attrs[name] = condition.value
        if run.ground != "none":
            for name, cut in zip(("lengthwise", "across"), sections(run)):
                part = group.create_group(f"density/{name}")
                part["density"], part["edges"] = cut.density, cut.across_edges
                part["z_edges"] = cut.z_edges
