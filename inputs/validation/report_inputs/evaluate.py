# SPDX-License-Identifier: GPL-2.0-or-later
"""Moduli and thickness of the belts in the tyre's file."""

from collections.abc import Iterator
from pathlib import Path

from furrow_post.study.runs import Runs
from furrow_post.study.values import load_yaml

TYRE = Path(__file__).resolve().parents[2] / "tyres" / "p235_75r15.yaml"


def belts(runs: Runs) -> Iterator[dict[str, object]]:
    tread = load_yaml(TYRE)["tread"]
    for way, modulus in (("along", "E1"), ("across", "E2")):
        yield {"way": way, "E": float(tread[modulus]), "thickness": float(tread["thickness"])}
