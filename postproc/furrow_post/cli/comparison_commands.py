# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands on several runs: compare, report, sweep, flow, compaction, cost."""

import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..analyse.comparison import Comparison, compare, comparison_report, parts_cell, uniquely_labelled, write_comparison
from ..analyse.compaction import Compaction, read_compaction, write_compaction
from ..analyse.compaction import report as compaction_report
from ..analyse.curves import compare_curves, curve_report, is_curve, read_curve, write_curves
from ..analyse.flow import compare_flows, flow_report, write_flow
from ..laws.empirical import predictions_for
from ..laws.half_space import ELASTIC, SOEHNE
from ..arguments import path, positive
from ..csv_table import in_columns
from ..errors import ResultsError
from ..figures.compaction_figure import draw_compaction
from ..figures.comparison_figure import draw_comparison
from ..figures.cost_figure import draw_cost
from ..figures.curves_figure import draw_curves
from ..figures.flow_figure import draw_flow
from ..figures.histories import draw_histories
from ..figures.page import all_condition_rows, render, results_tables, run_values, verdict_values
from ..figures.resistance_parts import CAPTION as PARTS_CAPTION, Panel, draw_parts
from ..figures.view import view_values
from ..formatting import value_text
from ..read.motion import read_motion
from ..read.results import require_different
from ..read.wheel_run import WheelRun, read_wheel_run
from ..run.summary import ResistanceParts, Summary
from ..sweep.sweep_files import Named, Wanted, evaluate, report_lines, write_sweep
from ..uncertainty import cost_table
from .comparing import beside_first, folders, folders_argument, labelled
from .parameters import (
    FORMATS,
    Decorator,
    Given,
    argument,
    command,
    flag,
    option,
    repeated,
    require_file,
    target_option,
)

NO_FRAMES = "No run wrote frames ('vtk N' in its lines of histories)."
MOST_IN_3D = 2  # runs that stand side by side
LINES = 8  # of the table of compaction on the screen
ERRORS = "table of runs of the scene (inputs/costs): errors of size, domain, packing"
FORMULA = "nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN; may be repeated"


def _references() -> list[Decorator[Any]]:
    """Options for what runs are compared with: errors of other sizes, formulas."""
    return [
        option("--errors", parse=path, help=ERRORS),
        option("--formula", parse=str, multiple=True, help=FORMULA),
        flag("--extrapolate", help="formulas outside of their range too"),
    ]


def _compared() -> list[Decorator[Any]]:
    return [
        folders_argument(),
        *_references(),
        option("--measured", parse=path, help="reference.csv with depth_m, sinkage_m, resistance, density_kgm3"),
        flag("--anyway", help="compare runs whose conditions differ"),
    ]


def comparison(given: Given) -> Comparison:
    """@raises ResultsError with every reason why the runs are not comparable"""
    runs = [read_wheel_run(*item) for item in folders(given)]
    table = cost_table.read_table(given.errors)[0] if given.errors else None
    formulas = predictions_for(runs[0], given.formula, given.extrapolate)
    return compare(runs, table, formulas, given.measured, given.anyway)


@command(*_compared(), target_option("folder to write (default: compare next to the first)"))
def compare_(given: Given) -> None:
    named = folders(given)
    target = beside_first(given, "compare")
    if len(named) < 2 and not (given.formula or given.measured):
        raise ResultsError("compare needs two results folders, or one and --formula or --measured")
    if is_curve(named[0].folder):
        curves = compare_curves([read_curve(*item) for item in named], given.anyway)
        write_curves(curves, target)
        draw_curves(curves, target / "compare.png")
        print(curve_report(curves))
    else:
        result = comparison(given)
        write_comparison(result, target)
        draw_comparison(result, target / "compare.png")
        print(comparison_report(result))
    print(f"\n{target}/compare.png, compare.txt, compare.csv, compare.h5")


@command(
    folders_argument("folder of a sweep or of runs"),
    option("--against", help="what lies on the x axis (default: the first variable of the sweep, or the one condition that differs)"),
    *_references(),
    repeated("--measured", parse=labelled, help="CSV with columns named as in sweep.csv, or LABEL=FILE; may be repeated"),
    target_option("folder to write (default: the first one)"),
)
def sweep(given: Given) -> None:
    measured = [Named(Path(file), label) for file, label in given.measured]
    wanted = Wanted(given.against, given.errors, given.formula, measured, given.extrapolate)
    named = [Named(Path(folder), label) for folder, label in folders(given)]
    result = evaluate(named, wanted)
    target: Path = given.output or Path(given.results[0].folder)
    files = write_sweep(result, target)
    print("\n".join(report_lines(result)))
    print(f"\n{target}: {', '.join(files)}")


