# SPDX-License-Identifier: GPL-2.0-or-later
"""The curves of mobility by name: what lies on the axes, and the points of each line."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ..analyse.conditions import TOLERANCES, answers_of_ground
from ..arguments import is_number
from ..errors import ResultsError
from ..formatting import in_unit
from .series import Series, SweepPoint, SweepValue


@dataclass(frozen=True)
class Axis:
    """A condition or quantity on an axis; scale: from SI to the unit that people read."""

    key: str
    name: str
    unit: str = ""
    scale: float = 1.0

    @property
    def label(self) -> str:
        return self.name + in_unit(self.unit)


SLIP, SLOPE = "slip", "slope"
# Conditions of wheels that are free along x, whose slip is the answer to them
HELD_BACK_BY = (SLOPE, "drawbar_load")
CONDITIONS = {
    axis.key: axis
    for axis in (
        Axis(SLIP, "slip", "%", 100.0),
        Axis("load", "load", "kN", 1e-3),
        Axis("pressure", "inflation pressure", "kPa", 1e-3),
        Axis("depth", "depth", "cm", 100.0),
        Axis("speed", "speed", "m/s"),
        Axis("slip_angle", "slip angle", "degrees"),
        Axis("camber", "camber", "degrees"),
        Axis(SLOPE, "slope", "degrees"),
        Axis("side_slope", "side slope", "degrees"),
        Axis("density", "density", "kg/m³"),
    )
}
PULL = Axis("net_traction_coefficient", "net traction coefficient")
TORQUE = Axis("torque_coefficient", "torque / (load × radius)")
EFFICIENCY = Axis("tractive_efficiency", "tractive efficiency")
HUB_DROP = Axis("hub_drop", "hub drop", "mm", 1e3)
RESISTANCE = Axis("resistance_coefficient", "resistance coefficient")
# Axes for a wheel that does not roll straight on, where the summary has them
SIDEWAYS = (
    Axis("lateral_coefficient", "lateral force / load"),
    Axis("lateral_force", "lateral force", "N"),
    Axis("aligning_moment", "aligning moment", "N m"),
    Axis("overturning_moment", "overturning moment", "N m"),
)


@dataclass(frozen=True)
class Curve:
    """Curve with a name: a quantity over the condition."""

    name: str
    y: Axis


@dataclass(frozen=True)
class Line:
    """Points that are joined: one ground, and one value of each further variable."""

    label: str
    points: tuple[SweepPoint, ...]
    x: tuple[float, ...]  # SI

    def values(self, y: Axis) -> list[tuple[float, SweepPoint, SweepValue]]:
        """x, point and value, where there is one."""
        return [
            (x, point, point.quantities[y.key])
            for x, point in zip(self.x, self.points)
            if y.key in point.quantities and math.isfinite(point.quantities[y.key].mean)
        ]


@dataclass(frozen=True)
class Figure:
    """Drawing of a sweep: axis, curves and lines."""

    x: Axis
    curves: tuple[Curve, ...]
    lines: tuple[Line, ...]
    categories: tuple[str, ...] = ()  # words at x = 0, 1, ... where the condition is no number


def arrange(series: Sequence[Series], against: str | None = None) -> Figure:
    """The curves of all series over one condition.

    against: name of a condition or variable; None: the first variable that was swept, or the one
    condition that differs. @raises ResultsError where that leaves it open
    """
    x = against or _condition(series)
    axis = CONDITIONS.get(x, Axis(x, x.replace("_", " ")))
    positions, categories = _positions(series, x)
    lines = []
    for one in series:
        others = [name for name in one.variables or _varying(one.points) if name != x]
        if x == SLIP and _are_free(one.points):
            others = [name for name in others if name not in HELD_BACK_BY]
        others = [name for name in others if not _tells_place(one.points, name, positions)]
        groups: dict[str, list[SweepPoint]] = {}
        for point in one.points:
            groups.setdefault(_label(one, point, others, len(series)), []).append(point)
        for label, points in groups.items():
            ordered = sorted(points, key=positions)
            lines.append(Line(label, tuple(ordered), tuple(map(positions, ordered))))
    points = [point for one in series for point in one.points]
    return Figure(axis, tuple(_curves(axis, points)), tuple(lines), categories)


def _tells_place(points: Sequence[SweepPoint], name: str, positions: Callable[[SweepPoint], float]) -> bool:
    """True of a variable of words that has one value at each place of the x axis, as a motion that sets the slip."""
    pairs = {(_setting(point, name), positions(point)) for point in points}
    values, places = (set(column) for column in zip(*pairs)) if pairs else (set(), set())
    return len(pairs) == len(values) == len(places) > 1 and not any(map(is_number, values))


def _label(series: Series, point: SweepPoint, others: Sequence[str], number: int) -> str:
    """ "grains, load 200"."""
    words = [f"{name.replace('_', ' ')} {_setting(point, name)}" for name in others]
    return ", ".join(([series.label] if number > 1 or not words else []) + words)


def _setting(point: SweepPoint, name: str) -> str:
    return point.values[name] if name in point.values else f"{point.number(name):.3g}"


def _condition(series: Sequence[Series]) -> str:
    """Name of the condition on the x axis, from what was swept or differs. @raises ResultsError"""
    swept = [one.variables for one in series if one.variables]
    common = [name for name in swept[0] if all(name in names for names in swept)] if swept else []
    if common:
        return common[0]
    if swept:
        named = "; ".join(f"{one.label}: {', '.join(one.variables)}" for one in series)
        raise ResultsError(f"the sweeps have no variable in common ({named}); give --against")
    varying = _varying([point for one in series for point in one.points])
    if len(varying) != 1:
        found = f"{', '.join(varying)} differ" if varying else "no condition differs"
        raise ResultsError(
            f"{found} among these runs; give --against with one of {', '.join(CONDITIONS)}"
        )
    return varying[0]


def _varying(points: Sequence[SweepPoint]) -> list[str]:
    """Conditions in which points differ by more than runs that are compared may."""
    answers = answers_of_ground(run for point in points for run in point.runs)
    found = []
    for name in CONDITIONS:
        known = [n for n in (point.number(name) for point in points) if math.isfinite(n)]
        if len(known) > 1 and name not in answers and TOLERANCES[name].exceeded(known):
            found.append(name)
    return found


def _positions(
    series: Sequence[Series], x: str
) -> tuple[Callable[[SweepPoint], float], tuple[str, ...]]:
    """Place of each point on the x axis, and its text if it is not a number.

    A condition is that of the run; the slip is measured. @raises ResultsError
    """
    points = [point for one in series for point in one.points]
    if x in CONDITIONS and all(math.isfinite(point.number(x)) for point in points):
        return lambda point: point.number(x), ()
    lacking = [point.name for point in points if x not in point.values]
    if lacking:
        raise ResultsError(
            f"{lacking[0]}: has no {x}; --against takes a variable of the sweep, or one of "
            f"{', '.join(CONDITIONS)}"
        )
    texts = tuple(dict.fromkeys(point.values[x] for point in points))
    try:
        numbers = {text: float(text) for text in texts}
    except ValueError:
        return lambda point: float(texts.index(point.values[x])), texts
    return lambda point: numbers[point.values[x]], ()


def _are_free(points: Sequence[SweepPoint]) -> bool:
    """True where the ground answers with slip and speed in all runs."""
    return all(run.text("travel") == "free" for point in points for run in point.runs)


def _curves(x: Axis, points: Sequence[SweepPoint]) -> list[Curve]:
    def has(y: Axis) -> bool:
        values = [point.quantities[y.key].mean for point in points if y.key in point.quantities]
        return bool(np.any(np.nan_to_num(values)))

    against = f"against {x.name}"
    if x.key == SLIP:
        return [
            Curve("pull–slip", PULL),
            Curve("torque–slip", TORQUE),
            *([Curve("tractive efficiency", EFFICIENCY)] if has(EFFICIENCY) else []),
            Curve("hub drop–slip", HUB_DROP),
        ]
    if _are_free(points):
        answers = [TORQUE, *([EFFICIENCY] if has(EFFICIENCY) else []), HUB_DROP]
        return [
            Curve(f"{x.name}–slip", CONDITIONS[SLIP]),
            *(Curve(f"{axis.name.split(' /')[0]} {against}", axis) for axis in answers),
        ]
    further = [TORQUE] if has(TORQUE) else []
    if x.key in ("slip_angle", "camber", "side_slope"):
        further += [axis for axis in SIDEWAYS if has(axis)]
    return [
        Curve(f"resistance {against}", RESISTANCE),
        Curve(f"hub drop {against}", HUB_DROP),
        *(Curve(f"{axis.name.split(' /')[0]} {against}", axis) for axis in further),
    ]
