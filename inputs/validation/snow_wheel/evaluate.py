# SPDX-License-Identifier: GPL-2.0-or-later
"""The field's snow in confined compression, and a rigid wheel on it in closed form."""

import numpy as np

from furrow_post.laws.compressed_snow import CompressedSnow, cam_clay_confined
from furrow_post.laws.empirical import nrmm_resistance, nrmm_sinkage  # for study.yaml
from furrow_post.arrays import Floats

__all__ = ["nrmm_resistance", "nrmm_sinkage"]
# field_snow.yaml: axial stresses [Pa] at densities [kg/m3], straight in ln p. From 525 kg/m3 on final densities under wheels
# of these pressures, as the sinkage formula of [CRREL95-7] takes them
DENSITIES = (100.0, 380.0, 450.0, 490.0, 525.0, 575.0, 625.0, 660.0)
STRESSES = (15.0, 4e3, 25e3, 100e3, 210e3, 350e3, 700e3, 1400e3)


def field_stress(strain: Floats, density: float = 220.0) -> Floats:
    """Axial stress [Pa] over the strain from a density on."""
    return np.asarray(np.exp(np.interp(density * np.exp(strain), DENSITIES, np.log(STRESSES))))


def rigid(diameter: float, width: float) -> CompressedSnow:
    return CompressedSnow(diameter / 2, width, 0.20, field_stress)


def k0(slope: float) -> float:
    return round(cam_clay_confined(slope, 0.1)[0], 2)
