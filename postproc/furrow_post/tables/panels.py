# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of a study: panels with lines of tables and of runs.

    curves.png:
      size: [9, 4]            inches; dpi, columns (of panels) and style (that of the guides' figures) may follow
      panels:
        - axes: {xlabel: ..., ylabel: ..., xlim: [0, 1]}      of matplotlib's Axes.set
          legend: {fontsize: 7}                               none: false
          xticks: {ticks: [0, 1], labels: [a, b]}             further ones of Axes.set_xticks
          lines:
            - {table: results.csv, where: ..., by: law, x: ..., y: ..., yerr: ..., label: ..., look: {fmt: o}}
            - {runs: [stage], curve: plate, x: 1e3 * sinkage, y: load, label: '{what}', look: {lw: 1}}
            - {level: reference.peak_N, look: {color: k}}     a horizontal line; band: [low, high]

x, y, xerr and yerr are expressions of the columns as arrays. A line of a table with `by` has a line for each cell of
this column; `looks` has further looks by cell. A line of runs has a line for each run, of the numbers of a measure.
Other figures name a function: draw: sections, density_sections, stress, sweep, or one of evaluate.py.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pandas
from matplotlib.axes import Axes

from ..errors import ResultsError
from ..figures.style import annotate_panel, panel_letters, save, use_style
from ..figures.terrain_figure import draw_density_section, draw_stress, draw_terrain
from ..read.terrain import Terrain
from ..study.study_files import Output
from ..study.runs import Run, Runs
from ..sweep.sweep_curves import CONDITIONS, HUB_DROP, PULL, SLIP, TORQUE, Curve, Figure, Line
from ..sweep.drawing import draw_sweep
from ..sweep.series import read_series
from .frames import Row, value_of
from .operations import Known, arrays, groups, where
from .tyre_measures import tyre_print

Spec = Mapping[str, Any]


def listed(names: str | Sequence[str]) -> list[str]:
    """Names of one or several; the stage "all" of a study.yaml has no name in its runs."""
    return ["" if one == "all" else str(one) for one in ([names] if isinstance(names, str) else names)]


@dataclass(frozen=True)
class Sources:
    """Data that lines are drawn of. names: of a run; curve: its numbers by a measure with arguments."""

    runs: Runs
    tables: Mapping[str, pandas.DataFrame]
    constants: Row
    names: Callable[[Run], Row]
    curve: Callable[[str, Run, Spec], Row]


def sources_of(spec: Spec) -> list[Spec]:
    """Sources of the lines of all panels, or of the figure."""
    lines = [line for panel in spec.get("panels") or [] for line in panel.get("lines") or []]
    return [one for one in (*lines, spec) if "table" in one or "runs" in one]


def draw(spec: Spec, sources: Sources, target: Path) -> None:
    """@raises ResultsError for a line that cannot be drawn"""
    if spec.get("style", True):
        use_style()
    panels = spec["panels"]
    columns = spec.get("columns", len(panels))
    rows = math.ceil(len(panels) / columns)
    size = spec.get("size", (4.5 * columns, 3.8 * rows))
    figure, grid = plt.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False)
    for axes, panel, letter in zip(grid.flat, panels, panel_letters()):
        for line in panel.get("lines") or []:
            draw_line(axes, line, sources)
        axes.set(**panel.get("axes", {}))
        if "xticks" in panel:
            axes.set_xticks(**panel["xticks"])
        if panel.get("grid"):
            axes.grid(alpha=0.3)
        if "title" in panel:
            annotate_panel(axes, letter, panel["title"])
        if panel.get("legend", True) and axes.get_legend_handles_labels()[0]:
            axes.legend(**(panel["legend"] if isinstance(panel.get("legend"), Mapping) else {"fontsize": 8, "frameon": False}))
    save(figure, target, dpi=spec.get("dpi", 90))


def draw_line(axes: Axes, line: Spec, sources: Sources) -> None:
    look = dict(line.get("look") or {})
    if "level" in line:
        axes.axhline(value_of(line["level"], sources.constants, "figures"), label=line.get("label"), **look)
        return
    if "band" in line:
        low, high = (value_of(end, sources.constants, "figures") for end in line["band"])
        axes.axhspan(low, high, label=line.get("label"), **{"color": "0.9", "zorder": 0, **look})
        return
    for names, own in named_arrays(line, sources):
        values = {}
        for key in ("x", "y", "xerr", "yerr"):
            if key in line:
                values[key] = np.asarray(value_of(line[key], names, f"figures, {key}"))
        label = str(line["label"]).format(**names) if "label" in line else None
        given = {**look, **own}
        if {"xerr", "yerr"} & values.keys() or "fmt" in given:
            axes.errorbar(values.pop("x"), values.pop("y"), label=label, **values, **{"capsize": 3, **given})
        else:
            axes.plot(values["x"], values["y"], *([given.pop("mark")] if "mark" in given else []), label=label, **given)


