# SPDX-License-Identifier: GPL-2.0-or-later
"""The cone of the cap law, fitted to triaxial compression, extension and plane strain at once.

At one p the strength in compression is q = p tan(beta), in extension K times that, between them the
section of Matsuoka-Nakai's and Lade-Duncan's cones (src/material/section/section.h). It is that of
s1 s2 s3 = const at a mean stress p' = 2 tan(beta)/(9 w), w = (1 - K^2)/(1 + K^3), and
flow in the deviatoric plane is normal to it: in plane strain at constant volume s2 (s1 + s3) = 2 s1
s3 at that p'. Cohesion is left out: the grains do not stick, and d is given.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from furrow_post.laws.fitter import Parameter, fit
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError
from furrow_post.laboratory.evaluation import values_of
from furrow_post.read.laboratory import LaboratoryTest

KINDS = {"triaxial": "compression", "extension": "extension", "plane_strain": "plane strain"}
SMALLEST_RATIO, LARGEST_RATIO = 0.6, 0.999  # K; 1 has no p'


class PlaneStrain(NamedTuple):
    """The critical state where nothing moves along y."""

    stress_ratio: float  # q/p
    intermediate: float  # (s2 - s3)/(s1 - s3)


def plane_strain(tangent: float, K: float) -> PlaneStrain:
    """Plane strain of the law; tangent: of beta."""
    mean = 2 * tangent * (1 + K**3) / (9 * (1 - K**2))
    level = mean**3 - mean * tangent**2 / 3 + 2 * tangent**3 / 27

    def excess(m: float) -> float:
        """Excess of s1 s2 s3; m: mean of s1 and s3."""
        return m * (3 * mean - 2 * m) ** 2 - level

    m = float(brentq(excess, mean, 1.5 * mean, xtol=1e-14 * mean))
    product = m * (3 * mean - 2 * m)
    half = float(np.sqrt(max(m**2 - product, 0.0)))
    first, second, third = m + half, product / m, m - half
    deviator = np.array((first, second, third)) - mean
    return PlaneStrain(
        float(np.sqrt(1.5) * np.linalg.norm(deviator)), (second - third) / (first - third)
    )


def stress_ratio(kind: str, tangent: float, K: float) -> float:
    """q/p of the law in a kind of test."""
    if kind == "plane_strain":
        return plane_strain(tangent, K).stress_ratio
    return tangent if kind == "triaxial" else K * tangent


class Cone(NamedTuple):
    """Fit of a cone: two parameters with standard errors, and the tests."""

    tangent: float  # of beta
    tangent_error: float
    K: float
    K_error: float
    kinds: list[str]
    residuals: Floats  # ln of the law's q/p over the test's, test by test
    intermediate: float  # mean of the plane strain tests
    dilation: Floats  # volume growth per driven strain at the end, test by test

    def of(self, kind: str) -> Floats:
        return self.residuals[self._are(kind)]

    def _are(self, kind: str) -> list[bool]:
        return [each == kind for each in self.kinds]

    def sentences(self) -> list[str]:
        """Sentences on the values of the cone and on its misfit."""
        lines = [
            f"tan(beta) {self.tangent:.3f} +- {self.tangent_error:.3f}, K {self.K:.3f} +- "
            f"{self.K_error:.3f}, from {len(self.kinds)} tests",
            "q/p of the law over that of the grains, mean (and scatter of single tests): "
            + ", ".join(
                f"{name} {np.expm1(self.of(kind).mean()):+.1%} ({self.of(kind).std():.1%})"
                for kind, name in KINDS.items()
            ),
        ]
        own = plane_strain(self.tangent, self.K)
        lines.append(
            f"not fitted: the intermediate stress in plane strain, (s2 - s3)/(s1 - s3) "
            f"{own.intermediate:.2f}, of the grains {self.intermediate:.2f}"
        )
        lines.append(
            "not fitted: volume growth per driven strain at the end, law 0, grains "
            + ", ".join(
                f"{name} {self.dilation[self._are(kind)].mean():+.2f}"
                for kind, name in KINDS.items()
            )
            + "; the law's dilation has no number of its own"
        )
        return lines


def fit_cone(tests: Sequence[LaboratoryTest]) -> Cone:
    """Least squares in ln(q/p) at the ends of the tests. @raises ResultsError where a kind misses"""
    kinds = [test.kind for test in tests]
    missing = [kind for kind in KINDS if kind not in kinds]
    if missing:
        raise ResultsError(
            f"the cone's section needs tests '{', '.join(KINDS)}'; there is no {missing[0]}"
        )
    values = [values_of(test) for test in tests]
    measured = np.log([value["stress_ratio_end"] for value in values])

    def residuals(x: Floats) -> Floats:
        own = np.log([stress_ratio(kind, x[0], x[1]) for kind in kinds])
        difference: Floats = own - measured
        return difference

    cone = (Parameter("tan(beta)", "", 1.0, 0.05, 2.9), Parameter("K", "", 0.8, SMALLEST_RATIO, LARGEST_RATIO))
    found = fit(cone, residuals, known=False)
    tangent, ratio = found.parameters
    intermediate = np.mean(
        [v["intermediate_stress_ratio_end"] for v, k in zip(values, kinds) if k == "plane_strain"]
    )
    return Cone(
        tangent.value,
        tangent.deviation,
        ratio.value,
        ratio.deviation,
        kinds,
        found.residuals,
        float(intermediate),
        np.array([value["dilation_end"] for value in values]),
    )
