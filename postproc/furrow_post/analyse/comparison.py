# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compare: the same scene on several grounds, aligned, with uncertainties and a verdict.

Refused are runs whose conditions differ beyond TOLERANCES. Uncertainties are standard deviations: of the time average from the run itself;
of the size of elements or grains, of the domain and of the packing from a table of runs of the scene (cost_table.py). Two values agree when
they differ by no more than twice the root of the sum of their squares; what is not known is named, not taken as zero.
"""

import csv
import math
from dataclasses import dataclass, field

import h5py
import numpy as np

from . import conditions, cost_table, density
from .results import ResultsError
from .summary import with_error

COVERAGE = 2.0  # standard deviations within which two values agree
VAGUE = 0.3     # beyond this part of the value, agreement says nothing
# condition -> (largest relative difference, largest absolute difference); the larger of the two counts
TOLERANCES = {"load": (0.02, 0.0), "speed": (0.02, 0.0), "wheel_diameter": (0.02, 0.0), "wheel_width": (0.03, 0.0), "pressure": (0.02, 0.0),
              "depth": (0.06, 0.0), "density": (0.1, 0.0), "slip": (0.0, 0.03), "slip_angle": (0.0, 0.5), "camber": (0.0, 0.5),
              "gravity": (0.01, 0.0)}
QUANTITIES = {"sinkage": ("sinkage", "mm", 1e3), "coefficient": ("resistance coefficient", "", 1.0)}
NAME_IN_RUN = {"sinkage": "sinkage", "coefficient": "resistance_coefficient"}


@dataclass
class Entry:
    """One line of the comparison of one quantity, SI."""

    quantity: str
    source: str
    value: float
    parts: cost_table.Components
    kind: str             # run, formula, measured
    note: str = ""
    cpu_time: float = math.nan

    @property
    def uncertainty(self):
        return self.parts.total

    @property
    def unknown(self):
        return [name for name in cost_table.Components.NAMES if name not in self.parts.known] if self.kind == "run" else []


@dataclass
class Comparison:
    runs: list
    entries: list = field(default_factory=list)
    differences: list = field(default_factory=list)  # (condition, texts) that are not comparable, or were compared anyway
    verdicts: list = field(default_factory=list)
    tracks: dict = field(default_factory=dict)       # label -> (density, error)
    besides: list = field(default_factory=list)      # what differs besides the two quantities, in words

    def of(self, quantity, kind=None):
        return [e for e in self.entries if e.quantity == quantity and kind in (None, e.kind)]


def incomparable(runs, tolerances=TOLERANCES):
    """[(condition, text)] of every condition in which runs differ beyond its tolerance."""
    found = []
    kinds = [run.wheel for run in runs]
    if len(set(kinds)) > 1:
        found.append(("wheel", "; ".join(f"{run.label}: {run.wheel}" for run in runs)))
    for name, (relative, absolute) in tolerances.items():
        have = [(run, run.conditions[name].value) for run in runs if name in run.conditions and np.isfinite(run.conditions[name].value)]
        if len(have) < 2:
            continue
        values = [value for _, value in have]
        allowed = max(relative * max(abs(v) for v in values), absolute)
        if max(values) - min(values) > allowed * (1 + 1e-9):
            texts = "; ".join(f"{run.label}: {run.conditions[name].text()}" for run, _ in have)
            limit = f"{100 * relative:g} %" if relative else f"{absolute:g} {have[0][0].conditions[name].unit}".strip()
            found.append((name, f"{texts} (they may differ by {limit})"))
    return found


def unique_labels(runs):
    labels = [run.label for run in runs]
    for run in runs:
        if labels.count(run.label) > 1:
            run.label = f"{run.folder.resolve().parent.name}/{run.label}"


def entries_of_run(run, families):
    """The Entry of each quantity of a WheelRun, with the parts of its error that a table's families know."""
    entries = []
    key = ("half" if run.half else "whole")
    family = families.get((run.ground, key, run.wheel))
    for quantity, name in NAME_IN_RUN.items():
        value = run.values[name]
        parts = family.components(quantity, run.size, value.error) if family else cost_table.Components(time=value.error)
        if not family and run.ground == "continuum":
            parts.packing = 0.0
        note = "" if value.steady else "not called steady"
        entries.append(Entry(quantity, run.label, value.mean, parts, "run", note, run.cpu_time))
    return entries


def formula_entries(prediction):
    note = "extrapolated" if prediction.outside else ""
    values = (("sinkage", prediction.sinkage, prediction.sinkage_scatter), ("coefficient", prediction.coefficient, prediction.coefficient_scatter))
    known = lambda scatter: cost_table.Components(time=scatter) if scatter > 0 else cost_table.Components()
    return [Entry(quantity, prediction.method, value, known(scatter), "formula", note) for quantity, value, scatter in values]


