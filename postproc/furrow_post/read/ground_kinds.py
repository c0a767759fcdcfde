# SPDX-License-Identifier: GPL-2.0-or-later
"""Kinds of ground under a wheel. Readings ask for a property, not for a name."""

from dataclasses import dataclass

TERRAINS = ("terrain", "scm")  # kinds of the styles that are ground


@dataclass(frozen=True)
class GroundKind:
    elements: str  # what the run counts: "particles", "cells", "grains"
    sizes: str  # whose size is that of the run: "cells" or "grains"
    random: bool = True  # each packing gives other values
    has_density: bool = True  # at each point
    has_tests: bool = True  # measurements give the error of its model


GROUND_KINDS = {
    "continuum": GroundKind("particles", "cells", random=False),
    "scm": GroundKind("cells", "cells", random=False, has_density=False, has_tests=False),
    "grains": GroundKind("grains", "grains"),
    "hybrid": GroundKind("grains", "grains"),  # on a continuum
    "none": GroundKind("grains", "grains", has_density=False),
}


def ground_kind(ground: str) -> GroundKind:
    """Kind by its name in files; others, such as curves of a formula, count as grains."""
    return GROUND_KINDS.get(ground, GROUND_KINDS["grains"])
