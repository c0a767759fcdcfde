#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A Drucker-Prager cap law for the continuum from the same tests that describe the grains: triaxial compression and an oedometer.

  inputs/laboratory/identify TRIAXIAL_FOLDER... --oedometer FOLDER -o MATERIAL.yaml [--match plane_strain|triaxial] [--title TEXT] [--stress Pa] [--cohesion Pa]

Friction: mean friction angle at the ends of the triaxial tests. The law's cone is round (K = 1), Mohr-Coulomb's is not, so that they can meet in one kind of
strain only: plane strain without dilation, tan(beta) = sqrt(3) sin(phi), as under a wheel (default), or triaxial compression,
tan(beta) = 6 sin(phi)/(3 - sin(phi)). d is given (--cohesion). E and nu: first part of the triaxial test nearest to --stress (deviator 2 to 10 % of the
lateral stress). R: from the earth pressure at rest, K0; where the cone does not let the cap have it, 0.02, nearly a vertical cap, which comes nearest.
Hardening: the oedometer's compression without its elastic part, at p_b of the closed form

  q = y Q,  p = pa + 1.5 R^2 y Q,  Q = d + pa tan(beta),  y = 1/sqrt(1 + 2.25 R^2),  p_b = pa + R Q

of a cap whose flow has no lateral strain.
"""
import argparse, pathlib, sys

import numpy as np

project = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(project / "postproc"))

from furrow_post.laboratory import Test, cell_curve, oedometer, triaxial
from furrow_post.results import ResultsError

SMALLEST = 0.02                                           # R
LEVELS = (2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 3e5)         # Pa, axial stresses of the hardening table


def friction(tests):
    """sin(phi) at the ends of the tests, without cohesion: the mean, and each."""
    each = np.sin(np.radians([next(q.value for q in triaxial(test) if q.name == "friction_angle_end") for test in tests]))
    return float(each.mean()), each


MATCH = {"plane_strain": (lambda sine: np.sqrt(3.0) * sine, "plane strain without dilation: tan(beta) = sqrt(3) sin(phi)"),
         "triaxial": (lambda sine: 6 * sine / (3 - sine), "triaxial compression: tan(beta) = 6 sin(phi)/(3 - sin(phi))")}


def elasticity(test):
    """E [Pa] and nu of the first part of a triaxial test."""
    strain, stress, _ = cell_curve(test.curve())
    lateral = 0.5 * (stress[:, 0] + stress[:, 1])
    q = stress[:, 2] - lateral
    first = slice(0, int(np.argmax(q > 0.1 * lateral)))
    use = q[first] > 0.02 * lateral[first]
    if use.sum() < 4:
        raise ResultsError(f"{test.folder}: has fewer than four rows with a deviator of 2 to 10 % of the lateral stress")
    axial, volume = strain[first, 2][use], strain[first].sum(axis=1)[use]
    return float(np.polyfit(axial, q[first][use], 1)[0]), float(0.5 * (1 - np.polyfit(axial, volume, 1)[0]))


def stresses(pa, R, tangent, d):
    """p, q and p_b on the cap where its flow has no lateral strain."""
    y, Q = 1 / np.sqrt(1 + 2.25 * R**2), d + pa * tangent
    return pa + 1.5 * R**2 * y * Q, y * Q, pa + R * Q


def eccentricity(K0, tangent):
    """R at which the closed form has this K0 (d = 0); the smallest where K0 is lower than any."""
    R = np.linspace(SMALLEST, 3.0, 6000)
    p, q, _ = stresses(1.0, R, tangent, 0.0)
    found = (p - q / 3) / (p + 2 * q / 3)
    if K0 > found.max():
        raise ResultsError(f"K0 = {K0:.2f} is not reached on this cap, which has {found.min():.2f} to {found.max():.2f}")
    return float(np.interp(K0, found, R))


def hardening(test, R, tangent, d, E, nu):
    """Rows (p_b, eps_vol_pl) and the density at the start."""
    strain, stress, density = cell_curve(test.curve())
    axial = np.maximum.accumulate(np.maximum(stress[:, 2], 1.0))
    end = int(np.argmax(stress[:, 2])) + 1
    bulk = E / (3 * (1 - 2 * nu))
    unit = [float(v) for v in stresses(1.0, R, tangent, 0.0)]
    rows, last = [], 0.0
    first = axial[0]
    for level in LEVELS:
        if not 1.5 * first < level <= axial[end - 1]:
            continue
        total = float(np.interp(np.log(level), np.log(axial[:end]), np.log(density[:end] / density[0])))
        pa = (level - d) / (unit[0] + 2 * unit[1] / 3)
        # Plastic compression grows with stress; where the one modulus takes more than there was, by a thousandth
        last = max(total - (level - first) / (unit[0] + 2 * unit[1] / 3) * unit[0] / bulk, last + 1e-3)
        rows.append((float(stresses(pa, R, tangent, d)[2]), last))
    pa = (first - d) / (unit[0] + 2 * unit[1] / 3)
    return [(float(stresses(max(pa, 1.0), R, tangent, d)[2]), 0.0)] + rows, float(density[0])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("triaxial", nargs="+", type=pathlib.Path)
    parser.add_argument("--oedometer", required=True, type=pathlib.Path)
    parser.add_argument("--match", choices=sorted(MATCH), default="plane_strain")
    parser.add_argument("--title", default="Dry sand, identified on grains")
    parser.add_argument("--stress", type=float, default=1e5)
    parser.add_argument("--cohesion", type=float, default=100.0)
    parser.add_argument("-o", "--output", required=True, type=pathlib.Path)
    arguments = parser.parse_args()
    tests, confined, d = [Test(folder) for folder in arguments.triaxial], Test(arguments.oedometer), arguments.cohesion
    sine, each = friction(tests)
    match, words = MATCH[arguments.match]
    tangent = float(match(sine))
    E, nu = elasticity(min(tests, key=lambda t: abs(t.number("confinement") - arguments.stress)))
    K0 = next(q.value for q in oedometer(confined) if q.name == "K0")
    R = eccentricity(K0, tangent)
    p, q, _ = stresses(1.0, R, tangent, 0.0)
    rows, density = hardening(confined, R, tangent, d, E, nu)
    ground, sizes = confined.facts["ground"], ", ".join(f"{t.number('confinement') / 1e3:g}" for t in tests)
    text = f"""title: {arguments.title}
