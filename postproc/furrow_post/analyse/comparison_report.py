# SPDX-License-Identifier: GPL-2.0-or-later
"""A comparison for a person and for programs: compare.txt, compare.csv, compare.h5."""

from pathlib import Path
from typing import Any

import h5py
import numpy as np

from ..csv_table import in_cells, write_rows
from ..formatting import duration
from ..uncertainty.budget import Budget
from ..uncertainty.verdict import QUANTITIES, TRACK_DENSITY, Entry, conclusion
from .comparison import Comparison
from .density import sections
from .wheel_histories import cruise_history, settling_curve

SHOWN_CONDITIONS = (
    *("load", "speed", "slip", "slip_by_vehicle_speed", "wheel_diameter", "wheel_width", "depth", "density"),
)

Line = dict[str, str | float]


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
    """The tables and the verdict for a person."""
    wide = max([len(e.label) for e in result.entries] + [10])
    lines = ["Conditions"]
    for name in SHOWN_CONDITIONS:
        texts = [run.text(name, "?") for run in result.runs]
        lines.append(f"  {name.replace('_', ' '):22} " + "   ".join(dict.fromkeys(texts)))
    for run in result.runs:
        size = f"{run.ground}, {run.describe_size()}, {run.model} model, {run.elements} {run.elements_name}"
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
    return "\n".join([*lines, "", *conclusion(verdicts, findings(result), unknown)])


def findings(result: Comparison) -> list[str]:
    """The sentences of all verdicts, then the remarks."""
    sentences = [v.sentence for v in (*result.verdicts, *result.best_estimates)]
    return sentences + [f"also: {text}" for text in result.remarks]


def write_comparison(result: Comparison, folder: Path) -> None:
    """compare.txt, compare.csv, compare.h5."""
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
        if run.has_density:
            for name, cut in zip(("lengthwise", "across"), sections(run)):
                part = group.create_group(f"density/{name}")
                part["density"], part["edges"] = cut.density, cut.across_edges
                part["z_edges"] = cut.z_edges
