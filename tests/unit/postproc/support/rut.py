# SPDX-License-Identifier: GPL-2.0-or-later
"""A rut in closed form: grains on a jittered lattice, pushed down and aside under a wheel's path."""

from pathlib import Path

import h5py
import numpy as np
import numpy.typing as npt

from furrow_post.arrays import Floats, Integers
from support.runs import write_grains


def bed(
    length: float, breadth: float, depth: float, diameter: float, random: np.random.Generator
) -> tuple[Floats, Floats]:
    """Hexagonal layers with a little disorder: x (n, 3), radius (n) [m]; surface at z = depth."""
    pitch = 1.04 * diameter
    counts = (int(depth / (pitch * np.sqrt(2 / 3))), int(breadth / (pitch * np.sqrt(3) / 2)), int(length / pitch))
    k, j, i = (index.ravel() for index in np.indices(counts))
    top = depth - diameter / 2
    x = np.stack(
        [
            (i + 0.5 * ((j + k) % 2) + 0.5) * pitch,
            (j + (k % 2) / 3 + 0.5) * pitch * np.sqrt(3) / 2,
            top - (counts[0] - 1 - k) * pitch * np.sqrt(2 / 3),
        ],
        axis=1,
    )
    x[:, 1] -= breadth / 2
    x += random.normal(0, 0.08 * diameter, x.shape)
    return x, diameter * (0.5 + 0.05 * random.uniform(-1, 1, len(x)))


def rut(x: Floats, level: float, start: float, axle: float, radius: float, width: float, sinkage: float) -> Floats:
    """Displacement (n, 3) under a wheel that rolled from start to axle.

    Down below it, up and aside in berms.
    """
    into = 1 / (1 + np.exp(-(x[:, 0] - start) / 0.02))
    behind = into / (1 + np.exp((x[:, 0] - axle - 0.45 * radius) / 0.01))
    ahead = np.maximum(x[:, 0] - axle, 0)
    rise = radius - np.sqrt(np.maximum(radius**2 - ahead**2, 0))
    chord = np.clip(rise, 0, sinkage)
    across = np.exp(-((np.abs(x[:, 1]) / (0.52 * width)) ** 6))
    berm = np.exp(-(((np.abs(x[:, 1]) - 0.75 * width) / (0.18 * width)) ** 2))
    decay = np.exp(-(level - x[:, 2]) / (0.8 * width))
    moved = np.zeros_like(x)
    moved[:, 2] = behind * decay * (-(sinkage - chord) * across + 0.4 * sinkage * berm)
    moved[:, 1] = np.sign(x[:, 1]) * behind * decay * 0.5 * sinkage * berm
    moved[:, 0] = 0.35 * sinkage * behind * decay * across
    return moved


def wheel(radius: float, width: float, centre: npt.ArrayLike, segments: int = 72) -> tuple[Integers, Floats]:
    """A closed cylinder: triangles (m, 3), x (n, 3)."""
    angle = 2 * np.pi * np.arange(segments) / segments
    ring = radius * np.stack([np.cos(angle), np.zeros(segments), np.sin(angle)], axis=1)
    half = np.array([0, width / 2, 0])
    x = np.concatenate([ring - half, ring + half, [-half, half]]) + centre
    a, b = np.arange(segments), (np.arange(segments) + 1) % segments
    left, right = np.full(segments, 2 * segments), np.full(segments, 2 * segments + 1)
    triangles = np.concatenate(
        [
            np.stack([a, a + segments, b], 1),
            np.stack([b, a + segments, b + segments], 1),
            np.stack([a, b, left], 1),
            np.stack([b + segments, a + segments, right], 1),
        ]
    )
    return triangles, x


def write_rut(path: Path, diameter: float) -> None:
    """Adds /grains and /surface to a results file. diameter: of the grains [m]"""
    length, breadth, depth = 0.8, 0.3, 0.12
    wheel_radius, wheel_width, sinkage = 0.15, 0.1, 0.03
    random = np.random.default_rng(1)
    x, radius = bed(length, breadth, depth, diameter, random)
    identity = random.permutation(len(x)) + 1
    axle = 0.68 * length
    moved = rut(x, depth, 0.18 * length, axle, wheel_radius, wheel_width, sinkage)
    shuffled = random.permutation(len(x))
    with h5py.File(path, "a") as content:
        reference = content.create_group("grains/reference")
        write_grains(reference, x, radius, depth, identity)
        final = content.create_group("grains/final")
        after = (x + moved)[shuffled]
        write_grains(final, after, radius[shuffled], depth, identity[shuffled])
        final["v"] = np.zeros_like(x)
        centre = [axle, 0, depth - sinkage + wheel_radius]
        triangles, nodes = wheel(wheel_radius, wheel_width, centre)
        content["surface/triangles"], content["surface/x"] = triangles, nodes
