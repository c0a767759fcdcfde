#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A Drucker-Prager cap law for the continuum from the same tests that describe the grains: triaxial
compression, extension and plane strain, and an oedometer.

Friction: the ends of the tests. With tests of all three kinds, a smooth cone is fitted to all of
them (cone.py). With triaxial compression alone the cone is round (K = 1), which that of grains is
not, so that they can meet in one kind of strain only: plane strain without dilation, tan(beta) =
sqrt(3) sin(phi), as under a wheel (default), or triaxial compression, tan(beta) = 6 sin(phi)/(3 -
sin(phi)) (--match). d is given (--cohesion). E and nu: first part of the triaxial
test nearest to --stress (deviator 2 to 10 % of the lateral stress). R: from the earth pressure at
rest, K0; where the cone does not let the cap have it, 0.02, nearly a vertical cap, which comes
nearest. Hardening: the oedometer's compression without its elastic part, at p_b of the closed form

  q = y Q,  p = pa + 1.5 R^2 y Q,  Q = d + pa tan(beta),  y = 1/sqrt(1 + 2.25 R^2),  p_b = pa + R Q

of a cap whose flow has no lateral strain.
"""

import argparse
import sys
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

from cone import KINDS, fit_cone

from furrow_post.arguments import between, path, positive
from furrow_post.arrays import Floats
from furrow_post.errors import ResultsError, content_of
from furrow_post.formatting import yaml_text
from furrow_post.laboratory.evaluation import values_of
from furrow_post.program import run_program
from furrow_post.read.laboratory import LaboratoryTest, cell_curve

SMALLEST = 0.02  # R
CRITICAL_STRAIN = 0.1  # axial; sands shear at constant volume from 10 to 20 % on
LEVELS = (2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 3e5)  # [Pa] axial stresses of the hardening table


def warn_of_short_tests(tests: Sequence[LaboratoryTest]) -> None:
    """Of triaxial tests whose end is not yet the critical state."""
    for test in tests:
        reached = float(np.max(np.abs(cell_curve(test.curve())[0][:, 2])))
        if reached < CRITICAL_STRAIN:
            print(
                f"warning: {test.folder} ends at {reached:.1%} of axial strain, before a critical "
                f"state ({CRITICAL_STRAIN:.0%} and more): its friction is that of the way there",
                file=sys.stderr,
            )


def friction(tests: Sequence[LaboratoryTest]) -> tuple[float, Floats]:
    """sin(phi) at the ends of the triaxial tests, without cohesion: the mean, and each."""
    degrees = [values_of(test)["friction_angle_end"] for test in tests]
    each = np.sin(np.radians(degrees))
    return float(each.mean()), each


class Match(NamedTuple):
    """The kind of strain in which the round cone meets Mohr-Coulomb's."""

    tangent: Callable[[float], float]  # of beta, from sin(phi)
    what: str


def plane_strain(sine: float) -> float:
    return float(np.sqrt(3.0) * sine)


def triaxial_compression(sine: float) -> float:
    return 6 * sine / (3 - sine)


MATCH = {
    "plane_strain": Match(
        plane_strain, "plane strain without dilation: tan(beta) = sqrt(3) sin(phi)"
    ),
    "triaxial": Match(
        triaxial_compression, "triaxial compression: tan(beta) = 6 sin(phi)/(3 - sin(phi))"
    ),
}


def elasticity(test: LaboratoryTest) -> tuple[float, float]:
    """E [Pa] and nu of the first part of a triaxial test. @raises ResultsError of too few rows"""
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
    """At the evolution pressure pa [Pa]; tangent: of beta; d [Pa]."""
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
    """What is identified before the hardening."""

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


def material_text(parsed: argparse.Namespace) -> str:
    """The material file. @raises ResultsError"""
    tests = [test_of(tuple(KINDS), folder) for folder in parsed.tests]
    if not any(test.kind == "triaxial" for test in tests):
        raise ResultsError("E and nu are those of triaxial compression; name a test 'triaxial'")
    confined = test_of(("oedometer",), parsed.oedometer)
    names = ", ".join(str(test.folder) for test in (*tests, confined))
    with content_of(names, "lay other tests of this ground together"):
        warn_of_short_tests(tests)
        return law_text(parsed, tests, confined)


def test_of(kinds: Sequence[str], folder: Path) -> LaboratoryTest:
    """@raises ResultsError where the folder is that of another test"""
    test = LaboratoryTest(folder)
    if test.kind not in kinds:
        wanted = ", ".join(f"'{kind}'" for kind in kinds)
        raise ResultsError(f"{folder}: is a test '{test.kind}'; name the results of test {wanted}")
    return test