def read_measured(path, depth, density_range=(0.85, 1.15), depth_range=(0.9, 1.1), density=None):
    """(sinkage, its scatter, coefficient, its scatter, number) of the rows of a reference.csv near this depth and density.

    Columns depth_m, sinkage_m, resistance, density_kgm3. @raises ResultsError where fewer than three rows are near
    """
    with open(path, encoding="utf-8") as file:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    try:
        near = [r for r in rows if depth_range[0] <= r["depth_m"] / depth <= depth_range[1] and
                (density is None or density_range[0] <= r["density_kgm3"] / density <= density_range[1])]
        z, c = (np.array([r[key] for r in near]) for key in ("sinkage_m", "resistance"))
    except KeyError as error:
        raise ResultsError(f"{path}: has no column {error}; needed are depth_m, sinkage_m, resistance, density_kgm3") from error
    if len(near) < 3:
        raise ResultsError(f"{path}: has {len(near)} rows within {100 * (depth_range[1] - 1):.0f} % of a depth of {depth:.3g} m"
                           f"{f' and near {density:.0f} kg/m3' if density else ''}; a scatter needs three")
    return z.mean(), z.std(ddof=1), c.mean(), c.std(ddof=1), len(near)


def measured_entries(path, run):
    bulk = run.conditions.get("density")
    z, dz, c, dc, n = read_measured(path, run.conditions["depth"].value, density=bulk.value if bulk else None)
    note = f"mean and scatter of {n} tests"
    return [Entry("sinkage", "measured", z, cost_table.Components(time=dz), "measured", note),
            Entry("coefficient", "measured", c, cost_table.Components(time=dc), "measured", note)]


def judge(a, b):
    """One sentence on two entries of a quantity, and whether they agree (None: not known)."""
    name, unit, scale = QUANTITIES[a.quantity]
    difference = b.value - a.value
    relative = f"{100 * difference / a.value:+.0f} %" if a.value else ""
    if not (math.isfinite(a.uncertainty) and math.isfinite(b.uncertainty)):
        lacking = ", ".join(e.source for e in (a, b) if not math.isfinite(e.uncertainty))
        return f"{name}: {b.source} against {a.source}: {relative}; no verdict, {lacking} has no uncertainty", None
    allowed = COVERAGE * math.hypot(a.uncertainty, b.uncertainty)
    agree = abs(difference) <= allowed
    lacking = sorted({f"{part} of {e.source}" for e in (a, b) for part in e.unknown})
    numbers = f"difference {scale * difference:+.3g}{' ' + unit if unit else ''} ({relative}), allowed {scale * allowed:.2g}"
    vague = agree and allowed > VAGUE * abs(a.value)
    beyond = "the known part of their uncertainty" if lacking else "their uncertainty"
    verdict = f"cannot be told apart, their uncertainty is {100 * allowed / abs(a.value):.0f} % of the value" if vague else \
        "agree within their uncertainty" if agree else f"differ by {abs(difference) / allowed:.1f} times what {beyond} allows"
    return f"{name}: {a.source} and {b.source} {verdict} ({numbers})" + (f"; not known: {', '.join(lacking)}" if lacking else ""), agree


def compare(runs, table=None, formulas=(), measured=None, anyway=False):
    """A Comparison of WheelRuns. @raises ResultsError with every reason why the runs are not comparable"""
    unique_labels(runs)
    differences = incomparable(runs)
    if differences and not anyway:
        raise ResultsError("these runs are not comparable:\n" + "\n".join(f"  {name}: {text}" for name, text in differences) +
                           "\n  --anyway compares them all the same, and says so")
    result = Comparison(runs, differences=differences)
    known = cost_table.families(table) if table else {}
    for run in runs:
        if run.ground != "none":
            result.tracks[run.label] = density.track_density(run)
        result.entries += entries_of_run(run, known)
    for prediction in formulas:
        result.entries += formula_entries(prediction)
    if measured:
        result.entries += measured_entries(measured, runs[0])
    for quantity in QUANTITIES:
        entries = result.of(quantity)
        first = result.of(quantity, "run")[0]
        others = [e for e in result.of(quantity, "run") if e is not first]
        for e in others:
            result.verdicts.append(judge(first, e))
        for e in entries:
            if e.kind == "measured":
                result.verdicts += [judge(e, r) for r in result.of(quantity, "run")]
    result.besides = what_differs(result)
    return result


