# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post map: go and no-go, pull, speed and energy of a wheel on a terrain raster."""

import argparse
import math
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ..arguments import between, path, positive
from ..arrays import Booleans, Floats
from ..errors import ResultsError
from ..surrogate.mobility import Vehicle
from ..surrogate.model import Surrogate, read_surrogate
from ..surrogate.raster import read_raster, read_slope
from ..surrogate.terrain_map import GO, NO_GO, UNCERTAIN, make_map, read_classes, write_map
from ..surrogate.terrain_map import write_mobility_table
from .output import add_assignments, add_target

CHOSEN = ("slip", "load", "slope")  # inputs that the map finds for itself


def _raster(text: str) -> tuple[str, Path]:
    name, equals, file = text.partition("=")
    if not name or not equals:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=FILE, e.g. phi=phi.tif")
    return name, path(file)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("surrogate", type=path, help="file of furrow-post surrogate")
    add("elevation", type=path, help="elevation model, any raster that GDAL reads; in metres, or with its unit in the file")
    add_target(parser, "folder to write: map.tif, map.png, mobility.csv", required=True)
    raster = "NAME=FILE, raster of a soil parameter; may be repeated"
    add("--raster", action="append", default=[], type=_raster, metavar="RASTER", help=raster)
    classes = "raster of soil classes, and a CSV with their parameters"
    add("--classes", nargs=2, type=path, metavar=("RASTER", "TABLE"), help=classes)
    add_assignments(parser, "--set", "soil parameters of all cells", default=[])
    add("--load", type=positive, help="N, weight on the wheel (default: that of the training runs)")
    add("--speed", type=positive, help="m/s, wanted (default: that of the training runs)")
    add("--power", type=positive, default=math.inf, help="W per wheel, limits speed and pull")
    sure = "probability that a go needs (default 0.95)"
    add("--confidence", type=between(0.5, 1.0), default=0.95, help=sure)


def run(arguments: argparse.Namespace) -> None:
    begin = time.perf_counter()
    surrogate = read_surrogate(arguments.surrogate)
    vehicle = _vehicle(surrogate, arguments)
    slope = read_slope(arguments.elevation)
    rasters: dict[str, Floats] = {}
    for name, file in arguments.raster:
        raster = read_raster(file)
        slope.require_same(raster, str(file))
        rasters[name] = raster.values
    constants = dict(arguments.set)
    needed = [name for name in surrogate.names if name not in CHOSEN]
    of_classes = [name for name in needed if name not in rasters and name not in constants]
    for name in (*rasters, *constants):
        if name not in needed:
            raise ResultsError(
                f"the surrogate has no soil parameter '{name}'; it has {', '.join(needed) or 'none'}"
            )
    fixed: list[tuple[Booleans | None, Mapping[str, float]]] = [(None, constants)]
    soils: dict[str, Mapping[str, float]] = {"all": constants}
    if arguments.classes:
        classes = read_raster(arguments.classes[0])
        slope.require_same(classes, str(arguments.classes[0]))
        found = read_classes(arguments.classes[1], of_classes)
        soils = {str(key): {**constants, **parameters} for key, parameters in found.items()}
        fixed = [(classes.values == int(key), parameters) for key, parameters in soils.items()]
    elif of_classes:
        raise ResultsError(
            f"no soil parameter {', '.join(of_classes)}; give it by --set NAME=NUMBER, --raster or --classes"
        )
    for parameters in soils.values():
        for name, value in parameters.items():
            surrogate.require_range(name, value)
    result = make_map(surrogate, vehicle, slope, rasters, fixed, arguments.confidence)
    files = write_map(result, slope, arguments.output)
    if not rasters:
        write_mobility_table(arguments.output / "mobility.csv", surrogate, vehicle, soils)
        files.append("mobility.csv")
    for name, value in (("go", GO), ("uncertain", UNCERTAIN), ("no-go", NO_GO)):
        print(f"{name:10} {100 * np.mean(result.verdict == value):6.1f} % of the cells")
    print("\n".join(result.notes))
    print(
        f"\n{arguments.output}: {', '.join(files)}; {slope.values.size} cells in {time.perf_counter() - begin:.1f} s"
    )


def _vehicle(surrogate: Surrogate, arguments: argparse.Namespace) -> Vehicle:
    """@raises ResultsError where the surrogate does not fit"""
    if "slip" not in surrogate.names:
        raise ResultsError("a map needs a surrogate over slip; sweep slip too")
    constants = surrogate.constants
    load, speed = arguments.load or constants.get("load"), arguments.speed or constants.get("speed")
    if load is None or speed is None:
        raise ResultsError("the surrogate has no single load and speed; give --load and --speed")
    if "load" not in surrogate.names and load != constants["load"]:
        raise ResultsError(
            f"--load {load:g}: the surrogate knows a load of {constants['load']:g} N only; sweep load too"
        )
    return Vehicle(load, speed, arguments.power)
