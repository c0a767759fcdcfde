# SPDX-License-Identifier: GPL-2.0-or-later
"""The test of a sheared layer: strength, and the displacement and shear strain that it takes."""

import math

import numpy as np
from ..laws.fitter import Parameter, fit
from ..uncertainty.statistics import block_mean
from ..arrays import Floats
from ..read.laboratory import LaboratoryTest, cell_curve
from .quantity import LaboratoryQuantity, around_peak, degrees

REACHED = 0.95  # of the peak: a strength that is then kept, or grows slowly, has been reached there


def shear(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    rows = test.curve()
    _, stress, density = cell_curve(rows)
    travel, tau, normal = rows[:, 8], rows[:, 9], stress[:, 2]
    peak, window, largest = around_peak(tau)
    first = max(peak - window // 2, 0)
    around, end = slice(first, first + window), travel > 0.6 * travel[-1]
    angle = np.arctan2(tau, normal)
    rise = slice(0, peak + 1)
    start = (float(largest), float(max(travel[peak] / 3, 1e-6)))
    janosi = [Parameter("tau_max", "Pa", start[0], 0.0, np.inf), Parameter("K", "m", start[1], 1e-9, np.inf)]
    top, length = fit(janosi, lambda x: _janosi(travel[rise], *x) - tau[rise], known=False).parameters
    reached = float(travel[np.argmax(tau > REACHED * largest)])
    gap = test.numbers.get("gap", math.nan)  # of results before there was one: none
    quantity = LaboratoryQuantity
    at_travel = f"at a displacement of {travel[peak] * 1e3:.2f} mm"
    fitted = "of tau_max (1 - exp(-j/K)), fitted up to the peak"
    return [
        quantity("initial_density", density[0], 0.0, "kg/m3", "after consolidation"),
        quantity("normal_stress", *block_mean(normal), "Pa", "mean of the test"),
        quantity("peak_shear", *block_mean(tau[around]), "Pa", at_travel),
        quantity(
            "strain_at_peak",
            reached / gap,
            math.nan,
            "",
            f"displacement over gap where {REACHED:.0%} of the peak are first borne",
        ),
        quantity("residual_shear", *block_mean(tau[end]), "Pa", "over the last 40 % of the travel"),
        quantity(
            "friction_angle_peak",
            *degrees(angle[around]),
            "deg",
            "without cohesion: tan = tau/sigma",
        ),
        quantity("friction_angle_end", *degrees(angle[end]), "deg", "the same, residual"),
        quantity("janosi_K", length.value, length.deviation, "m", fitted),
        quantity("janosi_tau_max", top.value, top.deviation, "Pa", "of that fit"),
    ]


def _janosi(travel: Floats, top: float, length: float) -> Floats:
    """tau = tau_max (1 - exp(-j/K)) of Z. Janosi and B. Hanamoto (1961)."""
    tau: Floats = top * (1 - np.exp(-travel / length))
    return tau
