# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post map: go and no-go, pull, speed and energy of a wheel on a terrain raster."""

import math
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ..arguments import WrongText, between, path, positive
from ..arrays import Booleans, Floats
from ..errors import ResultsError
from ..surrogate.mobility import Vehicle
from ..surrogate.model import Surrogate, read_surrogate
from ..surrogate.raster import read_raster, read_slope
from ..surrogate.terrain_map import GO, NO_GO, UNCERTAIN, make_map, read_classes, write_map
from ..surrogate.terrain_map import write_mobility_table
from .parameters import Given, argument, assignments, command, option, repeated, target_option

CHOSEN = ("slip", "load", "slope")  # inputs that the map finds for itself


def _raster(text: str) -> tuple[str, Path]:
    name, equals, file = text.partition("=")
    if not name or not equals:
        raise WrongText(f"'{text}' is not NAME=FILE, e.g. phi=phi.tif")
    return name, path(file)


@command(
    argument("surrogate", "file of furrow-post surrogate", path),
    argument("elevation", "elevation model, any raster that GDAL reads; in metres, or with its unit in the file", path),
    target_option("folder to write: map.tif, map.png, mobility.csv", required=True),
    repeated("--raster", parse=_raster, metavar="NAME=FILE", help="raster of a soil parameter; may be repeated"),
    option("--classes", nargs=2, parse=path, metavar="RASTER TABLE", help="raster of soil classes, and a CSV with their parameters"),
    assignments("--set", "soil parameters of all cells"),
    option("--load", parse=positive, help="N, weight on the wheel (default: that of the training runs)"),
    option("--speed", parse=positive, help="m/s, wanted (default: that of the training runs)"),
    option("--power", parse=positive, default=math.inf, help="W per wheel, limits speed and pull"),
    option("--confidence", parse=between(0.5, 1.0), default=0.95, help="probability that a go needs (default 0.95)"),
)
def map_(given: Given) -> None:
    begin = time.perf_counter()
    surrogate = read_surrogate(given.surrogate)
    vehicle = _vehicle(surrogate, given)
    slope = read_slope(given.elevation)
    rasters: dict[str, Floats] = {}
    for name, file in given.raster:
        raster = read_raster(file)
        slope.require_same(raster, str(file))
        rasters[name] = raster.values
    constants = dict(given.set)
    needed = [name for name in surrogate.names if name not in CHOSEN]
    of_classes = [name for name in needed if name not in rasters and name not in constants]
    for name in (*rasters, *constants):
        if name not in needed:
            raise ResultsError(
                f"the surrogate has no soil parameter '{name}'; it has {', '.join(needed) or 'none'}"
            )
    fixed: list[tuple[Booleans | None, Mapping[str, float]]] = [(None, constants)]
    soils: dict[str, Mapping[str, float]] = {"all": constants}
    if given.classes:
        classes = read_raster(given.classes[0])
        slope.require_same(classes, str(given.classes[0]))
        found = read_classes(given.classes[1], of_classes)
        soils = {str(key): {**constants, **parameters} for key, parameters in found.items()}
        fixed = [(classes.values == int(key), parameters) for key, parameters in soils.items()]
    elif of_classes:
        raise ResultsError(
            f"no soil parameter {', '.join(of_classes)}; give it by --set NAME=NUMBER, --raster or --classes"
        )
    for parameters in soils.values():
        for name, value in parameters.items():
            surrogate.require_range(name, value)
    result = make_map(surrogate, vehicle, slope, rasters, fixed, given.confidence)
    files = write_map(result, slope, given.output)
    if not rasters:
        write_mobility_table(given.output / "mobility.csv", surrogate, vehicle, soils)
        files.append("mobility.csv")
    for name, value in (("go", GO), ("uncertain", UNCERTAIN), ("no-go", NO_GO)):
        print(f"{name:10} {100 * np.mean(result.verdict == value):6.1f} % of the cells")
    print("\n".join(result.notes))
    print(
        f"\n{given.output}: {', '.join(files)}; {slope.values.size} cells in {time.perf_counter() - begin:.1f} s"
    )


def _vehicle(surrogate: Surrogate, given: Given) -> Vehicle:
    """@raises ResultsError where the surrogate does not fit"""
    if "slip" not in surrogate.names:
        raise ResultsError("a map needs a surrogate over slip; sweep slip too")
    constants = surrogate.constants
    load, speed = given.load or constants.get("load"), given.speed or constants.get("speed")
    if load is None or speed is None:
        raise ResultsError("the surrogate has no single load and speed; give --load and --speed")
    if "load" not in surrogate.names and load != constants.get("load"):
        known = f"a load of {constants['load']:g} N only" if "load" in constants else "loads that follow another input"
        raise ResultsError(f"--load {load:g}: the surrogate knows {known}; sweep load too")
    return Vehicle(load, speed, given.power)
