# SPDX-License-Identifier: GPL-2.0-or-later
"""Training data of a made wheel with a closed form."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from scipy.stats import qmc

from furrow_post.arrays import Floats
from furrow_post.csv_table import write_rows
from furrow_post.surrogate.gaussian_process import Process
from furrow_post.surrogate.model import Input, Surrogate
from furrow_post.surrogate.training import HUB_DROP, MOTION_RESISTANCE, PULL, QUANTITIES, TORQUE

RADIUS, SPEED = 0.25, 0.5
Ranges = Mapping[str, tuple[float, float]]
RANGES = {"slip": (-0.2, 0.7), "load": (300.0, 900.0), "phi": (24.0, 38.0)}


def wheel(slip: Floats, load: Floats, phi: Floats, k: Floats | float = 1.0) -> dict[str, Floats]:
    """Coefficients by Janosi's shear and a resistance that grows with the load over a stiffness k."""
    thrust = np.tan(np.radians(phi)) * (1 - np.exp(-3 * (slip + 0.25)))
    resistance = 0.1 * np.sqrt(load / 600 / k)
    return {
        PULL: thrust - resistance,
        TORQUE: thrust,
        HUB_DROP: 0.02 * (load / 600 / k) ** 0.7,
        MOTION_RESISTANCE: resistance,
    }


def closed_form(slope: float, phi: float, load: float) -> tuple[float, float, float]:
    """Largest pull minus need, slip and energy per distance of the operating point; load: on level ground."""
    slip = np.linspace(*RANGES["slip"], 20001)
    load *= np.cos(np.radians(slope))
    answers = wheel(slip, np.array(load), np.array(phi))
    need = np.tan(np.radians(slope))
    k = int(np.argmax(answers[PULL] >= need))
    rim = 1 / (1 - slip[k]) if slip[k] > 0 else 1 + slip[k]
    return float(answers[PULL].max() - need), float(slip[k]), float(load * answers[TORQUE][k] * rim)


def samples(runs: int, noise: float = 0.0, ranges: Ranges = RANGES) -> dict[str, Floats]:
    """Inputs and answers by name; noise: standard deviation over the mean size of an answer."""
    unit = qmc.Halton(len(ranges), seed=1).random(runs)
    inputs = {name: low + u * (high - low) for (name, (low, high)), u in zip(ranges.items(), unit.T)}
    random = np.random.default_rng(2)
    answers = wheel(**inputs)
    for name in (PULL, TORQUE, HUB_DROP):
        answers[name] = answers[name] + noise * np.mean(np.abs(answers[name])) * random.normal(size=runs)
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


def made_surrogate(runs: int = 80, ranges: Ranges = RANGES) -> Surrogate:
    """Processes of the closed form with fixed lengths: no search."""
    found = samples(runs, ranges=ranges)
    inputs = tuple(Input(name, "", low, high) for name, (low, high) in ranges.items())
    x = np.column_stack([one.scaled(found[one.name]) for one in inputs])
    lengths = np.array([2.0, *[4.0] * (len(ranges) - 1)])
    processes = {name: Process(x, found[name], lengths, 30.0, 1e-6) for name in QUANTITIES}
    constants = {"wheel_radius": RADIUS, "speed": SPEED}
    checks = {name: {"rms_error": 0.0, "coverage": 0.95} for name in QUANTITIES}
    origin = dict.fromkeys(("program", "source", "commit", "fitted"), "made")
    return Surrogate(inputs, processes, checks, constants, origin)
