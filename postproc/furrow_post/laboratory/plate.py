# SPDX-License-Identifier: GPL-2.0-or-later
"""The test of a plate that is pushed into a bed."""

import math

import numpy as np

from ..uncertainty.statistics import line_fit
from ..read.laboratory import LaboratoryTest
from .quantity import LaboratoryQuantity


def plate(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Bekker's p = k z^n of one plate."""
    rows = test.curve()
    z, pressure = rows[:, 1], rows[:, 3]
    if not (z.max() > 0 and pressure.max() > 0):
        raise ValueError("the plate does not come into the ground, or carries nothing")
    size = test.number("size")
    late = (z > 0.1 * z.max()) & (pressure > 0)
    n, log_k, covariance = line_fit(np.log(z[late]), np.log(pressure[late]))
    k = math.exp(log_k)
    n_error, log_k_error = (float(e) for e in np.sqrt(np.diag(covariance)))
    at_end = f"at {z[-1] * 1e3:.1f} mm"
    quantity = LaboratoryQuantity
    return [
        quantity("bekker_n", n, n_error, "", "of p = k z^n, from 10 % of the sinkage on"),
        quantity("bekker_k", k, k * log_k_error, "Pa/m^n", f"plate of {size * 1e3:g} mm"),
        quantity("pressure_end", float(pressure[-1]), math.nan, "Pa", at_end),
    ]