# Written by inputs/laboratory/identify from tests on the grains of inputs/laboratory/grounds/{ground}.lig: triaxial compression at {sizes} kPa
# (friction angle {np.degrees(np.arcsin(sine)):.1f}, single tests {', '.join(f'{np.degrees(np.arcsin(t)):.1f}' for t in each)} degrees) and an oedometer (K0 {K0:.2f}).
# It is the law of these grains, whose contacts are softer than a sand's: so is its modulus, taken at {arguments.stress / 1e3:g} kPa.
law:
  type: drucker_prager_cap
  density: {density:.0f}        # at the start of the oedometer
  d: {d:g}               # not measured (the grains do not stick): keeps a free surface together
  beta: {np.degrees(np.arctan(tangent)):.1f}           # {words}
  R: {R:.3f}             # K0 {(p - q / 3) / (p + 2 * q / 3):.2f} in confined compression
  alpha: 0
  K: 1
  eps_vol_pl_0: 0
elasticity:
  type: linear
  E: {E:.3g}
  nu: {nu:.2f}
hardening:
  type: table          # oedometer, {', '.join(f'{v / 1e3:g}' for v in LEVELS)} kPa of axial stress, as far as they lie above its start
  p:          [{', '.join(f'{p:.4g}' for p, _ in rows)}]
  eps_vol_pl: [{', '.join(f'{e:.4g}' for _, e in rows)}]
  interpolation: linear
  beyond: extrapolate
"""
    arguments.output.write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    try:
        main()
    except ResultsError as error:
        sys.exit(f"inputs/laboratory/identify: {error}")
