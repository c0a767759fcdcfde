# SPDX-License-Identifier: GPL-2.0-or-later
"""The points of a folder, of a sweep or of runs that were made one by one, and their values: the steady values of a run
and what follows from them.

torque coefficient = T/(W r), net traction coefficient = P/W, tractive efficiency = P v/(T omega), with
the drawbar pull P, the torque T, the vertical force W, the radius r of the undeformed wheel, and the
means v of the speed along x and omega of the spin. Errors of ratios take both parts as independent,
which is too much where both rise and fall together. The efficiency is that of a wheel that pulls: P
and T above 0.

Several packings of one point are averaged. Their variance is that of the time averages and that
of the packing; the packing's part is what the time averages leave of it.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from ..uncertainty.budget import Budget
from ..uncertainty.whole_error import Families, RunErrors
from ..errors import ResultsError
from ..run.summary import ResistanceParts, Summary
from ..read.wheel_run import WheelRun, read_wheel_run
from ..run.process import SCREEN
from ..run.record import FAILED, FINISHED, read_record
from .sweep_plan import PlannedRun, SweepPlan, read_plan

WARNED = "WARNING: run_until_steady: "


@dataclass(frozen=True)
class SweepValue:
    """One quantity of a point, SI."""

    mean: float
    unit: str
    parts: Budget
    steady: bool = True
    imposed: bool = False  # an input of the run, without an error

    @property
    def uncertainty(self) -> float:
        """Standard deviation from the parts that are known; NaN where none is."""
        return self.parts.total


def quantities(runs: Sequence[WheelRun], families: Families) -> dict[str, SweepValue]:
    """Name -> value of a point; runs: its packings. families: of a table of errors, may be empty"""
    each = [_of_run(run, families) for run in runs]
    names = [name for name in each[0] if all(name in one for one in each)]
    return {name: _averaged([one[name] for one in each]) for name in names}


def _of_run(run: WheelRun, families: Families) -> dict[str, SweepValue]:
    summary = Summary(run.folder)
    steady = {name: run.values.get(name) or summary.quantity(name) for name in summary.quantities}
    errors = RunErrors(run, families).all()
    found = {name: SweepValue(v.mean, v.unit, errors[name], v.steady, v.imposed) for name, v in steady.items() if v}
    load, pull, torque = found["force_z"], found["drawbar_pull"], found["drive_torque"]
    if "net_traction_coefficient" not in found:
        ratio = _ratio(pull, load)
        parts = replace(pull.parts.scaled(1 / load.mean), time=ratio.parts.time)
        found["net_traction_coefficient"] = replace(ratio, parts=parts)
    found["torque_coefficient"] = _ratio(torque, load, 1 / run.radius)
    if pull.mean > 0 and torque.mean > 0:
        found["tractive_efficiency"] = _ratio(pull, torque, run.rolling_radius)
    return found


def speed_over_rim(slip: float) -> float:
    """v/v_rim of a slip (v_rim - v)/max(|v_rim|, |v|) of a wheel that rolls forwards."""
    return 1 - slip if slip >= 0 else 1 / (1 + slip)


def _ratio(above: SweepValue, below: SweepValue, factor: float = 1.0) -> SweepValue:
    if not below.mean:
        return SweepValue(math.nan, "", Budget(), False)
    ratio = factor * above.mean / below.mean
    error = math.hypot(
        factor * above.parts.time / below.mean, ratio * below.parts.time / below.mean
    )
    parts = Budget(time=error, packing=above.parts.packing)
    return SweepValue(ratio, "", parts, above.steady and below.steady)


def _averaged(values: Sequence[SweepValue]) -> SweepValue:
    """Mean over packings; parts of the error besides the packings are those of one."""
    first, number = values[0], len(values)
    if number == 1:
        return first
    means = np.array([value.mean for value in values])
    time = math.sqrt(sum(value.parts.time**2 for value in values)) / number
    packing = math.sqrt(max(float(np.var(means, ddof=1)) / number - time**2, 0.0))
    parts = replace(first.parts, time=time, packing=packing)
    steady = all(value.steady for value in values)
    return replace(first, mean=float(means.mean()), parts=parts, steady=steady)


@dataclass(frozen=True)
class SweepPoint:
    """One point with all its packings."""

    name: str  # folder of its first run
    values: Mapping[str, str]  # of the variables that were set
    runs: tuple[WheelRun, ...]
    quantities: Mapping[str, SweepValue]

    @property
    def steady(self) -> bool:
        """True where hub drop and resistance are steady in all runs."""
        return all(self.quantities[name].steady for name in ("hub_drop", "resistance_coefficient"))

    @property
    def parts(self) -> ResistanceParts | None:
        """Parts of the resistance, mean of the packings; None where a run has none."""
        found = [Summary(run.folder).parts for run in self.runs]
        known = [one for one in found if one is not None]
        if len(known) < len(found):
            return None
        names = dict.fromkeys(name for one in known for name in one.forces)
        n = len(known)
        return ResistanceParts(
            sum(one.whole for one in known) / n,
            {name: sum(one.forces.get(name, 0.0) for one in known) / n for name in names},
            sum(one.unexplained for one in known) / n,
        )

    @property
    def cpu_time(self) -> float:
        """CPU time of all packings [s]."""
        return sum(run.cpu_time for run in self.runs)

    def number(self, condition: str) -> float:
        """Mean of a condition, the same in all packings but for rounding; NaN where it is not known."""
        return sum(run.number(condition) for run in self.runs) / len(self.runs)


@dataclass(frozen=True)
class Remark:
    """A run that is not among the points, and why."""

    folder: str
    text: str


@dataclass
class Series:
    """The points of one folder."""

    label: str
    variables: tuple[str, ...] = ()  # variables that were set; none for a folder without sweep.json
    points: list[SweepPoint] = field(default_factory=list)
    failures: list[Remark] = field(default_factory=list)  # runs that stopped with an error
    missing: list[str] = field(default_factory=list)  # runs that did not come to their end
    unread: list[Remark] = field(default_factory=list)  # runs that gave no steady values
    unsteady: list[Remark] = field(default_factory=list)  # remarks of run_until_steady on a run
    makers: set[tuple[str, str]] = field(default_factory=set)  # digests of program and script of the runs

    @property
    def title(self) -> str:
        """Title of the scene."""
        return self.points[0].runs[0].results.title if self.points else self.label


def read_series(folder: Path, label: str | None, families: Families) -> Series:
    """@raises ResultsError where there is no such folder, or no run in it"""
    if not folder.is_dir():
        raise ResultsError(f"{folder}: is no folder; name one of a sweep, or one of several runs")
    name = label or folder.resolve().name
    plan = read_plan(folder)
    if plan:
        return _of_plan(folder, name, plan, families)
    found = sorted(path.parent for path in folder.glob("*/history.h5"))
    if not found:
        raise ResultsError(f"{folder}: has neither sweep.json nor results folders of runs")
    series = Series(name)
    for run_folder in found:
        _add(series, run_folder.name, {}, [run_folder], families)
    return series


def _of_plan(folder: Path, label: str, plan: SweepPlan, families: Families) -> Series:
    series, script = Series(label, plan.variables), Path(plan.script).name
    groups: dict[tuple[str, ...], list[PlannedRun]] = {}
    for point in plan.points:
        groups.setdefault(tuple(point.values[name] for name in plan.variables), []).append(point)
    for points in groups.values():
        ended = []
        for name in (point.folder for point in points):
            if record := read_record(folder / name / FINISHED):
                ended.append(folder / name)
                series.makers.add((record.program, record.inputs.get(script, "")))
            elif record := read_record(folder / name / FAILED):
                series.failures.append(Remark(name, record.error))
            else:
                series.missing.append(name)
        if ended:
            _add(series, points[0].folder, points[0].values, ended, families)
    return series


def _add(
    series: Series,
    name: str,
    values: Mapping[str, str],
    folders: list[Path],
    families: Families,
) -> None:
    runs = []
    for folder in folders:
        series.unsteady += [Remark(folder.name, text) for text in _not_reached(folder)]
        try:
            runs.append(read_wheel_run(folder))
        except ResultsError as error:
            series.unread.append(Remark(folder.name, str(error)))
    if runs:
        point = SweepPoint(name, values, tuple(runs), quantities(runs, families))
        series.points.append(point)


def _not_reached(folder: Path) -> list[str]:
    """Warnings of the command run_until_steady."""
    try:
        lines = (folder / SCREEN).read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return []
    return [line.removeprefix(WARNED) for line in lines if line.startswith(WARNED)]


def uniquely_labelled(series: list[Series]) -> list[Series]:
    """Labels with a number added to equal ones."""
    labels = [one.label for one in series]
    return [
        replace(one, label=f"{one.label} ({k + 1})") if labels.count(one.label) > 1 else one
        for k, one in enumerate(series)
    ]
