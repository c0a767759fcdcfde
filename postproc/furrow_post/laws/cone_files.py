# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil and tyre of the formulas of a cone index, from a material file and a tyre file."""

import functools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from ..errors import content_of
from ..json_text import parse_json
from ..programs import find_program
from ..run.tools import answer
from .cone_formulas import Tyre
from .tyre_estimate import FLANGE, TREAD_OVER_DIAMETER
from .tyre_fit import PlateTest, press
from .tyre_size import is_radial

# Law -> kind of soil of the formulas; they do not speak of other laws, as those of snow
KINDS = {"undrained_clay": "clay", "drucker_prager": "sand", "drucker_prager_cap": "sand", "norsand": "sand"}
# [Pa] cohesion above which a soil is fine-grained: the dry sands of terrains.csv have up to 1300 Pa, the sandy loam 1720 Pa
COHESIVE = 1500.0
MESH = (4, 36)  # of the tyre on a rigid plane


@dataclass(frozen=True)
class Soil:
    """kind: sand or clay, that is fine-grained soil, as the formulas have it; cone index [Pa]."""

    kind: str
    cone_index: float


@functools.cache
def soil_of(material: Path) -> Soil | None:
    """Soil of a material file; None where it has no cone index, or no sand or fine-grained soil. @raises ResultsError"""
    content = parse_json(answer([find_program("furrow-point"), "show", material, "--json"]))
    index, kind = content.get("cone_index"), kind_of(content["law"], content["sections"]["law"])
    return Soil(kind, float(index)) if kind and index is not None else None


def kind_of(law: str, values: Mapping[str, Any]) -> str | None:
    """Kind of soil of a law with its values; a sand without friction, or with much cohesion, is fine-grained soil."""
    kind = KINDS.get(law)
    return "clay" if kind == "sand" and (values.get("beta") == 0.0 or cohesion(values) > COHESIVE) else kind


def cohesion(law: Mapping[str, Any]) -> float:
    """Cohesion [Pa] of Mohr-Coulomb in triaxial compression; 0 of a law without d."""
    tangent = math.tan(math.radians(law.get("beta", 0.0)))
    sine = 3 * tangent / (6 + tangent)
    return float(law.get("d", 0.0)) * (3 - sine) / (6 * math.sqrt(1 - sine**2))


@functools.cache
def formula_tyre(file: Path, pressure: float, load: float) -> Tyre:
    """Sizes of a tyre file and its deflection on a rigid plane, for formulas. pressure [Pa], load [N].

    The outer diameter is that of the inflated belt with the tread of an estimated tyre. A tyre is radial where its title
    is a designation with R. @raises ResultsError"""
    with content_of(file, "a tyre file is YAML, inputs/guide/tyre_files.md"):
        text = file.read_text(encoding="utf-8")
        content = yaml.safe_load(text)
        bead, title = float(content["tyre"]["bead_radius"]), str(content.get("title", ""))
    (state,) = press(text, [PlateTest(1e-3 * pressure, load, {})], MESH)
    diameter = 0.02 * state["crown_radius_cm"] / (1 - 2 * TREAD_OVER_DIAMETER)
    width = 1e-2 * state["section_width_cm"]
    return Tyre(load, diameter, width, 0.5 * diameter - bead + FLANGE, 1e-2 * state["deflection_cm"], radial=is_radial(title))
