# SPDX-License-Identifier: GPL-2.0-or-later
"""A results folder with a rut in closed form: grains on a jittered lattice, pushed down and aside under a wheel's path."""

import h5py
import numpy as np

CHANNELS = [("time", "s", "simulated time")]


def bed(length, breadth, depth, diameter, random):
    """Hexagonal layers with a little disorder: x (n, 3), radius (n) [m]; the surface is at z = depth."""
    pitch = 1.04 * diameter
    nx, ny, nz = int(length / pitch), int(breadth / (pitch * np.sqrt(3) / 2)), int(depth / (pitch * np.sqrt(2 / 3)))
    k, j, i = (index.ravel() for index in np.meshgrid(np.arange(nz), np.arange(ny), np.arange(nx), indexing="ij"))
    x = np.stack([(i + 0.5 * ((j + k) % 2) + 0.5) * pitch, (j + (k % 2) / 3 + 0.5) * pitch * np.sqrt(3) / 2,
                  depth - diameter / 2 - (nz - 1 - k) * pitch * np.sqrt(2 / 3)], axis=1)
    x[:, 1] -= breadth / 2
    x += random.normal(0, 0.08 * diameter, x.shape)
    return x, diameter * (0.5 + 0.05 * random.uniform(-1, 1, len(x)))


def rut(x, level, start, axle, radius, width, sinkage):
    """Displacement (n, 3) of ground under a wheel that rolled from start to axle: down below it, up and aside in berms."""
    behind = 1 / (1 + np.exp(-(x[:, 0] - start) / 0.02)) / (1 + np.exp((x[:, 0] - axle - 0.45 * radius) / 0.01))
    chord = np.clip(radius - np.sqrt(np.maximum(radius**2 - np.maximum(x[:, 0] - axle, 0) ** 2, 0)), 0, sinkage)
    across = np.exp(-((np.abs(x[:, 1]) / (0.52 * width)) ** 6))
    berm = np.exp(-(((np.abs(x[:, 1]) - 0.75 * width) / (0.18 * width)) ** 2))
    decay = np.exp(-(level - x[:, 2]) / (0.8 * width))
    moved = np.zeros_like(x)
    moved[:, 2] = behind * decay * (-(sinkage - chord) * across + 0.4 * sinkage * berm)
    moved[:, 1] = np.sign(x[:, 1]) * behind * decay * 0.5 * sinkage * berm
    moved[:, 0] = 0.35 * sinkage * behind * decay * across
    return moved


def wheel(radius, width, centre, segments=72):
    """A closed cylinder: triangles (m, 3), x (n, 3)."""
    angle = 2 * np.pi * np.arange(segments) / segments
    ring = np.stack([radius * np.cos(angle), np.zeros(segments), radius * np.sin(angle)], axis=1)
    x = np.concatenate([ring - [0, width / 2, 0], ring + [0, width / 2, 0], [[0, -width / 2, 0], [0, width / 2, 0]]]) + centre
    a, b = np.arange(segments), (np.arange(segments) + 1) % segments
    left, right = 2 * segments, 2 * segments + 1
    triangles = np.concatenate([np.stack([a, a + segments, b], 1), np.stack([b, a + segments, b + segments], 1),
                                np.stack([a, b, np.full(segments, left)], 1),
                                np.stack([b + segments, a + segments, np.full(segments, right)], 1)])
    return triangles, x


def write_grains(group, identity, x, radius, level):
    group["id"], group["x"], group["radius"], group["period"] = identity, x, radius, np.zeros(3)
    group.attrs["bed_level"] = level


def write_rut(path, length=0.8, breadth=0.3, depth=0.12, diameter=0.008, wheel_radius=0.15, wheel_width=0.1, sinkage=0.03):
    """Adds /grains and /surface to a results file."""
    random = np.random.default_rng(1)
    x, radius = bed(length, breadth, depth, diameter, random)
    identity = random.permutation(len(x)) + 1
    axle = 0.68 * length
    moved = rut(x, depth, 0.18 * length, axle, wheel_radius, wheel_width, sinkage)
    shuffled = random.permutation(len(x))
    with h5py.File(path, "a") as content:
        write_grains(content.create_group("grains/reference"), identity, x, radius, depth)
        final = content.create_group("grains/final")
        write_grains(final, identity[shuffled], (x + moved)[shuffled], radius[shuffled], depth)
        final["v"] = np.zeros_like(x)
        content["surface/triangles"], content["surface/x"] = wheel(wheel_radius, wheel_width,
                                                                   [axle, 0, depth - sinkage + wheel_radius])
    return len(x)
