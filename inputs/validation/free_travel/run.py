#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Pull-slip and slope-slip curves by both kinds of rig: slip prescribed, or the axle free along x
under a drawbar load or on a slope. See README.md.

Makes the runs that are missing and writes results.csv, agreement.csv and curves.png. --check makes
four runs of some seconds: those around the slip that 150 N and their slope ask for.
"""

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

from furrow_post.analyse.statistics import rms
from furrow_post.errors import ResultsError
from furrow_post.study.case import Case
from furrow_post.study.furrow_cases import script_case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study
from furrow_post.sweep.curves import CONDITIONS, HUB_DROP, PULL, SLIP, TORQUE, Axis, Curve, Figure, Line
from furrow_post.sweep.drawing import draw_sweep
from furrow_post.sweep.series import read_series

LOAD = 3000.0  # W, of wheel.lig [N]
RADIUS = 0.37  # [m]
SPIN = 5.4  # of all wheels [rad/s]
SLIPS = (-0.12, -0.09, -0.06, -0.03, -0.015, 0.0, 0.02, 0.05, 0.1, 0.2)
PULLS = (-300.0, -150.0, 0.0, 150.0, 200.0, 250.0)  # [N]
SLOPES = (-6.0, -4.0, -2.0, 1.0, 3.0, 4.5)  # [degrees]; W sin(3 degrees) = 157 N

PRESCRIBED, DRAWBAR, SLOPE = "prescribed slip", "drawbar load", "slope"
CHECKED = {PRESCRIBED: (-0.03, 0.0), DRAWBAR: (150.0,), SLOPE: (3.0,)}  # with --check
FREE = f"travel free mode spin spin_rate {SPIN} dragged_mass 60"


def speed_of(slip: float) -> float:
    """Of the axle [m/s]: the rim is as fast as that of the free wheels."""
    rim = SPIN * RADIUS
    return rim * (1.0 - slip) if slip > 0.0 else rim / (1.0 + slip)


RIGS: dict[str, tuple[Sequence[float], Callable[[float], str]]] = {
    PRESCRIBED: (SLIPS, lambda slip: f"speed {speed_of(slip):.6g} mode slip slip {slip:g}"),
    DRAWBAR: (PULLS, lambda pull: f"{FREE} drawbar_load {pull:g}"),
    SLOPE: (SLOPES, lambda slope: f"{FREE} slope {slope:g}"),
}


def folder_of(rig: str) -> str:
    return rig.replace(" ", "_")


def case_of(rig: str, value: float) -> Case:
    drive = RIGS[rig][1](value)
    folder = folder_of(rig)
    return script_case(
        f"{folder}/{value:g}", HERE / "wheel.lig", {"drive": drive}, stage=folder, what=drive
    )


CASES = [case_of(rig, value) for rig, (values, _) in RIGS.items() for value in values]
IN_CHECK = {case_of(rig, value).name for rig, values in CHECKED.items() for value in values}


def in_check(case: Case) -> bool:
    return case.name in IN_CHECK


@dataclass(frozen=True)
class Quantity:
    """What both rigs measure at one slip."""

    axis: Axis
    column: str
    limit: float  # of the rms difference
    scale: float = 1.0  # of the limit and the tables, to the axis


QUANTITIES = (
    Quantity(PULL, "pull_over_load", 0.005),
    Quantity(TORQUE, "torque_over_load_r", 0.005),
    Quantity(HUB_DROP, "sinkage_mm", 0.5, 1e3),
)


def figure_of(folders: Mapping[str, Path]) -> Figure:
    """A line for each rig over the slip that was measured; folders: of the rigs.

    @raises ResultsError for a run that cannot be read
    """
    lines = []
    for rig, folder in folders.items():
        series = read_series(folder, rig, {})
        if series.unread:
            raise ResultsError(series.unread[0].text)
        points = sorted(series.points, key=lambda point: point.quantities[SLIP].mean)
        lines.append(Line(rig, tuple(points), tuple(p.quantities[SLIP].mean for p in points)))
    names = {PULL: "pull–slip, and slope–slip", TORQUE: "torque–slip", HUB_DROP: "hub drop–slip"}
    curves = tuple(Curve(name, axis) for axis, name in names.items())
    return Figure(CONDITIONS[SLIP], curves, tuple(lines))


def results(figure: Figure) -> list[dict[str, Any]]:
    """A row for each run."""
    rows = []
    for line in figure.lines:
        for x, point in zip(line.x, line.points):
            slip = point.quantities[SLIP]
            row: dict[str, Any] = {
                "rig": line.label,
                "run": point.name,
                "slip": round(x, 5),
                "slip_error": round(slip.parts.time, 5),
            }
            for quantity in QUANTITIES:
                value = point.quantities[quantity.axis.key]
                row[quantity.column] = round(quantity.scale * value.mean, 5)
                row[f"{quantity.column}_error"] = round(quantity.scale * value.parts.time, 5)
            row["steady"] = "yes" if point.steady and slip.steady else "no"
            row["user_s"] = round(point.cpu_time, 1)
            rows.append(row)
    return rows


def differences(free: Line, prescribed: Line, quantity: Quantity) -> list[tuple[float, float]]:
    """Of the points of a free wheel within the curve of the other rig: free less prescribed, and
    the standard error of that. The curve is a chain of straight lines."""
    found = []
    knots = prescribed.values(quantity.axis)
    for slip, point, value in free.values(quantity.axis):
        slip_error = point.quantities[SLIP].parts.time
        for (x0, _, y0), (x1, _, y1) in zip(knots, knots[1:]):
            if x0 <= slip <= x1:
                share = (slip - x0) / (x1 - x0)
                steepness = (y1.mean - y0.mean) / (x1 - x0)
                error = math.hypot(
                    (1.0 - share) * y0.parts.time,
                    share * y1.parts.time,
                    steepness * slip_error,
                    value.parts.time,
                )
                expected = (1.0 - share) * y0.mean + share * y1.mean
                found.append((quantity.scale * (value.mean - expected), quantity.scale * error))
                break
    return found


def agreement(figure: Figure) -> list[dict[str, Any]]:
    """A row for each free rig and quantity."""
    lines = {line.label: line for line in figure.lines}
    rows = []
    for rig in (DRAWBAR, SLOPE):
        for quantity in QUANTITIES:
            found = differences(lines[rig], lines[PRESCRIBED], quantity)
            rows.append(
                {
                    "rig": rig,
                    "quantity": quantity.column,
                    "points": len(found),
                    "rms_difference": round(rms([d for d, _ in found]), 5) if found else "",
                    "largest": round(max((abs(d) for d, _ in found), default=math.nan), 5),
                    "rms_error": round(rms([e for _, e in found]), 5) if found else "",
                }
            )
    return rows


def evaluate(runner: Runner, output: Output) -> list[str]:
    stages = {case.stage for case in CASES if runner.record(case)}
    if len(stages) < len(RIGS):
        return ["not every rig has a run"]
    figure = figure_of({rig: runner.results / folder_of(rig) for rig in RIGS})
    output.table("results.csv", results(figure))
    rows = agreement(figure)
    output.table("agreement.csv", rows)
    draw_sweep(figure, [], [], output.path("curves.png"))
    limits = {quantity.column: quantity.limit for quantity in QUANTITIES}
    return [
        f"{row['rig']}: {row['quantity']} differs by {row['rms_difference']} from that of the rig "
        f"with prescribed slip, limit {limits[row['quantity']]}"
        for row in rows
        if not row["points"] or row["rms_difference"] > limits[row["quantity"]]
    ]


if __name__ == "__main__":
    study = Study(Path(__file__), __doc__ or "", CASES, evaluate, checked=in_check)
    sys.exit(run_study(study))
