# SPDX-License-Identifier: GPL-2.0-or-later
"""What mass alone allows of the measured sinkages, whatever the law.

Snow of depth h and density rho_0 that is left in the track at density rho, a share phi of its mass,
is phi h rho_0/rho thick. The hub comes down by the rest of h and by the tyre's deflection delta:

    z = h - phi h rho_0/rho + delta.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from table11 import DENSITY_UNDER, WITHIN

from furrow_post.analyse.statistics import rms
from furrow_post.arrays import Floats

SHARES = (1.0, 0.9)  # of the mass that is left
DEFLECTIONS = (0.0, 0.045)  # [m]; 0.045: on a plane under the load [Shoop2001] Table 6, 179 kPa

Row = dict[str, Any]


def thickness(rows: Sequence[Mapping[str, float]]) -> Floats:
    """h - z as measured [m]."""
    return np.array([row["depth_m"] - row["sinkage_m"] for row in rows])


def areal_mass(rows: Sequence[Mapping[str, float]]) -> Floats:
    """[kg/m2] of the snow before."""
    return np.array([row["depth_m"] * row["density_kgm3"] for row in rows])


def least_error(
    rows: Sequence[Mapping[str, float]], density: float, share: float
) -> tuple[float, float]:
    """Least rms error of z [m]: with the best single deflection, and with the best of each row
    within DEFLECTIONS."""
    wanted = share * areal_mass(rows) / density - thickness(rows)  # delta that meets the row
    own = wanted - np.clip(wanted, *DEFLECTIONS)
    return rms(wanted - np.clip(wanted.mean(), *DEFLECTIONS)), rms(own)


def trend(rows: Sequence[Mapping[str, float]]) -> tuple[float, float, float]:
    """Straight line of the measured thickness over the mass: at no mass [m], slope as an apparent
    density [kg/m3], rms distance [m]."""
    slope, start = np.polyfit(areal_mass(rows), thickness(rows), 1)
    left = thickness(rows) - start - slope * areal_mass(rows)
    return float(start), float(1 / slope), rms(left)


def table(choices: Mapping[str, Sequence[Mapping[str, float]]]) -> list[Row]:
    """Least errors over each choice of rows, for densities within the goal."""
    found = []
    for density in (DENSITY_UNDER * (1 - WITHIN), DENSITY_UNDER, DENSITY_UNDER * (1 + WITHIN)):
        for share in SHARES:
            row: Row = {"density_kgm3": round(density), "mass_left": share}
            for name, rows in choices.items():
                single, own = least_error(rows, density, share)
                row[f"{name}_rms_one_deflection_m"] = round(single, 4)
                row[f"{name}_rms_any_deflection_m"] = round(own, 4)
            found.append(row)
    return found
