# SPDX-License-Identifier: GPL-2.0-or-later
"""Training data of a made wheel with a closed form."""

from pathlib import Path

import numpy as np
from scipy.stats import qmc

from furrow_post.arrays import Floats
from furrow_post.csv_table import write_rows
from furrow_post.surrogate.training import HUB_DROP, MOTION_RESISTANCE, PULL, TORQUE

RADIUS, SPEED = 0.25, 0.5
RANGES = {"slip": (-0.2, 0.7), "load": (300.0, 900.0), "phi": (24.0, 38.0)}


def wheel(slip: Floats, load: Floats, phi: Floats) -> dict[str, Floats]:
    """Coefficients by Janosi's shear and a resistance that grows with the load."""
    thrust = np.tan(np.radians(phi)) * (1 - np.exp(-3 * (slip + 0.25)))
    resistance = 0.1 * np.sqrt(load / 600)
    return {
        PULL: thrust - resistance,
        TORQUE: thrust,
        HUB_DROP: 0.02 * (load / 600) ** 0.7,
        MOTION_RESISTANCE: resistance,
    }


def samples(runs: int, noise: float = 0.0) -> dict[str, Floats]:
    """Inputs and answers by name; noise: standard deviation over the mean size of an answer."""
    unit = qmc.Halton(len(RANGES), seed=1).random(runs)
    inputs = {
        name: low + u * (high - low) for (name, (low, high)), u in zip(RANGES.items(), unit.T)
    }
    random = np.random.default_rng(2)
    answers = wheel(**inputs)
    for name in (PULL, TORQUE, HUB_DROP):
        answers[name] = answers[name] + noise * np.mean(np.abs(answers[name])) * random.normal(
            size=runs
        )
    return {**inputs, **answers}


def write_sweep_table(file: Path, runs: int, noise: float = 0.0, **columns: str) -> None:
    """As 'furrow-post sweep' writes it; columns: the same text in all rows."""
    found = samples(runs, noise)
    rows = [
        {
            **{f"set_{name}": f"{found[name][k]:.5g}" for name in RANGES},
            "load": f"{found['load'][k]:.5g}",
            "speed": f"{SPEED}",
            "force_z": f"{found['load'][k]:.8g}",
            "drive_torque": f"{RADIUS * found['load'][k] * found[TORQUE][k]:.8g}",
            **{name: f"{found[name][k]:.8g}" for name in (PULL, TORQUE, HUB_DROP)},
            **columns,
        }
        for k in range(runs)
    ]
    write_rows(file, rows, ["# load [N]", "# hub_drop [m]"])
