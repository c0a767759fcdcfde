# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post empirical: what a formula says."""

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from ..laws import cone_formulas, empirical
from ..laws.prediction import Prediction
from ..laws.terrain_values import CARD, TerrainValues, terrain, terrain_of_card, with_stress_place
from ..arguments import at_least, between, number, positive
from ..errors import ResultsError
from ..read.soil_card import read_card
from ..soil.material import require_plausible
from .parameters import Given, argument, command, flag, option

OPTIONS = {  # option -> unit and meaning
    "load": "N",
    "diameter": "m",
    "width": "m",
    "depth": "m, of the snow",
    "density": "kg/m3, of the snow",
    "pressure": "Pa, largest contact pressure on snow",
    "sinkage": "m, measured, instead of NRMM's own",
    "slip": "1 - v/(r omega), of a driven wheel",
    "cone_index": "Pa, mean of the first 15 cm; for vti_clay the rating cone index",
    "contact_area": "m2, of the wheel on hard ground",
    "section_height": "m, of the tyre",
    "deflection": "m, of the tyre on hard ground",
    "weight": "N, of the vehicle",
    "axles": "of the vehicle, all driven",
    "tyres": "of the vehicle",
    "clearance": "m, of the vehicle",
    "power": "W, of the engine",
}
GROUND = {  # option -> unit and meaning; alone or in place of a value of --terrain
    "k_c": "N/m^(n+1), Bekker; 0 by default",
    "k_phi": "N/m^(n+2), Bekker",
    "n": "Bekker's exponent",
    "c": "Pa, cohesion",
    "phi": "degrees, friction angle",
    "K": "m, shear displacement of Janosi",
    "c1": "place of the greatest stress, (c1 + c2 slip) of the entry angle",
    "c2": "the same",
}
KINDS = {"slip": between(0.0, 1.0), "axles": at_least(1), "tyres": at_least(2)}
FLAGS = {  # option -> meaning
    "radial": "a radial tyre (brixius, by_cone_index)",
    "manual": "manual transmission (vci)",
    "chains": "tyres with chains (vci)",
}
ON_CONE = ("cone_index", "load", "diameter", "width", "slip")
DEFLECTED = ("section_height", "deflection")
VEHICLE = ("weight", "axles", "tyres", "diameter", "width", "clearance", "power")


class Method(NamedTuple):
    """Formula of the command line: required options, further options, and a function for its text."""

    needed: tuple[str, ...]
    further: tuple[str, ...]
    answer: Callable[[Given], str]


def _tyre(g: Given) -> cone_formulas.Tyre:
    sizes = (g.load, g.diameter, g.width, g.section_height, g.deflection)
    return cone_formulas.Tyre(*(math.nan if size is None else size for size in sizes), radial=g.radial)


def _nrmm(g: Given) -> str:
    wheel = (g.load, 0.5 * g.diameter, g.width)
    return empirical.nrmm(*wheel, g.depth, g.density, g.pressure, g.sinkage, g.extrapolate).report()


def _ground(g: Given) -> TerrainValues:
    """Ground of --terrain, of the options, or of both. @raises ResultsError"""
    given = {name: value for name in GROUND if (value := getattr(g, name)) is not None}
    soil_law = given.keys() & {"k_c", "k_phi", "n"}
    for name, value in given.items():
        if name not in ("c1", "c2"):
            require_plausible("Bekker's n" if name == "n" else name, value)
    if g.terrain:
        ground = terrain_of_card(Path(g.terrain)) if g.terrain.endswith(CARD) else terrain(g.terrain)
    else:
        ground = TerrainValues("the options", "given", "bekker", 0.0, *(math.nan,) * 7)
    modulus = {"k_1": given.pop("k_c", ground.k_1), "k_2": given.pop("k_phi", ground.k_2)}
    if ground.pressure != "bekker" and soil_law:
        raise ResultsError(f"'{ground.name}' has the law of Reece; give --k_phi and --n without --terrain")
    ground = replace(ground, **modulus, **given)
    needed = {"k_2": "k_phi", "n": "n"} | ({name: name for name in ("c", "phi", "K")} if g.method == "wong_reece" else {})
    lacking = [f"--{option}" for name, option in needed.items() if math.isnan(getattr(ground, name))]
    if lacking and not g.terrain:
        raise ResultsError(f"empirical {g.method} needs --terrain, or {', '.join(lacking)} as well")
    known = g.method != "wong_reece" or (g.terrain and not g.terrain.endswith(CARD))
    return ground if known else with_stress_place(ground)


