# SPDX-License-Identifier: GPL-2.0-or-later
"""Pressure under a plate at one sinkage, with its error from runs of other sizes, packings, boxes.

As of wheels (cost_table.py), on the logarithm of the pressure.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..read.ground_kinds import ground_kind
from ..uncertainty.budget import Budget
from .curves import Curve
from ..uncertainty.grid_convergence import grid_convergence, mean_shift, noise_of, pooled_scatter, same_size
from ..uncertainty.verdict import BEST, RUN, Entry, Quantity


def pressure_at(sinkage: float) -> Quantity:
    """Mean pressure of a plate at this sinkage [m], as verdicts are given on it."""
    millimetres = f"{1e3 * sinkage:g} mm"
    return Quantity(f"pressure_{sinkage:g}", f"pressure at {millimetres}", "kPa", 1e-3)


class PlateFamily:
    """ln p at one sinkage [m] of the curves of one test on one ground, the first being the base."""

    def __init__(self, curves: Sequence[Curve], sinkage: float) -> None:
        self.base, self.sinkage = curves[0], sinkage
        logs = ((curve, _log_at(curve, sinkage)) for curve in curves)
        self.logs = [(curve, log) for curve, log in logs if math.isfinite(log)]
        self.in_box = [(curve, log) for curve, log in self.logs if same_size(curve.box, self.base.box)]

    def noise(self, curve: Curve, log: float) -> float:
        """Relative noise of the values."""
        return float(np.interp(self.sinkage, curve.x, curve.noise)) / math.exp(log)

    def of_size(self, size: float) -> list[float]:
        """ln p of all packings of this size in the base's box."""
        return [log for curve, log in self.in_box if same_size(curve.size, size)]

    def packing(self) -> float:
        """Relative standard deviation of one packing; 0 of a lattice, NaN where there is one."""
        if not ground_kind(self.base.ground).random:
            return 0.0
        sizes: list[float] = []
        for curve, _ in self.in_box:
            if not any(same_size(curve.size, size) for size in sizes):
                sizes.append(curve.size)
        return pooled_scatter(self.of_size(size) for size in sizes)

    def domain(self) -> float:
        """Relative mean difference of wider boxes from the base's; NaN without one."""
        wider = [(curve, log) for curve, log in self.logs if not same_size(curve.box, self.base.box)]
        return mean_shift((log, self.of_size(curve.size)) for curve, log in wider)

    def entries(self, quantity: Quantity) -> list[Entry]:
        """Entries of the base, and the best estimate where there are runs of two sizes: its error has that
        of noise and packings in it. Empty where the base has no value.
        """
        log = next((log for curve, log in self.logs if curve is self.base), math.nan)
        if not math.isfinite(log):
            return []
        value, packing, domain = math.exp(log), self.packing(), self.domain()
        parts, best = Budget(self.noise(self.base, log), domain=domain, packing=packing), []
        sizes = [curve.size for curve, _ in self.in_box]
        if not all(same_size(size, self.base.size) for size in sizes):
            # errors of ln p are relative: those of a value of 1
            noise = [noise_of(1.0, self.noise(*one), packing) for one in self.in_box]
            series = grid_convergence(sizes, [log for _, log in self.in_box], noise)
            parts = replace(parts, size=series.size_error(self.base.size))
            estimate = math.exp(series.value)
            relative = Budget(0.0, series.error, domain, 0.0)
            best = [Entry(quantity, self.base.label, estimate, relative.scaled(estimate), BEST)]
        return [Entry(quantity, self.base.label, value, parts.scaled(value), RUN), *best]


def plate_entries(base: Curve, checks: Sequence[Curve], sinkage: float) -> list[Entry]:
    """A plate's pressure at this sinkage [m], and the best estimate where checks have other sizes.

    checks are curves of the same test with another size (facts cell or diameter), packing or box.
    """
    return PlateFamily([base, *checks], sinkage).entries(pressure_at(sinkage))


def _log_at(curve: Curve, sinkage: float) -> float:
    """NaN beyond the curve's ends and where it carries nothing yet."""
    y = float(np.interp(sinkage, curve.x, curve.y, left=math.nan, right=math.nan))
    return math.log(y) if y > 0 else math.nan
