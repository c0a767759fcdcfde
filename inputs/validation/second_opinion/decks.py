# SPDX-License-Identifier: GPL-2.0-or-later
"""Inputs of CalculiX: a square plate on a layer, and one cube without lateral strain."""

import math
from collections.abc import Sequence

import numpy as np

from furrow_post.arrays import Booleans, Floats

YOUNG, POISSON, YIELD = 1e6, 0.3, 1e4  # [Pa], as in elastic.yaml and mises.yaml
BOX, DEPTH, SIZE = 0.6, 0.3, 0.2  # [m], as in ground.lig
STRAINS = (0.01, 0.04, 0.02)  # of the path of the point
INCREMENTS = 5  # on the Mises law
CORNERS = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
MIDDLES = ((1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
           (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1))  # fmt: skip


def material(plastic: bool) -> str:
    law = f"*PLASTIC\n{YIELD:g},0\n" if plastic else ""
    return f"*MATERIAL, NAME=SOIL\n*ELASTIC\n{YOUNG:g},{POISSON:g}\n{law}*SOLID SECTION, ELSET=SOIL, MATERIAL=SOIL\n"


def mesh(points: Floats, elements: Sequence[Sequence[int]], kind: str) -> str:
    """points: (n, 3); elements: of indices from 0; CalculiX reads 16 words of a line."""
    lines = ["*NODE, NSET=ALL", *(f"{i},{x:.9g},{y:.9g},{z:.9g}" for i, (x, y, z) in enumerate(points, 1))]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=SOIL")
    for i, nodes in enumerate(elements, 1):
        words = [str(node + 1) for node in nodes]
        lines.append(f"{i}," + ",".join(words[:15]) + ("," if len(words) > 15 else ""))
        lines += [",".join(words[15:])] if len(words) > 15 else []
    return "\n".join(lines) + "\n"


def node_set(name: str, chosen: Booleans) -> str:
    return f"*NSET, NSET={name}\n" + "".join(f"{i + 1},\n" for i in np.flatnonzero(chosen))


def loading(displacement: float, static: str, geometry: str) -> str:
    return (
        f"*STEP{geometry}, INC=1000\n*STATIC{static}\n*BOUNDARY\nPLATE,3,3,{displacement:.12g}\n"
        "*NODE PRINT, NSET=PLATE, TOTALS=ONLY\nRF\n*END STEP\n"
    )


def plate(count: int, sinkage: float, plastic: bool) -> str:
    """A quarter of the layer in count^3 elements with quadratic shape functions (C3D20R)."""
    places: dict[tuple[int, int, int], int] = {}
    elements = []
    for i, j, k in np.ndindex(count, count, count):
        nodes = [(2 * i + a, 2 * j + b, 2 * k + c) for a, b, c in (*CORNERS, *MIDDLES)]
        elements.append([places.setdefault(node, len(places)) for node in nodes])
    points = np.array(list(places)) * np.array([BOX / 2, BOX / 2, DEPTH]) / (2 * count)
    x, y, z = points.T
    near = 1e-9
    text = mesh(points, elements, "C3D20R")
    text += node_set("BASE", z < near)
    text += node_set("SIDESX", (x < near) | (x > BOX / 2 - near))
    text += node_set("SIDESY", (y < near) | (y > BOX / 2 - near))
    text += node_set("PLATE", (z > DEPTH - near) & (x < SIZE / 2 + near) & (y < SIZE / 2 + near))
    text += material(plastic) + "*BOUNDARY\nBASE,1,3\nSIDESX,1\nSIDESY,2\n"
    return text + loading(-sinkage, f", DIRECT\n{1 / INCREMENTS:g},1" if plastic else "", "")


def oedometer() -> str:
    """One cube of 1 m without lateral strain, large deformations."""
    points = np.array(CORNERS) / 2.0
    text = mesh(points, [range(8)], "C3D8") + node_set("PLATE", points[:, 2] > 0.5)
    text += node_set("BASE", points[:, 2] < 0.5) + material(True) + "*BOUNDARY\nALL,1,2\nBASE,3\n"
    return text + "".join(loading(math.exp(-strain) - 1, ", DIRECT\n0.05,1", ", NLGEOM") for strain in STRAINS)
