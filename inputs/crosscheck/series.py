# SPDX-License-Identifier: GPL-2.0-or-later
"""Series: the base of a case with one condition changed, on both grounds.

Points are run at one coarse size, whose error is taken to be that of the base. The best estimate of
the hub drop is that of the base, times the ratio of point and base at this size. The resistance
coefficient changes its sign with slip, so their difference is added to the best estimate of the base.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from cases import BASE, SERIES, Made, Planned
from lines import OutputRow, entry_of, line_of, series_value

from furrow_post.uncertainty.budget import Budget
from furrow_post.uncertainty.cost_table import Row, row_of
from furrow_post.uncertainty.grid_convergence import same_size
from furrow_post.uncertainty.verdict import BEST, COVERAGE, HUB_DROP, QUANTITIES, RUN, Entry
from furrow_post.figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style
from furrow_post.read.wheel_run import read_wheel_run

UNITS = {"load": ("kN", 1e-3), "depth": ("m", 1.0), "speed": ("m/s", 1.0), "slip": ("", 1.0)}
BASES = {  # conditions of the bases, SI; that on snow is towed, and finds its slip
    "wheel_on_snow": {"load": 6240.0, "depth": 0.2, "speed": 2.235},
    "wheel_on_sand": {"load": 3120.0, "depth": 0.3, "speed": 1.0, "slip": 0.0},
}


def lines_of_series(
    made: Made, table: Sequence[Row], bases: Sequence[Mapping[str, str]]
) -> Iterator[OutputRow]:
    """Lines of a series at the size of its points, and best estimates if that of the base is known.

    table: runs of the base; bases: its lines
    """
    own = {
        (line["kind"], line["source"], line["quantity"]): entry_of(line)
        for line in bases
        if line["place"] == BASE
    }
    for planned in made.plans:
        if not planned.is_point or (BEST, planned.ground, HUB_DROP.key) not in own:
            continue
        row = row_of(read_wheel_run(made.folder(planned), planned.ground))
        twin = twin_of(row, table)
        for quantity in QUANTITIES:
            limit, run = (own[kind, planned.ground, quantity.key] for kind in (BEST, RUN))
            value, error = row.value(quantity.key)
            parts = Budget(time=error)
            point = Entry(quantity, planned.ground, value, parts, RUN, cpu_time=row.cpu_time)
            yield point_line(planned, point, row.size, made)
            yield point_line(planned, moved(limit, row, twin, run.parts.packing), row.size, made)


def point_line(planned: Planned, entry: Entry, size: float, made: Made) -> OutputRow:
    place = planned.role.removeprefix(SERIES)
    return line_of(planned.case, place, entry, size, made.program(planned))


def twin_of(row: Row, table: Sequence[Row]) -> Row:
    """The base's run of the same ground, size, packing and domain; of several the longest."""
    twins = [
        other
        for other in table
        if (other.family, other.seed) == (row.family, row.seed)
        and same_size(other.size, row.size)
    ]
    same = [twin for twin in twins if twin.domain.split("x")[1] == row.domain.split("x")[1]]
    return max(same, key=lambda twin: twin.cpu_time)


def moved(base: Entry, row: Row, twin: Row, packing: float) -> Entry:
    """The best estimate of the base, moved to the conditions of a point.

    Its error has those of both time averages, and of one packing: points and base share it, but
    not what it does to them.
    """
    (value, error), (own, own_error) = row.value(base.quantity.key), twin.value(base.quantity.key)
    if base.quantity == HUB_DROP:
        ratio = value / own
        parts = Budget(
            base.value * ratio * float(np.hypot(error / value, own_error / own)),
            base.parts.size * ratio,
            base.parts.domain * ratio,
            packing * ratio,
        )
        return replace(base, value=base.value * ratio, parts=parts)
    parts = replace(base.parts, time=float(np.hypot(error, own_error)), packing=packing)
    return replace(base, value=base.value + value - own, parts=parts)


def draw_series(case: str, lines: Sequence[Mapping[str, str]], target: Path) -> None:
    """Sinkage and resistance over each condition. lines: of the case"""
    use_style()
    names = [name for name in UNITS if any(series_value(line, name) is not None for line in lines)]
    figure, panels = plt.subplots(
        len(QUANTITIES),
        len(names),
        figsize=(11, 5),
        layout="constrained",
        squeeze=False,
        sharey="row",
    )
    letters = panel_letters()
    for row, quantity in zip(panels, QUANTITIES):
        for axes, name in zip(row, names):
            unit, scale = UNITS[name]
            for k, ground in enumerate(("continuum", "grains")):
                curve = curve_of(lines, (ground, BEST, quantity.key), name, BASES[case].get(name))
                if not curve:  # of a study that is not complete
                    continue
                x, entries = zip(*sorted(curve.items()))
                axes.errorbar(
                    scale * np.array(x),
                    [quantity.scale * entry.value for entry in entries],
                    [COVERAGE * quantity.scale * entry.uncertainty for entry in entries],
                    color=RUN_COLOURS[k],
                    marker="o",
                    capsize=3,
                    label=ground,
                )
            axes.set_xlabel(f"{name} [{unit}]" if unit else name)
            annotate_panel(axes, next(letters), quantity.name)
        row[0].set_ylabel(f"[{quantity.unit}]" if quantity.unit else "")
    panels[0][0].legend()
    save(figure, target)


def curve_of(
    lines: Sequence[Mapping[str, str]],
    which: tuple[str, str, str],
    name: str,
    at_base: float | None,
) -> dict[float, Entry]:
    """Points over a condition, the base among them where it has a value of it.

    which: source, kind, quantity
    """
    points = {}
    for line in lines:
        x = at_base if line["place"] == BASE else series_value(line, name)
        if x is not None and (line["source"], line["kind"], line["quantity"]) == which:
            points[x] = entry_of(line)
    return points