class Shear(NamedTuple):
    """The law's cone, and what the file says of it."""

    tangent: float  # of beta
    what: str
    K: str  # lines of the keys
    found: list[str]


def shear_of(tests: Sequence[LaboratoryTest], match: Match) -> Shear:
    """From all kinds of tests, or from triaxial compression alone."""
    if any(test.kind != "triaxial" for test in tests):
        cone = fit_cone(tests)
        keys = f"{cone.K:.3f}\n  section: matsuoka_nakai"
        what = "q/p = tan(beta) in triaxial compression"
        return Shear(cone.tangent, what, keys, cone.sentences())
    sine, each = friction(tests)
    angles = ", ".join(f"{np.degrees(np.arcsin(s)):.1f}" for s in each)
    mean = f"{np.degrees(np.arcsin(sine)):.1f}"
    found = [f"friction angle {mean}, single tests {angles} degrees"]
    return Shear(match.tangent(sine), match.what, "1", found)


def law_text(
    parsed: argparse.Namespace, tests: Sequence[LaboratoryTest], confined: LaboratoryTest
) -> str:
    shear = shear_of(tests, MATCH[parsed.match])
    tangent = shear.tangent
    stress: float = parsed.stress
    compressed = [test for test in tests if test.kind == "triaxial"]
    E, nu = elasticity(min(compressed, key=lambda t: abs(t.number("confinement") - stress)))
    K0 = values_of(confined)["K0"]
    law = Law(tangent, parsed.cohesion, eccentricity(K0, tangent), E, nu)
    rows, density = hardening(confined, law)
    on_cap = float(cap_stress(1.0, law.R, tangent, 0.0).K0)
    ground = confined.facts["ground"]
    confinements = ", ".join(f"{t.number('confinement') / 1e3:g}" for t in compressed)
    kinds = ", ".join(name for kind, name in KINDS.items() if any(t.kind == kind for t in tests))
    found = "\n".join(
        textwrap.fill(f"{line}.", 100, initial_indent="# ", subsequent_indent="#   ")
        for line in shear.found
    )
    levels = ", ".join(f"{level / 1e3:g}" for level in LEVELS)
    above = f"oedometer, {levels} kPa of axial stress, as far as they lie above its start"
    return f"""title: {yaml_text(parsed.title)}
# Written by inputs/laboratory/identify.py from tests on the grains of
# inputs/laboratory/grounds/{ground}.lig: {kinds}
# at {confinements} kPa, and an oedometer (K0 {K0:.2f}). It is the law of these grains, whose
# contacts are softer than a sand's: so is its modulus, taken at {parsed.stress / 1e3:g} kPa.
{found}
law:
  type: drucker_prager_cap
  density: {density:.0f}        # at the start of the oedometer
  d: {law.d:g}               # not measured (the grains do not stick): keeps a free surface together
  beta: {np.degrees(np.arctan(tangent)):.1f}           # {shear.what}
  R: {law.R:.3f}             # K0 {on_cap:.2f} in confined compression
  alpha: 0
  K: {shear.K}
  eps_vol_pl_0: 0
elasticity:
  type: linear
  E: {E:.3g}
  nu: {nu:.2f}
hardening:
{textwrap.fill(above, 100, initial_indent="  # ", subsequent_indent="  # ")}
  type: table
  p:          [{', '.join(f'{p:.4g}' for p, _ in rows)}]
  eps_vol_pl: [{', '.join(f'{e:.4g}' for _, e in rows)}]
  interpolation: linear
  beyond: extrapolate
"""


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "tests", nargs="+", type=path, help="results folders: triaxial, extension, plane_strain"
    )
    parser.add_argument("--oedometer", required=True, type=path, help="results folder")
    parser.add_argument("--match", choices=sorted(MATCH), default="plane_strain", help="of a round cone")
    parser.add_argument("--title", default="Dry sand, identified on grains")
    parser.add_argument("--stress", type=positive, default=1e5, help="[Pa] default: 1e5")
    parser.add_argument(
        "--cohesion", type=between(0.0, 1e9), default=100.0, help="d [Pa], default: 100"
    )
    parser.add_argument("-o", "--output", required=True, type=path, metavar="MATERIAL.yaml")
    return parser.parse_args()


def main() -> None:
    arguments = parse()
    written = material_text(arguments)
    arguments.output.write_text(written, encoding="utf-8")
    print(written)


if __name__ == "__main__":
    sys.exit(run_program("laboratory/identify.py", main))
