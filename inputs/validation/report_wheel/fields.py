# SPDX-License-Identifier: GPL-2.0-or-later
"""Fields under the report's wheel as numbers: what its Figs 65 to 67 draw."""

from pathlib import Path
from typing import Any

import numpy as np

from furrow_post.analyse.displacement import displacements
from furrow_post.analyse.rut import rut_densities, share_left
from furrow_post.analyse.statistics import place_of_greatest
from furrow_post.read.terrain import Outline, Terrain, TerrainStress

GREATEST = 10  # particles of a layer, of both halves, whose mean place is that of the greatest
WITHIN = 0.3  # [m] to both sides of the axle that are looked at


def numbers(folder: Path) -> dict[str, Any]:
    """Densities [kg/m3]; displacements [cm] where the finished rut is; where the deviatoric stress
    q is greatest in the middle plane, ahead of the axle [cm], just below the wheel and at the
    base."""
    terrain, stress = Terrain.read(folder), TerrainStress.read(folder)
    body = Outline(folder, terrain)
    densities, moved = rut_densities(terrain, body), displacements(terrain, body)
    assert body.surface
    x, z = terrain.x[:, 0] - body.centre[0], terrain.x[:, 2]
    near = (np.abs(terrain.x[:, 1]) < terrain.spacing) & (np.abs(x) < WITHIN)
    near &= z < body.surface.x[:, 2].min()
    layers = terrain.levels(near)
    upper, base = (
        near & terrain.at_level(layer) for layer in (layers[len(layers) // 2], layers[0])
    )
    return {
        "density_under": round(densities.under),
        "density_greatest": round(densities.greatest_under),
        "density_shoulder": round(densities.shoulder),
        "mass_left": round(share_left(terrain, body), 2),
        **{f"{name}_cm": round(100 * value, 1) for name, value in vars(moved).items()},
        "q_kPa": round(float(stress.mises[near].max()) / 1e3),
        **{
            f"q_{name}_ahead_cm": round(
                100 * place_of_greatest(x[layer], stress.mises[layer], GREATEST), 1
            )
            for name, layer in (("middle", upper), ("base", base))
        },
    }
