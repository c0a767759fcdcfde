# SPDX-License-Identifier: GPL-2.0-or-later
"""Bending stiffnesses per width in the tyre's file."""

from collections.abc import Iterator
from pathlib import Path

from furrow_post.study.runs import Runs
from furrow_post.study.values import load_yaml

TYRE = Path(__file__).resolve().parents[2] / "tyres" / "p235_75r15.yaml"


def bending(runs: Runs) -> Iterator[dict[str, object]]:
    """Bending stiffness of the belts, and of the softest element of the sidewall [N m]."""
    tyre = load_yaml(TYRE)
    for way, modulus in (("along", "E1"), ("across", "E2")):
        stiffness = float(tyre["tread"][modulus]) * float(tyre["tread"]["thickness"]) ** 3 / 12
        yield {"quantity": f"belt_stiffness_{way}", "stiffness": stiffness}
    yield {"quantity": "sidewall_stiffness_least", "stiffness": min(float(one) for one in tyre["sidewall"]["bending"])}