def _report(prediction: Prediction, ground: TerrainValues) -> str:
    lines = [prediction.report(), f"  ground       {ground.report()}"]
    return "\n".join([*lines, *(f"  assumed      {value}" for value in ground.assumed)])


def _bekker(g: Given) -> str:
    ground = _ground(g)
    return _report(empirical.bekker(g.load, g.diameter, g.width, ground, g.extrapolate), ground)


def _wong_reece(g: Given) -> str:
    ground = _ground(g)
    return _report(empirical.wong_reece(g.load, g.diameter, g.width, g.slip, ground, g.extrapolate), ground)


def _vehicle_cone_index(g: Given) -> str:
    vehicle = (g.weight, g.axles, g.tyres, _tyre(g), g.clearance, g.power, g.manual, g.chains)
    return cone_formulas.vehicle_cone_index(cone_formulas.WheeledVehicle(*vehicle)).report()


def _by_cone_index(g: Given) -> str:
    return cone_formulas.formulas_for(g.soil, g.cone_index, _tyre(g), g.slip).report()


def _on_cone(formula: cone_formulas.ConeFormula) -> Callable[[Given], str]:
    return lambda g: str(formula(g.cone_index, _tyre(g), g.slip, g.extrapolate).report())


def _snow_traction(g: Given) -> str:
    return empirical.snow_traction(g.surface, g.load, g.contact_area).report()


WHEEL = ("load", "diameter", "width")
METHODS = {
    "nrmm": Method((*WHEEL, "depth", "density", "pressure"), ("sinkage",), _nrmm),
    "bekker": Method(WHEEL, ("terrain", "k_c", "k_phi", "n"), _bekker),
    "wong_reece": Method((*WHEEL, "slip"), ("terrain", *GROUND), _wong_reece),
    "wismer_luth": Method(ON_CONE, (), _on_cone(cone_formulas.wismer_luth)),
    "brixius": Method((*ON_CONE, *DEFLECTED), ("radial",), _on_cone(cone_formulas.brixius)),
    "gee_clough": Method((*ON_CONE, *DEFLECTED), (), _on_cone(cone_formulas.gee_clough)),
    "vti_clay": Method((*ON_CONE, *DEFLECTED), (), _on_cone(cone_formulas.vti_clay)),
    "drove_sand": Method((*ON_CONE, *DEFLECTED), (), _on_cone(cone_formulas.drove_sand)),
    "maclaurin": Method((*ON_CONE, *DEFLECTED), (), _on_cone(cone_formulas.maclaurin)),
    "by_cone_index": Method((*ON_CONE, *DEFLECTED, "soil"), ("radial",), _by_cone_index),
    "vci": Method(VEHICLE, (*DEFLECTED, "manual", "chains"), _vehicle_cone_index),
    "snow_traction": Method(("load", "contact_area", "surface"), (), _snow_traction),
}


@command(
    argument("method", ", ".join(METHODS), choices=METHODS),
    *(option(f"--{name}", name, parse=KINDS.get(name, positive), help=unit) for name, unit in OPTIONS.items()),
    *(option(f"--{name}", name, parse=number, help=unit) for name, unit in GROUND.items()),
    option(
        "--terrain",
        help="name in furrow_post/laws/terrains.csv, e.g. 'LETE sand', or a soil card's file (YAML, or Chrono's JSON)",
    ),
    option(
        "--surface",
        choices=empirical.TRACTION,
        help="of snow_traction; packed: a snow road, or more than four passes",
    ),
    option("--soil", choices=["sand", "clay"], help="of by_cone_index, which prints all formulas of this soil with their band"),
    *(flag(f"--{name}", help=meaning) for name, meaning in FLAGS.items()),
    flag("--extrapolate", help="answer outside of the range of validity too, and report it"),
)
def empirical_(given: Given) -> None:
    method = METHODS[given.method]
    names = {name for name in (*OPTIONS, *GROUND, "terrain", "surface", "soil") if getattr(given, name) is not None}
    names |= {name for name in FLAGS if getattr(given, name)}
    missing = [f"--{name}" for name in method.needed if name not in names]
    if missing:
        raise ResultsError(f"empirical {given.method} needs {', '.join(missing)}")
    unread = sorted(f"--{name}" for name in names - {*method.needed, *method.further})
    if unread:
        raise ResultsError(f"empirical {given.method} does not read {', '.join(unread)}; leave it out")
    print(method.answer(given))
    if given.terrain and given.terrain.endswith(CARD):
        print(f"  the card {read_card(given.terrain).condition()}")
