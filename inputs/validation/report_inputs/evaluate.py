# SPDX-License-Identifier: GPL-2.0-or-later
"""Bending stiffnesses per width in the tyre's file, and the closed form of the sand's compression."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from furrow_post.study.runs import Runs
from furrow_post.study.values import load_yaml

INPUTS = Path(__file__).resolve().parents[2]


def bending(runs: Runs) -> Iterator[dict[str, object]]:
    """Bending stiffness of the belts, and of the softest element of the sidewall [N m]."""
    tyre = load_yaml(INPUTS / "tyres" / "p235_75r15.yaml")
    for way, modulus in (("along", tyre["tread"]["E1"]), ("across", tyre["tread"]["E2"])):
        yield {"quantity": f"belt_stiffness_{way}", "stiffness": float(modulus) * float(tyre["tread"]["thickness"]) ** 3 / 12}
    yield {"quantity": "sidewall_stiffness_least", "stiffness": min(float(one) for one in tyre["sidewall"]["bending"])}


def confined(stress: float) -> float:
    """Axial strain of the sand by the cap law [Shoop2001] (eq 12-14) for flow without lateral plastic strain."""
    sand = load_yaml(INPUTS / "materials" / "mccormick_sand.yaml")
    d, beta, R, start, E, nu = (float({**sand["law"], **sand["elasticity"]}[k]) for k in ("d", "beta", "R", "eps_vol_pl_0", "E", "nu"))
    slope, y = np.tan(np.radians(beta)), 1 / np.hypot(1, 1.5 * R)
    pa, strength = np.linalg.solve([[1, (1.5 * R**2 + 2 / 3) * y], [-slope, 1]], [stress, d])  # q of the shear line at pa
    table = np.array([sand["hardening"][k] for k in ("p", "eps_vol_pl")], float)
    return float(np.interp(pa + R * strength, *table) - start + 3 * (1 - 2 * nu) / E * (pa + 1.5 * R**2 * y * strength))
