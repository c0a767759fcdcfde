# SPDX-License-Identifier: GPL-2.0-or-later
"""Pull, torque and hub drop over slip of each rig, and how far the free rigs are from the other."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from furrow_post.analyse.statistics import rms
from furrow_post.errors import ResultsError
from furrow_post.study.output import Output
from furrow_post.study.runs import Runs
from furrow_post.sweep.curves import CONDITIONS, HUB_DROP, PULL, SLIP, TORQUE, Axis, Curve, Figure, Line
from furrow_post.sweep.drawing import draw_sweep
from furrow_post.sweep.series import read_series

PRESCRIBED, DRAWBAR, SLOPE = "prescribed slip", "drawbar load", "slope"
RIGS = {rig: rig.replace(" ", "_") for rig in (PRESCRIBED, DRAWBAR, SLOPE)}  # -> stage


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


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    if not all(runs.done(stage) for stage in RIGS.values()):
        return ["not every rig has a run"]
    folders = {rig: runs.done(stage)[0].folder.parent for rig, stage in RIGS.items()}
    figure = figure_of(folders)
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
