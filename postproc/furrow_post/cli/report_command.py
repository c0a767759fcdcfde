# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post report: one self-contained page on runs, and the same numbers as CSV and HDF5."""

import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from ..uncertainty import cost_table
from ..analyse.comparison import Comparison, parts_cell, write_comparison
from ..errors import ResultsError
from ..figures.comparison_figure import draw_comparison
from ..figures.cost_figure import draw_cost
from ..figures.histories import draw_histories
from ..figures.page import (
    all_condition_rows,
    escaped,
    render,
    results_tables,
    run_values,
    verdict_values,
)
from ..figures.resistance_parts import CAPTION as PARTS_CAPTION, Panel, draw_parts
from ..figures.view import view_section, view_style
from ..read.motion import read_motion
from ..run.summary import ResistanceParts, Summary
from ..read.wheel_run import WheelRun
from .comparing import compared, comparison_parameters
from .parameters import Given, command, prepare_page, target_option

NO_FRAMES = "No run wrote frames ('vtk N' in its lines of histories)."
MOST_IN_3D = 2  # runs that stand side by side


@command(
    *comparison_parameters(),
    target_option("page to write (default: report.html in or beside the results)"),
)
def report(given: Given) -> None:
    result = compared(given)
    runs = result.runs
    folder = runs[0].folder if len(runs) == 1 else runs[0].folder.resolve().parent
    target: Path = given.output or folder / "report.html"
    prepare_page(target, "a report")
    with tempfile.TemporaryDirectory() as scratch:
        numbers = Path(scratch) / "numbers"
        write_comparison(result, numbers)
        text = _page_text(result, given.errors, Path(scratch), target)
        target.write_text(text, encoding="utf-8")
        for ending in (".csv", ".h5"):
            shutil.copyfile(numbers / f"compare{ending}", target.with_suffix(ending))
    print(f"{target}, {target.with_suffix('.csv').name}, {target.with_suffix('.h5').name}")


def _page_text(result: Comparison, errors: Path | None, scratch: Path, target: Path) -> str:
    """errors: table of runs of the scene, or None; scratch: folder for figures."""
    runs = result.runs
    first = runs[0]
    draw_comparison(result, scratch / "compare.png")
    cost = scratch / "cost.png" if errors else None
    if errors:
        draw_cost(cost_table.read_table(errors)[0], scratch / "cost.png")
    shown = []
    for number, one in enumerate(runs):
        histories = scratch / f"histories_{number}.png"
        draw_histories(one.results, histories)
        shown.append(run_values(one, histories))
    size = f"{first.text('wheel_diameter')} x {first.text('wheel_width')}"
    return render(
        "report.html",
        first.results.title if len(runs) == 1 else " and ".join(run.label for run in runs),
        f"{first.wheel} {size}, load {first.text('load')}, {first.text('speed')}",
        style=view_style(),
        view=Markup(_in_3d(result)),
        quantities=results_tables(result),
        tracks=[[e.label, e.text(), parts_cell(e)] for e in result.tracks.values()],
        comparison=scratch / "compare.png",
        parts=_draw_parts(runs, scratch / "parts.png"),
        parts_caption=PARTS_CAPTION,
        labels=[run.label for run in runs],
        conditions=all_condition_rows(runs),
        runs=shown,
        version=first.results.run.get("version", ""),
        numbers=[target.with_suffix(ending).name for ending in (".csv", ".h5")],
        **verdict_values(result),
        cost=cost,
    )


def _draw_parts(runs: Sequence[WheelRun], picture: Path) -> Path | None:
    """The stacked picture of the resistance's parts; None where no run has them."""
    bars: list[tuple[str, ResistanceParts]] = []
    for run in runs:
        summary = Summary(run.folder)
        passes = summary.parts_of_passes
        named = [(f"{run.label}\npass {k}", parts) for k, parts in enumerate(passes, 1)]
        bars += [(name, p) for name, p in named or [(run.label, summary.parts)] if p is not None]
    if not bars:
        return None
    draw_parts([Panel("resistance", bars)], picture)
    return picture


def _in_3d(result: Comparison) -> str:
    """HTML of the first runs that wrote frames, at most two, or why there are none."""
    try:
        motions = [(read_motion(run.folder), run.label) for run in result.runs]
        moving = [one for one in motions if one[0].has_frames][:MOST_IN_3D]
        if not moving:
            return f"<p>{escaped(NO_FRAMES)}</p>"
        shown, labels = zip(*moving)
        return view_section(shown, labels)
    except ResultsError as error:  # the numbers of a report stand without it
        return f"<p>{escaped(error)}</p>"
