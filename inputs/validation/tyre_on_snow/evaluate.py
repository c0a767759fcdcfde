# SPDX-License-Identifier: GPL-2.0-or-later
"""Place of the vertical stress in the snow under the wheel."""

import numpy as np

from furrow_post.read.results import Results
from furrow_post.read.terrain import read_terrain_fields
from furrow_post.study.runs import Run


def stress_in_depth(run: Run) -> dict[str, float]:
    """Stress 10 to 15 cm below the undisturbed surface, near the axle: share ahead of it, and centroid [m]."""
    terrain = read_terrain_fields(run.folder)
    x = terrain["x"][:, 0] - Results(run.folder).columns["x"][-1]
    middle = (np.abs(terrain["initial_position"][:, 2] - 0.075) < 0.025) & (np.abs(x) < 0.4)
    stress = np.maximum(-terrain["vertical_stress"][middle], 0.0) * terrain["volume"][middle]
    return {"front": stress[x[middle] > 0].sum() / stress.sum(), "centroid": (stress * x[middle]).sum() / stress.sum()}