@command(
    folders_argument(count=2),
    option("--width", parse=positive, help="standard deviation of the kernel [m] (default: the size of the coarser ground)"),
    target_option("folder to write (default: flow next to the first)"),
)
def flow(given: Given) -> None:
    runs = uniquely_labelled([read_wheel_run(*item) for item in folders(given)])
    target = beside_first(given, "flow")
    result = compare_flows(runs, given.width)
    write_flow(result, target)
    draw_flow(result, target / "flow.png")
    print(flow_report(result))
    print(f"\n{target}/flow.png, flow.csv, flow.h5")


@command(folders_argument(), target_option("folder to write (default: compaction next to the first)"))
def compaction(given: Given) -> None:
    runs = [read_compaction(*item) for item in folders(given)]
    target = beside_first(given, "compaction")
    target.mkdir(parents=True, exist_ok=True)
    write_compaction(runs, target / "compaction.csv")
    draw_compaction(runs, target / "compaction.png")
    for one in runs:
        print("\n".join([*compaction_report(one), "", *in_columns(_layers(one)), ""]))
    print(f"{target}/compaction.png, compaction.csv")


def _layers(run: Compaction) -> list[list[str]]:
    """Table of some layers; stresses in kPa."""
    layers, distance = run.layers, run.layers.distance.to_numpy()
    columns: dict[str, tuple[Any, Any, float]] = {  # values, errors, scale
        "vertical [kPa]": (layers.vertical_stress, layers.vertical_stress_error, 1e-3),
        "mean [kPa]": (layers.mean_stress, layers.mean_stress_error, 1e-3),
    }
    for factor in (ELASTIC, *SOEHNE):
        name = "Boussinesq [kPa]" if factor == ELASTIC else f"Söhne {factor:.0f} [kPa]"
        stress, error = run.contact.ellipse(distance, factor), run.contact.ellipse_error(distance, factor)
        columns[name] = (stress, error, 1e-3)
    columns["density [kg/m3]"] = (layers.density, layers.density_error, 1.0)
    rows, count = [["depth [cm]", *columns]], len(layers)
    for k in np.unique(np.linspace(0, count - 1, min(LINES, count)).round().astype(int)):
        values = [value_text(scale * mean[k], scale * error[k]) for mean, error, scale in columns.values()]
        rows.append([f"{100 * layers.depth[k]:.1f}", *values])
    return rows


@command(
    argument("results", "results folders (LABEL=FOLDER), or a table of inputs/costs", nargs=-1, required=True),
    option("--write", parse=path, help="also write the table of runs, as inputs/costs has them"),
    option("-o", "--output", parse=path, help="figure (default: cost.png)"),
)
def cost(given: Given) -> None:
    target: Path = given.output or Path("cost.png")
    require_file(target, *FORMATS)
    require_different(given.results)
    rows: list[cost_table.Row] = []
    comments: list[str] = []
    for text in given.results:
        if Path(text).suffix == ".csv":
            more, head = cost_table.read_table(Path(text))
            rows, comments = rows + more, comments + head
        else:
            rows.append(cost_table.row_of(read_wheel_run(*labelled(text))))
    if given.write:
        cost_table.write_table(given.write, rows, comments)
    print(cost_table.cost_report(rows))
    draw_cost(rows, target)
    cost_table.write_errors(target.with_suffix(".csv"), rows)
    print(f"\n{target}, {target.with_suffix('.csv')}")


@command(*_compared(), target_option("page to write (default: report.html in or beside the results)"))
def report(given: Given) -> None:
    result = comparison(given)
    runs = result.runs
    folder = runs[0].folder if len(runs) == 1 else runs[0].folder.resolve().parent
    target: Path = given.output or folder / "report.html"
    require_file(target, "html", make_folder=True)
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
        view=_in_3d(result),
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


def _in_3d(result: Comparison) -> dict[str, Any] | str:
    """Values of section.html with the first runs that wrote frames, at most two, or why there are none."""
    try:
        motions = [(read_motion(run.folder), run.label) for run in result.runs]
        moving = [one for one in motions if one[0].has_frames][:MOST_IN_3D]
        if not moving:
            return NO_FRAMES
        shown, labels = zip(*moving)
        return view_values(shown, labels)
    except ResultsError as error:  # the numbers of a report stand without it
        return str(error)