def named_arrays(line: Spec, sources: Sources) -> Iterator[tuple[Row, Row]]:
    """Keys of the arrays of each line, and its further style."""
    looks = line.get("looks") or {}
    if "runs" in line:
        chosen = sources.runs.ended(*listed(line["runs"])) if line.get("failed") else sources.runs.done(*listed(line["runs"]))
        for run in chosen:
            names = {**sources.constants, **sources.names(run)}
            if value_of(line.get("where", True), names, "figures, where"):
                yield {**names, **sources.curve(line["curve"], run, line.get("with") or {})}, looks.get(run.name, {})
        return
    if "table" not in line:
        yield dict(sources.constants), {}
        return
    frame = sources.tables[line["table"]]
    if "where" in line:
        frame = where(frame, Known(sources.tables, sources.constants), line["where"])
    if "sort" in line:
        frame = frame.sort_values(line["sort"], kind="stable")
    for key, rows in groups(frame, line.get("by", [])):
        cell = next(iter(key.values()), "")
        yield {**sources.constants, **arrays(rows), **key}, looks.get(cell, {})


# ---- figures of one kind


def sections(runs: Runs, tables: Mapping[str, pandas.DataFrame], output: Output, titles: Mapping[str, str], file: str) -> None:
    """The ground along and across the track, a file for each run that is there. file: its name with {run}"""
    for name, title in titles.items():
        if run := runs.one(name):
            draw_terrain(run.folder, title, "", output.path(file.format(run=name)), dpi=75)


def density_sections(runs: Runs, tables: Mapping[str, pandas.DataFrame], target: Path, names: Sequence[str]) -> None:
    """Density in the middle plane, a panel for each run that is there."""
    shown = [run for name in names if (run := runs.one(name))]
    figure, panels = plt.subplots(1, len(shown), figsize=(4.6 * len(shown), 4.4), layout="constrained", squeeze=False)
    for axes, run in zip(panels[0], shown):
        ground = Terrain.read(run.folder)
        draw_density_section(axes, ground, 0, 0.5 * ground.spacing)
        axes.set_title(run.what, fontsize=9)
    save(figure, target, dpi=90)


def stress(runs: Runs, tables: Mapping[str, pandas.DataFrame], target: Path, names: Sequence[str], folder: str) -> None:
    """Principal stresses in the ground, of a folder of a run."""
    for run in runs.done(*names):
        draw_stress(run.folder / folder, run.what, target, dpi=80)


def prints(
    runs: Runs, tables: Mapping[str, pandas.DataFrame], target: Path, titles: Mapping[str, str], pressure: float, load: float
) -> None:
    """Contact pressures of treads on a plane, both halves, a panel for each run. titles: run -> words"""
    shown = [(run, words) for name, words in titles.items() if (run := runs.one(name))]
    if not shown:
        return
    size = (5.2 * len(shown), 4.6)
    figure, panels = plt.subplots(1, len(shown), figsize=size, squeeze=False, layout="constrained")
    for axes, (run, words) in zip(panels[0], shown):
        nodes = tyre_print(run, pressure, load)
        x, y, stress = (np.concatenate([one, one]) for one in (nodes["x"], nodes["y"], 1e-3 * nodes["p"]))
        y[len(y) // 2 :] *= -1
        points = axes.scatter(100 * y, 100 * x, c=stress, s=45, marker="s", vmin=0.0)
        axes.set(xlabel="across [cm]", ylabel="along the travel [cm]", aspect="equal", xlim=(-10, 10), ylim=(-12, 12))
        axes.set_title(f"{words}: {stress.min():.0f} to {stress.max():.0f} kPa")
        figure.colorbar(points, ax=axes, label="contact pressure [kPa]", shrink=0.8)
    save(figure, target, dpi=90)


def sweep_of(runs: Runs, stages: Mapping[str, str]) -> Figure:
    """Pull, torque and hub drop over the slip, a line for each stage. stages: stage -> words

    @raises ResultsError for a run that cannot be read
    """
    lines = []
    for stage, words in stages.items():
        done = runs.done(stage)
        if not done:
            continue
        series = read_series(done[0].folder.parent, words, {})
        if series.unread:
            raise ResultsError(series.unread[0].text)
        points = sorted(series.points, key=lambda point: point.quantities[SLIP].mean)
        lines.append(Line(words, tuple(points), tuple(p.quantities[SLIP].mean for p in points)))
    names = {PULL: "pull–slip", TORQUE: "torque–slip", HUB_DROP: "hub drop–slip"}
    return Figure(CONDITIONS[SLIP], tuple(Curve(name, axis) for axis, name in names.items()), tuple(lines))


def sweep(runs: Runs, tables: Mapping[str, pandas.DataFrame], target: Path, stages: Mapping[str, str]) -> None:
    figure = sweep_of(runs, stages)
    if figure.lines:
        draw_sweep(figure, [], [], target)


DRAWINGS: Mapping[str, Callable[..., None]] = {
    "sections": sections, "density_sections": density_sections, "stress": stress, "prints": prints, "sweep": sweep,
}  # fmt: skip