def what_differs(result):
    """Sentences on the first run against the others: pressure half way down while the wheel is let down, density under the track."""
    first, sentences = result.runs[0], []
    for other in result.runs[1:]:
        z = 0.5 * min(run.values["sinkage"].mean for run in (first, other))
        curves = [settling(run) for run in (first, other)]
        if all(len(x) > 10 and x.min() < z < x.max() for x, _ in curves):
            # the first passage: the wheel may bounce later
            pressures = [float(p[np.argmax(x >= z)]) for x, p in curves]
            if min(pressures) > 0 and not 1 / 1.5 < pressures[1] / pressures[0] < 1.5:
                sentences.append(f"let down, at {1e3 * z:.0f} mm, {first.label} bears {pressures[0] / 1e3:.3g} kPa and {other.label} "
                                 f"{pressures[1] / 1e3:.3g} kPa")
        if first.label in result.tracks and other.label in result.tracks:
            (a, da), (b, db) = result.tracks[first.label], result.tracks[other.label]
            if abs(b - a) > COVERAGE * math.hypot(da, db) and abs(b - a) > 0.05 * a:
                sentences.append(f"under the track {first.label} has {with_error(a, da)} kg/m3 and {other.label} {with_error(b, db)} kg/m3")
    return sentences


def overall(result):
    """The verdict on the grounds among each other in one line."""
    among = [(text, agree) for text, agree in result.verdicts if "measured" not in text]
    if not among:
        return ""
    vague = [text.split(":")[0] for text, _ in among if "cannot be told apart" in text]
    if all(agree for _, agree in among) and vague:
        others = [text.split(":")[0] for text, _ in among if text.split(":")[0] not in vague]
        lost = ' and '.join(dict.fromkeys(vague))
        verdict = f"The runs agree in {' and '.join(dict.fromkeys(others))} within their uncertainty; in {lost} they" if others else \
            f"In {lost} the runs"
        verdict += " cannot be told apart: the uncertainty is too large."
    elif all(agree for _, agree in among):
        verdict = "The runs agree within their uncertainty in sinkage and resistance."
    else:
        what = [text.split(":")[0] for text, agree in among if not agree]
        known = " as far as their uncertainty is known" if any("not known" in text for text, _ in among) else ""
        verdict = f"The runs do not agree in {' and '.join(dict.fromkeys(what))}{known}."
    if result.differences:
        verdict += " They were compared though their conditions differ: " + ", ".join(name for name, _ in result.differences) + "."
    return verdict


def rows(result):
    """Lines of the table: dicts with strings and SI numbers."""
    lines = []
    for e in result.entries:
        name, _, _ = QUANTITIES[e.quantity]
        line = {"quantity": name, "source": e.source, "kind": e.kind, "value": e.value, "uncertainty": e.uncertainty}
        line.update({f"u_{part}": getattr(e.parts, part) if e.kind == "run" else math.nan for part in cost_table.Components.NAMES})
        line.update({"cpu_time": e.cpu_time, "note": e.note})
        lines.append(line)
    for label, (value, error) in result.tracks.items():
        lines.append({"quantity": "density under the track", "source": label, "kind": "run", "value": value, "uncertainty": error,
                      **{f"u_{part}": math.nan for part in cost_table.Components.NAMES}, "u_time": error, "cpu_time": math.nan, "note": ""})
    return lines


def _cell(value, scale=1.0):
    return f"{scale * value:.2g}" if math.isfinite(value) else "?"


