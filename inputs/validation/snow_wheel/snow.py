# SPDX-License-Identifier: GPL-2.0-or-later
"""The field's snow: one compaction curve for every initial density."""

import math

# Final densities [kg/m3] under wheels of such pressures [Pa], as the sinkage formula of [CRREL95-7]
# takes them, which was fitted to tests: its classes of pressure, and middles of their densities
FINAL_DENSITIES = {525.0: 210e3, 575.0: 350e3, 625.0: 700e3, 660.0: 1400e3}
IDENTIFIED_DENSITIES = (380.0, 450.0, 490.0)  # [kg/m3] of the beginning, which is searched
START = (100.0, 15.0)  # [kg/m3], [Pa]: below the lightest snow of the rows, hardly any strength
# Slopes M of Cam clay
CRUSHED = 3.3  # K0 = 0.12 [Shoop2001] eq 24
FLOWING = 2.0  # K0 = 0.41: round; slope.py finds 1.84 (1.73 to 1.98) on all rows of 220 kg/m3
SOFTEST = 1.4  # K0 = 0.61: beyond what it finds
SPREADING = 1.1  # K0 = 0.72: with sinkages read as depths of ruts
TENSION_RATIO = 0.1  # of fresh_snow_cam_clay.yaml

# Axial stresses [Pa] at the first of IDENTIFIED_DENSITIES; from the last of them on straight in ln p
Beginning = tuple[float, ...]

# Rounded from what identify.py found; inputs/materials/field_snow.yaml
FIELD_SNOW: Beginning = (4e3, 25e3, 100e3)
TWO_STRESSES: Beginning = FIELD_SNOW[:2]  # without the one that the tests determine least


def confined(slope: float) -> tuple[float, float]:
    """K0, and p0 over axial stress, in confined compression: closed form of
    cohesive_cam_clay.h."""
    beta = TENSION_RATIO
    ratio = slope / math.sqrt(1 + 2 * beta)
    root = math.sqrt(9 + 4 * ratio**2)
    centre, half = (1 - beta) / 2, (1 + beta) / 2  # of the ellipse, over p0
    p, q = centre + 3 * half / root, 2 * ratio**2 * half / root
    axial = p + 2 * q / 3
    return (p - q / 3) / axial, round(1 / axial, 3)


def field_snow(
    density: float, beginning: Beginning = FIELD_SNOW, title: str = "", slope: float = CRUSHED
) -> str:
    """A material file; density [kg/m3] at the start; slope: M."""
    _, share = confined(slope)
    rows = [START]
    curve = {**dict(zip(IDENTIFIED_DENSITIES, beginning)), **FINAL_DENSITIES}
    rows += [(rho, share * stress) for rho, stress in curve.items()]
    return (
        f"title: {title or 'Field snow'}\n"
        f"law: {{type: cohesive_cam_clay, density: {density:g}, M: {slope:g}, "
        f"tension_ratio: {TENSION_RATIO:g}}}\n"
        "elasticity: {type: linear, E: 13.79e6, nu: 0.3}\n"
        "hardening:\n"
        "  type: by_density\n"
        f"  rho: [{', '.join(f'{rho:g}' for rho, _ in rows)}]\n"
        f"  p: [{', '.join(f'{p:.6g}' for _, p in rows)}]\n"
        "  interpolation: log\n"
        "  beyond: extrapolate\n"
    )
