#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the meshes of this folder, in millimetres.

    make.py           the files
    make.py --check   compares the files with what this command writes

rover_wheel.stl  rim with grousers, curved spokes and a hub; axle z through the origin
cone_30.obj      cone penetrometer of ASABE S313.3: 30 degrees, base 323 mm2, thinner rod
cone_60.obj      cone penetrometer of ISO 22476-1: 60 degrees, base 1000 mm2
The axis of a cone is z, with its tip at the origin, pointing down.
"""

import math
import struct
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

# Rover wheel: radii and width [mm], parts around
WIDTH = 150.0
BORE, HUB, RIM, TREAD, TIP = 20.0, 35.0, 144.0, 150.0, 162.0
SEGMENTS, GROUSERS, SPOKES = 72, 24, 8
SWEEP = math.radians(40)  # angle of a spoke from hub to rim, a multiple of a segment
STATIONS = 6  # parts along a spoke

# Cones: diameters of base and rod [mm], parts around
CONES = {"cone_30.obj": (30, 20.27, 15.88), "cone_60.obj": (60, 35.68, 35.68)}
ROD = 500.0  # length [mm]
AROUND = 32

Point = tuple[float, float]
Corner = tuple[float, float, float]
Facets = list[tuple[Corner, ...]]


def on_circle(radius: float, segment: int, turn: float = 0.0) -> Point:
    angle = 2 * math.pi * segment / SEGMENTS + turn
    return round(radius * math.cos(angle), 4), round(radius * math.sin(angle), 4)


def side_view() -> list[tuple[Point, ...]]:
    """The wheel in quadrilaterals with corners in counter-clockwise order."""
    quads: list[tuple[Point, ...]] = []
    for s in range(SEGMENTS):
        rings = [(BORE, HUB), (RIM, TREAD)]
        if s % (SEGMENTS // GROUSERS) == 0:
            rings.append((TREAD, TIP))
        for inner, outer in rings:
            corners = ((inner, s), (outer, s), (outer, s + 1), (inner, s + 1))
            quads.append(tuple(on_circle(radius, segment) for radius, segment in corners))
    parts = [k / STATIONS for k in range(STATIONS + 1)]
    line = [(HUB + (RIM - HUB) * part, SWEEP * part**2) for part in parts]
    for s in range(0, SEGMENTS, SEGMENTS // SPOKES):
        for (inner, before), (outer, after) in zip(line, line[1:]):
            quads.append(
                (
                    on_circle(inner, s, before),
                    on_circle(outer, s, after),
                    on_circle(outer, s + 1, after),
                    on_circle(inner, s + 1, before),
                )
            )
    return quads


def extrusion(quads: list[tuple[Point, ...]]) -> Facets:
    """Both sides, and a wall over each edge that belongs to one quadrilateral."""

    def at(point: Point, z: float) -> Corner:
        return point[0], point[1], z

    low, high = -WIDTH / 2, WIDTH / 2
    edges = {(quad[k], quad[(k + 1) % 4]) for quad in quads for k in range(4)}
    facets: Facets = []
    for a, b, c, d in quads:
        for p, q, r in ((a, b, c), (a, c, d)):
            facets += [(at(p, high), at(q, high), at(r, high)), (at(p, low), at(r, low), at(q, low))]
    for a, b in sorted(edges):
        if (b, a) not in edges:
            facets += [(at(a, low), at(b, low), at(b, high)), (at(a, low), at(b, high), at(a, high))]
    return facets


def cone(angle: float, base: float, rod: float) -> Facets:
    """Radius and z from the tip to the top of the rod, turned about z.

    Sections are polygons of the area of their circle, so that the cone index is exact.
    """
    corner = math.sqrt(2 * math.pi / (AROUND * math.sin(2 * math.pi / AROUND)))
    height = base / 2 / math.tan(math.radians(angle / 2))
    profile = [(0.0, 0.0), (base / 2, height), (rod / 2, height), (rod / 2, height + ROD), (0.0, height + ROD)]
    profile = [point for k, point in enumerate(profile) if point not in profile[:k]]

    def at(point: Point, n: int) -> Corner:
        turn, radius = 2 * math.pi * n / AROUND, corner * point[0]
        return round(radius * math.cos(turn), 4), round(radius * math.sin(turn), 4), round(point[1], 4)

    facets: Facets = []
    for low, high in zip(profile, profile[1:]):
        for n in range(AROUND):
            a, b, c, d = at(low, n), at(low, n + 1), at(high, n + 1), at(high, n)
            facets += [facet for facet in ((a, b, c), (a, c, d)) if len(set(facet)) == 3]
    return facets


def binary_stl(facets: Facets) -> bytes:
    data = b"in millimetres".ljust(80) + struct.pack("<I", len(facets))
    for corners in facets:
        data += struct.pack("<12fH", 0, 0, 0, *(x for corner in corners for x in corner), 0)
    return data


def obj(facets: Facets) -> bytes:
    number: dict[Corner, int] = {}
    for corners in facets:
        for corner in corners:
            number.setdefault(corner, len(number) + 1)
    lines = ["# in millimetres", *(f"v {x:g} {y:g} {z:g}" for x, y, z in number)]
    lines += ["f " + " ".join(str(number[corner]) for corner in corners) for corners in facets]
    return ("\n".join(lines) + "\n").encode()


def main() -> None:
    files = {"rover_wheel.stl": binary_stl(extrusion(side_view()))}
    files |= {name: obj(cone(*shape)) for name, shape in CONES.items()}
    for name, content in files.items():
        path = FOLDER / name
        if sys.argv[1:] != ["--check"]:
            path.write_bytes(content)
        elif content != path.read_bytes():
            sys.exit(f"{path}: is not what {Path(__file__).name} writes; run it")


if __name__ == "__main__":
    main()
