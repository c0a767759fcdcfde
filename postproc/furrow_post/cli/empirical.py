# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post empirical: what a formula says."""

import argparse

from ..analyse import empirical
from ..arguments import between, positive
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
}
NEEDED = {  # method -> what it cannot do without
    "nrmm": ("load", "diameter", "width", "depth", "density", "pressure"),
    "bekker": ("load", "diameter", "width", "terrain"),
    "wong_reece": ("load", "diameter", "width", "terrain", "slip"),
}
FURTHER = {"nrmm": ("sinkage",)}  # method -> what it may have besides


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("method", choices=NEEDED)
    for name, unit in OPTIONS.items():
        kind = between(0.0, 1.0) if name == "slip" else positive
        parser.add_argument(f"--{name}", type=kind, help=unit)
    terrains = "name in furrow_post/analyse/terrains.csv, e.g. 'LETE sand'"
    parser.add_argument("--terrain", help=terrains)
    parser.add_argument(
        "--extrapolate",
        action="store_true",
        help="answer outside of the range of validity too, and say so",
    )


def run(arguments: argparse.Namespace) -> None:
    missing = [name for name in NEEDED[arguments.method] if getattr(arguments, name) is None]
    if missing:
        options = ", ".join(f"--{name}" for name in missing)
        raise ResultsError(f"empirical {arguments.method} needs {options}")
    given = {name for name in (*OPTIONS, "terrain") if getattr(arguments, name) is not None}
    unread = given - {*NEEDED[arguments.method], *FURTHER.get(arguments.method, ())}
    if unread:
        options = ", ".join(f"--{name}" for name in sorted(unread))
        raise ResultsError(f"empirical {arguments.method} does not read {options}; leave it out")
    print(_prediction(arguments).report())


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