def duration(seconds):
    if not math.isfinite(seconds):
        return ""
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.1f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def text(result):
    """The table and the verdict for a person."""
    wide = max([len(e.source) for e in result.entries] + [10])
    lines = ["Conditions"]
    for name in ("load", "speed", "slip", "slip_by_vehicle_speed", "wheel_diameter", "wheel_width", "depth", "density"):
        texts = [run.conditions[name].text() if name in run.conditions else "?" for run in result.runs]
        lines.append(f"  {name.replace('_', ' '):22} " + "   ".join(dict.fromkeys(texts)))
    for run in result.runs:
        lines.append(f"  {run.label:{wide}}  {run.ground}, {run.describe_size()}, {'half' if run.half else 'whole'} model, "
                     f"{run.elements} {'particles' if run.ground == 'continuum' else 'grains'}")
    for quantity, (name, unit, scale) in QUANTITIES.items():
        lines += ["", f"{name}{f' [{unit}]' if unit else ''}",
                  f"  {'':{wide}}  {'':18} {'of which time':>13} {'size':>8} {'domain':>8} {'packing':>8}   cost"]
        for e in result.of(quantity):
            value = with_error(scale * e.value, scale * e.uncertainty) if math.isfinite(e.uncertainty) else f"{scale * e.value:.3g}"
            parts = [_cell(getattr(e.parts, part), scale) for part in cost_table.Components.NAMES] if e.kind == "run" else ["", "", "", ""]
            lines.append(f"  {e.source:{wide}}  {value:18} {parts[0]:>13} {parts[1]:>8} {parts[2]:>8} {parts[3]:>8}   {duration(e.cpu_time):9}"
                         f"{e.note}".rstrip())
    if result.tracks:
        lines += ["", "density under the track [kg/m3]"]
        lines += [f"  {label:{wide}}  {with_error(value, error)}" for label, (value, error) in result.tracks.items()]
    lines += ["", "± is one standard deviation, from the parts that are known; '?' is not known. Verdicts allow two."]
    if result.differences:
        lines += ["", "COMPARED ALTHOUGH CONDITIONS DIFFER"] + [f"  {name}: {t}" for name, t in result.differences]
    lines += ["", "Verdict", "  " + overall(result)] + ["  - " + t for t, _ in result.verdicts]
    lines += ["  - besides: " + sentence for sentence in result.besides]
    return "\n".join(lines)


def histories(run):
    """distance from the start of the cruise [m], sinkage [m], resistance coefficient smoothed over a tenth of the radius."""
    columns = run.results.columns
    phase, x = columns["phase"], columns["x"]
    cruise = np.flatnonzero(phase == 2)
    begin = x[cruise[0]] if len(cruise) else x[-1]
    moving = np.flatnonzero(phase >= 1)
    distance = x[moving] - begin
    step = max(np.median(np.diff(distance[-max(len(cruise), 2):])), 1e-9)
    window = max(int(0.1 * run.radius / step), 1)
    mean = lambda v: np.convolve(v, np.ones(window), "same") / np.convolve(np.ones_like(v), np.ones(window), "same")
    force_z = mean(columns["force_z"][moving])
    with np.errstate(invalid="ignore", divide="ignore"):
        coefficient = np.where(force_z > 0.2 * run.conditions["load"].value, -mean(columns["force_x"][moving]) / force_z, np.nan)
    shift = run.conditions["datum_shift"].value if "datum_shift" in run.conditions else 0.0
    return distance, columns["sinkage"][moving] + shift, coefficient


def settling(run):
    """Pressure against sinkage while the wheel is let down: force over the projected contact of a rigid cylinder, 2 b sqrt(2 r z - z^2)."""
    columns = run.results.columns
    rows_ = np.flatnonzero((columns["phase"] == 0) & (columns["sinkage"] > 0.02 * run.radius))
    z = columns["sinkage"][rows_]
    area = 2 * run.conditions["wheel_width"].value * np.sqrt(np.maximum(2 * run.radius * z - z * z, 1e-12))
    window = max(len(z) // 60, 1)
    force = np.convolve(columns["force_z"][rows_], np.ones(window) / window, "same") if len(z) else z
    return z, force / area


def write(result, folder):
    """compare.txt, compare.csv, compare.h5."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "compare.txt").write_text(text(result) + "\n", encoding="utf-8")
    lines = rows(result)
    with open(folder / "compare.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(lines[0]), lineterminator="\n")
        file.write("# SI units; uncertainties are standard deviations; empty: not known\n")
        writer.writeheader()
        for line in lines:
            writer.writerow({k: "" if isinstance(v, float) and math.isnan(v) else v for k, v in line.items()})
    with h5py.File(folder / "compare.h5", "w") as content:
        table = content.create_group("table")
        for key in lines[0]:
            values = [line[key] for line in lines]
            table[key] = np.array(values, dtype=h5py.string_dtype()) if isinstance(values[0], str) else np.array(values, float)
        content.attrs["verdict"] = overall(result)
        content.attrs["unit"] = "SI; uncertainties are standard deviations, NaN: not known"
        for run in result.runs:
            group = content.create_group(f"runs/{run.label.replace('/', '_')}")
            for name, value in zip(("distance", "sinkage", "coefficient"), histories(run)):
                group[f"history/{name}"] = value
            for name, value in zip(("sinkage", "pressure"), settling(run)):
                group[f"settling/{name}"] = value
            for name, condition in run.conditions.items():
                group.attrs[name] = condition.value
            if run.ground != "none":
                for name, cut in zip(("lengthwise", "across"), density.sections(run)):
                    part = group.create_group(f"density/{name}")
                    part["density"], part["edges"], part["z_edges"] = cut.density, cut.across_edges, cut.z_edges
