# SPDX-License-Identifier: GPL-2.0-or-later
"""The cap law of the ends of triaxial tests and of an oedometer: closed forms and their inverses.

Where the cap flows without lateral strain,

  q = y Q,  p = pa + 1.5 R^2 y Q,  Q = d + pa tan(beta),  y = 1/sqrt(1 + 2.25 R^2),  p_b = pa + R Q.
"""

import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from cone import fit_cone

from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError
from furrow_post.laboratory.evaluation import values_of
from furrow_post.read.laboratory import LaboratoryTest, cell_curve

SMALLEST = 0.02  # R
CRITICAL_STRAIN = 0.1  # axial; sands shear at constant volume from 10 to 20 % on
LEVELS = (2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 3e5)  # [Pa] axial stresses of the hardening table


def test_of(kinds: Sequence[str], folder: Path) -> LaboratoryTest:
    """@raises ResultsError where the folder is that of another test"""
    test = LaboratoryTest(folder)
    if test.kind not in kinds:
        wanted = ", ".join(f"'{kind}'" for kind in kinds)
        raise ResultsError(f"{folder}: is a test '{test.kind}'; name the results of test {wanted}")
    return test


def friction(tests: Sequence[LaboratoryTest]) -> tuple[float, Floats]:
    """sin(phi) at the ends of the triaxial tests, without cohesion: the mean, and each."""
    degrees = [values_of(test)["friction_angle_end"] for test in tests]
    each = np.sin(np.radians(degrees))
    return float(each.mean()), each


class Match(NamedTuple):
    """The kind of strain in which the round cone meets Mohr-Coulomb's."""

    tangent: Callable[[float], float]  # of beta, from sin(phi)
    what: str


MATCH = {
    "plane_strain": Match(lambda sine: math.sqrt(3.0) * sine, "plane strain without dilation: tan(beta) = sqrt(3) sin(phi)"),
    "triaxial": Match(lambda sine: 6 * sine / (3 - sine), "triaxial compression: tan(beta) = 6 sin(phi)/(3 - sin(phi))"),
}


def warn_of_short_tests(tests: Sequence[LaboratoryTest]) -> None:
    """Warns of tests that end before the critical state."""
    for test in tests:
        reached = float(np.max(np.abs(cell_curve(test.curve())[0][:, 2])))
        if reached < CRITICAL_STRAIN:
            text = f"ends at {reached:.1%} of axial strain, before a critical state ({CRITICAL_STRAIN:.0%} and more)"
            print(f"warning: {test.folder} {text}: its friction is that of the way there", file=sys.stderr)


def elasticity(test: LaboratoryTest) -> tuple[float, float]:
    """E [Pa] and nu of the first part of a triaxial test. @raises ResultsError"""
    strain, stress, _ = cell_curve(test.curve())
    lateral = 0.5 * (stress[:, 0] + stress[:, 1])
    q = stress[:, 2] - lateral
    first = slice(0, int(np.argmax(q > 0.1 * lateral)))
    use = q[first] > 0.02 * lateral[first]
    if use.sum() < 4:
        raise ResultsError(
            f"{test.folder}: has fewer than four rows with a deviator of 2 to 10 % of the lateral "
            "stress"
        )
    axial, volume = strain[first, 2][use], strain[first].sum(axis=1)[use]
    E = float(np.polyfit(axial, q[first][use], 1)[0])
    return E, float(0.5 * (1 - np.polyfit(axial, volume, 1)[0]))


@dataclass(frozen=True)
class CapStress:
    """Stresses on the cap where its flow has no lateral strain [Pa]; numbers or arrays."""

    p: Floats
    q: Floats
    p_b: Floats

    @property
    def axial(self) -> Floats:
        return self.p + 2 * self.q / 3

    @property
    def K0(self) -> Floats:
        """Lateral over axial stress."""
        ratio: Floats = (self.p - self.q / 3) / self.axial
        return ratio


def cap_stress(pa: float | Floats, R: float | Floats, tangent: float, d: float) -> CapStress:
    """Stress on the cap at the evolution pressure pa [Pa]; tangent: tan(beta); d [Pa]."""
    pressure, eccentricity = np.asarray(pa, float), np.asarray(R, float)
    y, Q = 1 / np.sqrt(1 + 2.25 * eccentricity**2), d + pressure * tangent
    p = pressure + 1.5 * eccentricity**2 * y * Q
    return CapStress(p, np.asarray(y * Q), pressure + eccentricity * Q)


def eccentricity(K0: float, tangent: float) -> float:
    """R at which the closed form has this K0 (d = 0); the smallest where K0 is lower than any.

    @raises ResultsError where K0 is higher than any
    """
    R = np.linspace(SMALLEST, 3.0, 6000)
    found = cap_stress(1.0, R, tangent, 0.0).K0
    if K0 > found.max():
        raise ResultsError(
            f"K0 = {K0:.2f} is not reached on this cap, which has {found.min():.2f} to "
            f"{found.max():.2f}"
        )
    return float(np.interp(K0, found, R))


@dataclass(frozen=True)
class Law:
    """Parameters that are identified before the hardening."""

    tangent: float  # of beta
    d: float  # [Pa]
    R: float
    E: float  # [Pa]
    nu: float


def hardening(test: LaboratoryTest, law: Law) -> tuple[list[tuple[float, float]], float]:
    """Rows (p_b [Pa], eps_vol_pl) from an oedometer, and the density at the start [kg/m3]."""
    _, stress, density = cell_curve(test.curve())
    axial = np.maximum.accumulate(np.maximum(stress[:, 2], 1.0))
    end = int(np.argmax(stress[:, 2])) + 1
    bulk = law.E / (3 * (1 - 2 * law.nu))
    unit = cap_stress(1.0, law.R, law.tangent, 0.0)
    axial_per_pa, p_per_axial = float(unit.axial), float(unit.p / unit.axial)

    def p_b(pa: float) -> float:
        return float(cap_stress(pa, law.R, law.tangent, law.d).p_b)

    first, last = float(axial[0]), 0.0
    rows = [(p_b(max((first - law.d) / axial_per_pa, 1.0)), 0.0)]
    for level in LEVELS:
        if not 1.5 * first < level <= axial[end - 1]:
            continue
        compression = np.log(density[:end] / density[0])
        total = float(np.interp(np.log(level), np.log(axial[:end]), compression))
        # Plastic compression grows with stress; where the one modulus takes more than there was,
        # by a thousandth
        last = max(total - (level - first) * p_per_axial / bulk, last + 1e-3)
        rows.append((p_b((level - law.d) / axial_per_pa), last))
    return rows, float(density[0])


class Shear(NamedTuple):
    """Cone of the law, with the comments on it in the material file."""

    tangent: float  # of beta
    what: str
    section: dict[str, str]  # keys of the law
    found: list[str]


def shear_of(tests: Sequence[LaboratoryTest], match: Match) -> Shear:
    """Cone fitted to all kinds of tests, or to triaxial compression alone."""
    if any(test.kind != "triaxial" for test in tests):
        cone = fit_cone(tests)
        section = {"K": f"{cone.K:.3f}", "section": "matsuoka_nakai"}
        return Shear(cone.tangent, "q/p = tan(beta) in triaxial compression", section, cone.sentences())
    sine, each = friction(tests)
    mean, *angles = (f"{np.degrees(np.arcsin(s)):.1f}" for s in (sine, *each))
    found = [f"friction angle {mean}, single tests {', '.join(angles)} degrees"]
    return Shear(match.tangent(sine), match.what, {"K": "1"}, found)
