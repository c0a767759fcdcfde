# SPDX-License-Identifier: GPL-2.0-or-later
"""Virtual oedometer on a material point."""

from pathlib import Path

import numpy as np

from ..laws.point_curves import PointPaths
from ..uncertainty.statistics import rms
from ..arrays import Floats
from .oedometer import Confined


def confined_strain(material: Path, stresses: tuple[float, ...]) -> Floats:
    """Strain (a ratio) at these axial stresses [Pa]. @raises ResultsError where furrow-point stops"""
    path = f"{{type: confined, stress: {list(stresses)}, steps: 40}}"
    with PointPaths() as paths:
        columns = paths(material, path)
    strain: Floats = np.interp(
        stresses, columns["axial_stress"], -np.expm1(-columns["axial_strain"])
    )
    return strain


def oedometer_misfit(material: Path, oedometer: Confined) -> float:
    """rms of virtual less measured strain over the greatest measured one."""
    difference = confined_strain(material, oedometer.stress) - np.array(oedometer.strain)
    return rms(difference) / oedometer.strain[-1]
