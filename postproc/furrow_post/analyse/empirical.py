# SPDX-License-Identifier: GPL-2.0-or-later
"""Empirical formulas of mobility to lay beside computed runs, with source and range of validity.

Nothing is extrapolated unless asked: outside of the range a formula raises OutOfRange, which names
every value that is outside.
"""

from .prediction import OutOfRange, Prediction
from .sand_formulas import bekker, wong_reece
from .snow_formula import (
    NRMM_COEFFICIENT_RMS,
    NRMM_SINKAGE_RMS,
    TRACTION,
    SnowTraction,
    nrmm,
    nrmm_final_density,
    nrmm_resistance,
    nrmm_sinkage,
    require_pressure,
    snow_traction,
)
from .terrain_values import terrain

__all__ = [
    "NRMM_COEFFICIENT_RMS",
    "NRMM_SINKAGE_RMS",
    "OutOfRange",
    "Prediction",
    "SnowTraction",
    "TRACTION",
    "bekker",
    "nrmm",
    "nrmm_final_density",
    "nrmm_resistance",
    "nrmm_sinkage",
    "require_pressure",
    "snow_traction",
    "terrain",
    "wong_reece",
]
