# SPDX-License-Identifier: GPL-2.0-or-later
"""The formula of Wong and Reece for the wheel and sand of the tests."""

from collections.abc import Iterator
from pathlib import Path

from furrow_post.laws.empirical import wong_reece
from furrow_post.laws.terrain_values import terrain, with_stress_place
from furrow_post.study.runs import Runs
from furrow_post.tables.frames import read_frame

RADIUS, WIDTH = 0.15735, 0.165  # m
REFERENCE = read_frame(Path(__file__).with_name("reference.csv"))


def formula(runs: Runs) -> Iterator[dict[str, float]]:
    """A row for each test, outside of the formula's range of diameters."""
    sand = with_stress_place(terrain("HIT-LSS1"))
    for slip, load in zip(REFERENCE.slip, REFERENCE.load_N):
        found = wong_reece(load, 2 * RADIUS, WIDTH, slip, sand, extrapolate=True)
        torque = next(one.value for one in found.extra if one.name == "torque")
        yield {"at": slip, "pull": -found.coefficient, "torque": torque / load / RADIUS, "sinkage": found.sinkage}
