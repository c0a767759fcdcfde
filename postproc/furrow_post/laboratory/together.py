# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantities from several tests of one kind: cohesion and friction angle; Bekker's k_c and k_phi."""

import math
from collections.abc import Sequence

import numpy as np
from ..laws.fitter import fit, plain
from ..uncertainty.statistics import line_fit
from ..arrays import Floats
from ..errors import content_of
from ..read.laboratory import LaboratoryTest
from .evaluation import values_of
from .quantity import LaboratoryQuantity


def together(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """Quantities from several tests of one kind: cohesion and friction angle; Bekker's k_c and k_phi.

    Empty for a single test, or for tests of several kinds.
    """
    kinds = {test.kind for test in tests}
    if len(tests) < 2 or len(kinds) != 1:
        return []
    kind = kinds.pop()
    remedy = "lay tests of different sizes or stresses together"
    with content_of(", ".join(str(test.folder) for test in tests), remedy):
        if kind == "shear":
            return _shear_strength(tests)
        if kind == "triaxial":
            return _triaxial_strength(tests)
        if kind == "plate" and len({test.number("size") for test in tests}) > 1:
            return _bekker_of_plates(tests)
    return []


def _column(values: Sequence[dict[str, float]], name: str) -> Floats:
    return np.array([value[name] for value in values])


def _shear_strength(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """tau = c + sigma tan(phi)."""
    values = [values_of(test) for test in tests]
    quantities = []
    for what in ("peak", "residual"):
        normal, tau = _column(values, "normal_stress"), _column(values, f"{what}_shear")
        slope, cohesion, covariance = line_fit(normal, tau)
        angle = float(np.degrees(np.arctan(slope)))
        angle_error = float(np.degrees(np.sqrt(covariance[0, 0]) / (1 + slope**2)))
        cohesion_error = float(np.sqrt(covariance[1, 1]))
        fit = f"of tau = c + sigma tan(phi), {len(tests)} tests"
        quantities += [
            LaboratoryQuantity(f"friction_angle_{what}", angle, angle_error, "deg", fit),
            LaboratoryQuantity(f"cohesion_{what}", cohesion, cohesion_error, "Pa", "of that line"),
        ]
    return quantities


def _triaxial_strength(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """s1 = s3 N + 2 c sqrt(N), N = tan(45 + phi/2)^2."""
    values = [values_of(test) for test in tests]
    lateral = _column(values, "lateral_stress_end")
    quantities = []
    for what, deviator in (("peak", "peak_deviator"), ("end", "deviator_end")):
        slope, intercept, covariance = line_fit(lateral, lateral + _column(values, deviator))
        root = math.sqrt(slope)
        angle = float(np.degrees(2 * np.arctan(root) - np.pi / 2))
        angle_error = float(np.degrees(np.sqrt(covariance[0, 0]) / (root * (1 + slope))))
        cohesion_error = float(np.sqrt(covariance[1, 1]) / (2 * root))
        fit = f"of s1 = s3 N + 2 c sqrt(N), {len(tests)} tests"
        cohesion = intercept / (2 * root)
        quantities += [
            LaboratoryQuantity(f"friction_angle_{what}", angle, angle_error, "deg", fit),
            LaboratoryQuantity(f"cohesion_{what}", cohesion, cohesion_error, "Pa", "of that line"),
        ]
    return quantities


def _bekker_of_plates(tests: Sequence[LaboratoryTest]) -> list[LaboratoryQuantity]:
    """Bekker: p = (k_c/b + k_phi) z^n with one n; b is the radius of a round plate."""
    curves = [(test.number("size") / 2, test.curve()) for test in tests]
    b = np.concatenate([np.full(len(rows), radius) for radius, rows in curves])
    z = np.concatenate([rows[:, 1] for _, rows in curves])
    p = np.concatenate([rows[:, 3] for _, rows in curves])
    use = (z > 0.1 * z.max()) & (p > 0)
    b, z, p = b[use], z[use], p[use]

    def log_ratio(q: Floats) -> Floats:
        """Logarithm of the ratio of the model to the pressure; q: k_c, k_phi, n."""
        model = (q[0] / b + q[1]) * z ** q[2]
        ratio: Floats = np.log(np.maximum(model, 1e-9) / p)
        return ratio

    size = float(np.median(p / z))
    scaled = plain((0.0, 1.0, 1.0), (-np.inf,) * 3, (np.inf,) * 3)
    scale = np.array((size * 0.01, size, 1.0))
    found = fit(scaled, lambda q: log_ratio(scale * q), known=False)
    names = (("bekker_kc", "N/m^(n+1)"), ("bekker_kphi", "N/m^(n+2)"), ("bekker_n", ""))
    meaning = f"of p = (kc/b + kphi) z^n, {len(tests)} plates"
    return [
        LaboratoryQuantity(name, float(value), float(error), unit, meaning)
        for (name, unit), value, error in zip(names, scale * found.values, scale * [one.deviation for one in found.parameters])
    ]
