# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post empirical: what a formula says."""

import argparse
import math
from collections.abc import Callable

from ..analyse import cone_formulas, empirical
from ..arguments import at_least, between, positive
from ..errors import ResultsError

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
KINDS = {"slip": between(0.0, 1.0), "axles": at_least(1), "tyres": at_least(2)}
FLAGS = {  # option -> meaning
    "radial": "a radial tyre (brixius)",
    "manual": "manual transmission (vci)",
    "chains": "tyres with chains (vci)",
}
ON_CONE = ("cone_index", "load", "diameter", "width", "slip")
DEFLECTED = ("section_height", "deflection")
VEHICLE = ("weight", "axles", "tyres", "diameter", "width", "clearance", "power")
NEEDED = {  # method -> what it cannot do without
    "nrmm": ("load", "diameter", "width", "depth", "density", "pressure"),
    "bekker": ("load", "diameter", "width", "terrain"),
    "wong_reece": ("load", "diameter", "width", "terrain", "slip"),
    "wismer_luth": ON_CONE,
    "brixius": (*ON_CONE, *DEFLECTED),
    "gee_clough": (*ON_CONE, *DEFLECTED),
    "vti_clay": (*ON_CONE, *DEFLECTED),
    "vci": VEHICLE,
    "snow_traction": ("load", "contact_area", "surface"),
}
FURTHER = {  # method -> what it may have besides
    "nrmm": ("sinkage",),
    "brixius": ("radial",),
    "vci": (*DEFLECTED, "manual", "chains"),
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("method", choices=NEEDED)
    for name, unit in OPTIONS.items():
        parser.add_argument(f"--{name}", type=KINDS.get(name, positive), help=unit)
    terrains = "name in furrow_post/analyse/terrains.csv, e.g. 'LETE sand', or a soil card's file"
    parser.add_argument("--terrain", help=terrains)
    surface = "of snow_traction; packed: a snow road, or more than four passes"
    parser.add_argument("--surface", choices=empirical.TRACTION, help=surface)
    for name, meaning in FLAGS.items():
        parser.add_argument(f"--{name}", action="store_true", help=meaning)
    parser.add_argument(
        "--extrapolate",
        action="store_true",
        help="answer outside of the range of validity too, and say so",
    )


def run(arguments: argparse.Namespace) -> None:
    given = {name for name in (*OPTIONS, "terrain", "surface") if getattr(arguments, name) is not None}
    given |= {name for name in FLAGS if getattr(arguments, name)}
    missing = [name for name in NEEDED[arguments.method] if name not in given]
    if missing:
        options = ", ".join(f"--{name}" for name in missing)
        raise ResultsError(f"empirical {arguments.method} needs {options}")
    unread = given - {*NEEDED[arguments.method], *FURTHER.get(arguments.method, ())}
    if unread:
        options = ", ".join(f"--{name}" for name in sorted(unread))
        raise ResultsError(f"empirical {arguments.method} does not read {options}; leave it out")
    print(_report(arguments))


def _report(given: argparse.Namespace) -> str:
    outside: bool = given.extrapolate
    ground_formulas: dict[str, Callable[[], str]] = {
        "wismer_luth": lambda: cone_formulas.wismer_luth(
            given.cone_index, _tyre(given), given.slip, outside
        ).report(),
        "brixius": lambda: cone_formulas.brixius(
            given.cone_index, _tyre(given), given.slip, given.radial, outside
        ).report(),
        "gee_clough": lambda: cone_formulas.gee_clough(
            given.cone_index, _tyre(given), given.slip, outside
        ).report(),
        "vti_clay": lambda: cone_formulas.vti_clay(
            given.cone_index, _tyre(given), given.slip, outside
        ).report(),
        "vci": lambda: _vehicle_cone_index(given),
        "snow_traction": lambda: empirical.snow_traction(
            given.surface, given.load, given.contact_area
        ).report(),
    }
    if given.method in ground_formulas:
        return ground_formulas[given.method]()
    return _prediction(given).report()


def _tyre(given: argparse.Namespace) -> cone_formulas.Tyre:
    height, deflection = (
        math.nan if value is None else value for value in (given.section_height, given.deflection)
    )
    load = math.nan if given.load is None else given.load
    return cone_formulas.Tyre(load, given.diameter, given.width, height, deflection)


def _vehicle_cone_index(given: argparse.Namespace) -> str:
    vehicle = cone_formulas.WheeledVehicle(
        given.weight,
        given.axles,
        given.tyres,
        _tyre(given),
        given.clearance,
        given.power,
        given.manual,
        given.chains,
    )
    return cone_formulas.vehicle_cone_index(vehicle).report()


def _prediction(given: argparse.Namespace) -> empirical.Prediction:
    outside: bool = given.extrapolate
    if given.method == "nrmm":
        return empirical.nrmm(
            given.load,
            0.5 * given.diameter,
            given.width,
            given.depth,
            given.density,
            given.pressure,
            given.sinkage,
            outside,
        )
    ground = empirical.terrain(given.terrain)
    if given.method == "bekker":
        return empirical.bekker(given.load, given.diameter, given.width, ground, outside)
    return empirical.wong_reece(
        given.load, given.diameter, given.width, given.slip, ground, outside
    )
