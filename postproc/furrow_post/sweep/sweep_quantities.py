# SPDX-License-Identifier: GPL-2.0-or-later
"""Values of a point of a sweep: the steady values of its run and what follows from them.

torque coefficient = T/(W r), net traction coefficient = P/W, tractive efficiency = P v/(T omega), with
the drawbar pull P, the torque T, the vertical force W, the radius r of the undeformed wheel, and the
means v of the speed along x and omega of the spin. Errors of ratios take both parts as independent,
which is too much where both rise and fall together. The efficiency is that of a wheel that pulls: P
and T above 0.

Several packings of one point are averaged. Their variance is that of the time averages and that
of the packing; the packing's part is what the time averages leave of it.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..uncertainty.budget import Budget
from ..uncertainty.whole_error import Families, RunErrors
from ..run.summary import Summary
from ..read.wheel_run import WheelRun


@dataclass(frozen=True)
class Value:
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


def quantities(runs: Sequence[WheelRun], families: Families) -> dict[str, Value]:
    """Name -> value of a point; runs: its packings. families: of a table of errors, may be empty"""
    each = [_of_run(run, families) for run in runs]
    names = [name for name in each[0] if all(name in one for one in each)]
    return {name: _averaged([one[name] for one in each]) for name in names}


def _of_run(run: WheelRun, families: Families) -> dict[str, Value]:
    summary = Summary(run.folder)
    steady = {name: run.values.get(name) or summary.quantity(name) for name in summary.quantities}
    errors = RunErrors(run, families).all()
    found = {name: Value(v.mean, v.unit, errors[name], v.steady, v.imposed) for name, v in steady.items() if v}
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


def _ratio(above: Value, below: Value, factor: float = 1.0) -> Value:
    if not below.mean:
        return Value(math.nan, "", Budget(), False)
    ratio = factor * above.mean / below.mean
    error = math.hypot(
        factor * above.parts.time / below.mean, ratio * below.parts.time / below.mean
    )
    parts = Budget(time=error, packing=above.parts.packing)
    return Value(ratio, "", parts, above.steady and below.steady)


def _averaged(values: Sequence[Value]) -> Value:
    """Over packings; the other parts are those of each."""
    first, number = values[0], len(values)
    if number == 1:
        return first
    means = np.array([value.mean for value in values])
    time = math.sqrt(sum(value.parts.time**2 for value in values)) / number
    packing = math.sqrt(max(float(np.var(means, ddof=1)) / number - time**2, 0.0))
    parts = replace(first.parts, time=time, packing=packing)
    steady = all(value.steady for value in values)
    return replace(first, mean=float(means.mean()), parts=parts, steady=steady)
