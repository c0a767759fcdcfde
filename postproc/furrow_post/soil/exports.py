# SPDX-License-Identifier: GPL-2.0-or-later
"""Soil cards in the formats of vehicle codes.

Chrono: the terrain file of its co-simulation (data/vehicle/cosim/terrain/scm_hard.json of Project
Chrono). Altair: the road data file of its soft-soil tyre (MotionView help, "Road Modeling" and
"Deformable Road"). MSC Adams documents no soil file publicly, so its users take the table.
"""

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

from ..errors import ResultsError
from ..laws.terrain_values import LOOSE_SAND, terrain
from ..read.soil_card import CHRONO, UNITS, SoilCard

# Damping of Chrono's sample files [Pa s/m]: a card has none
CHRONO_DAMPING = 3e4
ALTAIR_HEAD = """[MDI_HEADER]
FILE_TYPE = 'rdf'
FILE_VERSION = 5.00
FILE_FORMAT = 'ASCII'
[UNITS]
LENGTH = 'm'
FORCE = 'newton'
ANGLE = 'radians'
MASS = 'kg'
TIME = 'sec'
[MODEL]
PROPERTY_FILE_FORMAT = 'USER'
FUNCTION_NAME = 'mbdtire::ROADSUB'
METHOD = '3D'
ROAD_TYPE = 'softsoil'
[PARAMETERS]
MU = 1.0
OFFSET = 0.0
LENGTH = 300.0
WIDTH = 6.0
NODES = 1
MULTIPASS = 'TRUE'
[PROPERTIES]"""


def write_chrono(card: SoilCard, path: Path) -> None:
    """Chrono requires an elastic stiffness above k_phi."""
    card.require_usable()
    plate, _ = card.bekker_and_shear()
    soil = {name: fitted.value for name, fitted in card.parameters().items()}
    soil |= {"stiffness": max(card.stiffness, 2 * plate.k_phi.value), "damping": CHRONO_DAMPING}
    content = {
        "Type": "SCM",
        "Description": f"{card.title}; {card.condition()}; Damping is that of Chrono's samples, not of a test",
        "Patch dimensions": {"Length": 10, "Width": 2},
        "Grid spacing": 0.04,
        "Soil parameters": {key: soil[name] for key, name in CHRONO.items()},
        "Simulation settings": {"Proxy contact radius": 0.002, "Fix proxies": True},
    }
    path.write_text(json.dumps(content, indent=4) + "\n", encoding="utf-8")


def write_altair(card: SoilCard, path: Path) -> None:
    """C1 and C2, the place of the greatest stress under a wheel, are those of loose sand; plates do
    not give them."""
    card.require_usable()
    (plate, shear), sand = card.bekker_and_shear(), terrain(LOOSE_SAND)
    soil = {
        "PHI": (math.radians(shear.phi.value), "angle of internal shearing resistance"),
        "C": (shear.c.value, "apparent cohesion"),
        "KC": (plate.k_c.value, "pressure-sinkage parameter"),
        "KPHI": (plate.k_phi.value, "pressure-sinkage parameter"),
        "SINKAGE_EXPONENT": (plate.n.value, "n"),
        "SOIL_STIFFNESS": (card.stiffness, "elastic stiffness"),
        "SOIL_DAMPING": (0.0, "not of a test"),
        "SOIL_DENSITY": (_known(card, card.density, "density"), "density"),
        "KX0": (0.0, "shear deformation modulus over slip angle"),
        "KY0": (0.0, "the same"),
        "KX1": (shear.K.value, "shear deformation modulus"),
        "KY1": (shear.K.value, "the same"),
        "C1": (sand.c1, "not of a test: Wong and Reece (1967), loose sand"),
        "C2": (sand.c2, "not of a test: the same"),
    }
    lines = [f"$ {' '.join(card.title.split())}", f"$ {card.condition()}"]
    properties = [f"{name} = {value!r} $ {meaning}" for name, (value, meaning) in soil.items()]
    path.write_text("\n".join([*lines, ALTAIR_HEAD, *properties, ""]), encoding="utf-8")


def write_table(card: SoilCard, path: Path) -> None:
    """One row for each parameter, and a comment for each instrument without a result."""
    with open(path, "w", encoding="utf-8", newline="") as file:
        file.write(f"# {' '.join(card.title.split())}\n# {card.condition()}\n")
        for instrument, why in card.failures().items():
            file.write(f"# {instrument}: no result, {why}\n")
        parameters = card.parameters()
        try:
            card.require_usable()
        except ResultsError as error:
            file.write(f"# K left out: {error}\n")
            del parameters["K"]
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("name", "value", "error", "unit"))
        for name, fitted in parameters.items():
            writer.writerow((name, repr(fitted.value), repr(fitted.error), UNITS[name]))


def _known(card: SoilCard, value: float, name: str) -> float:
    if not math.isfinite(value):
        raise ResultsError(f"{card.title}: has no {name}, which the file needs; write '{name}: ...' into the card")
    return value


EXPORTS: dict[str, tuple[str, Callable[[SoilCard, Path], None]]] = {
    "chrono": ("chrono_scm.json", write_chrono),
    "altair": ("altair.rdf", write_altair),
    "table": ("card.csv", write_table),
}
