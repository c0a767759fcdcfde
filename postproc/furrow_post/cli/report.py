# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post report: one self-contained page on runs, and the same numbers as CSV and HDF5."""

import argparse
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from ..analyse import cost, cost_table
from ..analyse.comparison import Comparison
from ..analyse.comparison_report import write_comparison
from ..errors import ResultsError
from ..figures.comparison import draw_comparison
from ..figures.cost import draw_cost
from ..figures.histories import draw_histories
from ..figures.page import (
    conditions_table,
    footer,
    inline_picture,
    page,
    paragraph,
    results_tables,
    run_section,
)
from ..figures.resistance_parts import CAPTION as PARTS_CAPTION, Panel, draw_parts
from ..figures.view import view_section, view_style
from ..read.motion import read_motion
from ..run.summary import ResistanceParts, Summary
from ..read.wheel_run import WheelRun
from .comparison import add_comparison_arguments, compared
from .output import add_target, prepare_page

COMPARISON_CAPTION = (
    "a, b: values with two standard deviations. c to e: histories, datum of the hub drop the top of "
    "the undisturbed ground. Below: density, same scale; grains are smoothed over about one grain."
)
COST_CAPTION = "Numerical error of the runs of this scene against their cost; values against size."
MOST_IN_3D = 2  # runs that stand side by side
WANTED_ERROR = 0.1  # relative, of the section on cost


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_comparison_arguments(parser)
    add_target(parser, "page to write (default: report.html in or beside the results)")


def run(arguments: argparse.Namespace) -> None:
    result = compared(arguments)
    runs = result.runs
    folder = runs[0].folder if len(runs) == 1 else runs[0].folder.resolve().parent
    target: Path = arguments.output or folder / "report.html"
    prepare_page(target, "a report")
    with tempfile.TemporaryDirectory() as scratch:
        numbers = Path(scratch) / "numbers"
        write_comparison(result, numbers)
        text = _page_text(result, arguments.errors, Path(scratch), target)
        target.write_text(text, encoding="utf-8")
        for ending in (".csv", ".h5"):
            shutil.copyfile(numbers / f"compare{ending}", target.with_suffix(ending))
    print(f"{target}, {target.with_suffix('.csv').name}, {target.with_suffix('.h5').name}")


def _page_text(result: Comparison, errors: Path | None, scratch: Path, target: Path) -> str:
    """errors: table of runs of the scene, or None; scratch: folder for figures."""
    runs = result.runs
    first = runs[0]
    draw_comparison(result, scratch / "compare.png")
    sections = [
        "<h2>Results</h2>",
        results_tables(result),
        inline_picture(scratch / "compare.png", COMPARISON_CAPTION),
        _parts(runs, scratch / "parts.png"),
        "<h2>Conditions and discretisation</h2>",
        conditions_table(result),
    ]
    if errors:
        rows, _ = cost_table.read_table(errors)
        assessed = cost.assess(rows)
        draw_cost(assessed, WANTED_ERROR, scratch / "cost.png")
        sections.append("<h2>Error against cost</h2>")
        sections.append("".join(map(paragraph, cost.advice(assessed, WANTED_ERROR))))
        sections.append(inline_picture(scratch / "cost.png", COST_CAPTION))
    for one in runs:
        draw_histories(one.results, scratch / "histories.png")
        sections.append(run_section(one, scratch / "histories.png"))
    sections.insert(0, _in_3d(result))
    sections.append(footer(first, target))
    title = first.results.title if len(runs) == 1 else " and ".join(run.label for run in runs)
    size = f"{first.text('wheel_diameter')} x {first.text('wheel_width')}"
    lead = f"{first.wheel} {size}, load {first.text('load')}, {first.text('speed')}"
    return page(result, title, lead, sections, view_style())


def _parts(runs: Sequence[WheelRun], picture: Path) -> str:
    """The stacked picture of the resistance's parts; empty where no run has them."""
    bars: list[tuple[str, ResistanceParts]] = []
    for run in runs:
        summary = Summary(run.folder)
        passes = summary.parts_of_passes
        named = [(f"{run.label}\npass {k}", parts) for k, parts in enumerate(passes, 1)]
        bars += [(name, p) for name, p in named or [(run.label, summary.parts)] if p is not None]
    if not bars:
        return ""
    draw_parts([Panel("resistance", bars)], picture)
    return "<h2>What the resistance is made of</h2>" + inline_picture(picture, PARTS_CAPTION)


def _in_3d(result: Comparison) -> str:
    """The first runs that wrote frames, at most two, or why there are none."""
    head = "<h2>In 3D</h2>"
    try:
        motions = [(read_motion(run.folder), run.label) for run in result.runs]
        moving = [one for one in motions if one[0].has_frames][:MOST_IN_3D]
        if not moving:
            return head + paragraph("No run wrote frames ('vtk N' in its lines of histories).")
        shown, labels = zip(*moving)
        return head + view_section(shown, labels)
    except ResultsError as error:  # the numbers of a report stand without it
        return head + paragraph(str(error))
