#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A Drucker-Prager cap law for the continuum from the same tests that describe the grains: triaxial
compression, extension and plane strain, and an oedometer.

Friction: the ends of the tests. Tests of all three kinds give a smooth cone. With triaxial compression alone
the cone is round (K = 1) and meets that of the grains in one kind of strain only (--match). E and nu: first
part of the triaxial test nearest to --stress, with a deviator of 2 to 10 % of the lateral stress. R: from the
earth pressure at rest, K0; 0.02 where the cone does not let the cap have it. Hardening: the oedometer's
compression without its elastic part.
"""

import sys
import textwrap
from collections.abc import Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

import furrow_post  # first: reports which of the next ones are missing

import numpy as np

from cap import LEVELS, MATCH, Law, cap_stress, eccentricity, elasticity, hardening, shear_of, test_of, warn_of_short_tests
from cone import KINDS

from furrow_post.arguments import between, path, positive
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command, option
from furrow_post.errors import ResultsError, content_of
from furrow_post.laboratory.evaluation import values_of
from furrow_post.read.laboratory import LaboratoryTest
from furrow_post.soil.material import NewMaterial, Parameter


def law_of(given: Given, tests: Sequence[LaboratoryTest], confined: LaboratoryTest) -> NewMaterial:
    """Law identified from tests. @raises ResultsError"""
    shear = shear_of(tests, MATCH[given.match])
    compressed = [test for test in tests if test.kind == "triaxial"]
    stress: float = given.stress
    E, nu = elasticity(min(compressed, key=lambda test: abs(test.number("confinement") - stress)))
    K0 = values_of(confined)["K0"]
    law = Law(shear.tangent, given.cohesion, eccentricity(K0, shear.tangent), E, nu)
    rows, density = hardening(confined, law)
    on_cap = float(cap_stress(1.0, law.R, law.tangent, 0.0).K0)
    confinements = ", ".join(f"{test.number('confinement') / 1e3:g}" for test in compressed)
    kinds = ", ".join(name for kind, name in KINDS.items() if any(test.kind == kind for test in tests))
    head = (
        f"Written by inputs/laboratory/identify.py from tests on the grains of inputs/laboratory/grounds/{confined.facts['ground']}.lig: "
        f"{kinds} at {confinements} kPa, and an oedometer (K0 {K0:.2f}). It is the law of these grains, whose contacts are softer "
        f"than a sand's: so is its modulus, taken at {stress / 1e3:g} kPa.",
        *(f"{sentence}." for sentence in shear.found),
    )
    parameters = {
        "density": Parameter(f"{density:.0f}", "at the start of the oedometer"),
        "d": Parameter(law.d, "not measured (the grains do not stick): keeps a free surface together"),
        "beta": Parameter(f"{np.degrees(np.arctan(law.tangent)):.1f}", shear.what),
        "R": Parameter(f"{law.R:.3f}", f"K0 {on_cap:.2f} in confined compression"),
        **{name: Parameter(value, "section of the cone") for name, value in shear.section.items()},
    }
    return NewMaterial(
        given.title,
        tuple(line for sentence in head for line in textwrap.wrap(sentence, 98)),
        parameters,
        {"E": Parameter(f"{E:.3g}", "of the triaxial test"), "nu": Parameter(f"{nu:.2f}", "of the triaxial test")},
        tuple(float(f"{p:.4g}") for p, _ in rows),
        tuple(float(f"{strain:.4g}") for _, strain in rows),
        Parameter("table", f"oedometer, {', '.join(f'{level / 1e3:g}' for level in LEVELS)} kPa of axial stress above its start"),
    )


@command(
    argument("tests", "results folders: triaxial, extension, plane_strain", path, nargs=-1, required=True),
    option("--oedometer", required=True, parse=path, help="results folder"),
    option("--match", choices=sorted(MATCH), default="plane_strain", show_default=True, help="strain in which a round cone matches"),
    option("--title", default="Dry sand, identified on grains", show_default=True, help="of the material"),
    option("--stress", parse=positive, default=1e5, show_default=True, help="Pa"),
    option("--cohesion", parse=between(0.0, 1e9), default=100.0, show_default=True, help="d, Pa"),
    option("-o", "--output", required=True, parse=path, metavar="MATERIAL.yaml", help="file to write"),
    description=__doc__ or "",
)
def identify(given: Given) -> None:
    tests = [test_of(tuple(KINDS), folder) for folder in given.tests]
    if not any(test.kind == "triaxial" for test in tests):
        raise ResultsError("E and nu are those of triaxial compression; name a test 'triaxial'")
    confined = test_of(("oedometer",), given.oedometer)
    with content_of(", ".join(str(test.folder) for test in (*tests, confined)), "lay other tests of this ground together"):
        warn_of_short_tests(tests)
        text = law_of(given, tests, confined).text()
    given.output.write_text(text, encoding="utf-8")
    print(text)


def main() -> int:
    return start(identify, "laboratory/identify.py")


if __name__ == "__main__":
    sys.exit(main())
