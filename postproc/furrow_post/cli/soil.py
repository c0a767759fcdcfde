# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-soil: material files from what is known of a soil, and soil cards of a ground."""

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from .. import __version__
from ..arguments import at_least, number, path, positive, shield_negative_numbers, words
from ..errors import ResultsError
from ..program import run_program
from ..read.soil_card import Fitted, SoilCard, markdown, read_card
from ..soil.exports import EXPORTS
from ..soil import grains
from ..soil.instruments import Bench, card_executor
from ..soil.make import CLASSES, compression, from_bekker, from_cone, from_strength, read_oedometer
from ..soil.material import OF_GRAINS, NewMaterial, find_ground
from ..soil.point import oedometer_misfit
from ..soil.testing import FULL, QUICK, cone_misfit, default_folder, make_card, make_grain_card, plate_misfit
from ..soil.units import EARTH, require_plausible

SIZES = (0.1, 0.15, 0.2)  # [m]
ROUTES = {  # option that chooses the route -> what it needs and may have besides
    "cone_index": (("soil_class",), ("density",)),
    "k_phi": (("k_c", "n", "c", "phi", "K"), ("density", "plate")),
    "c": (("phi", "density"), ("oedometer", "E")),
}
NUMBERS = {
    "c": "cohesion [Pa]",
    "phi": "friction angle [degrees]",
    "density": "[kg/m3]",
    "E": "Young's modulus of unloading [Pa]",
    "k_c": "Bekker's modulus [N/m^(n+1)]",
    "k_phi": "Bekker's modulus [N/m^(n+2)]",
    "n": "Bekker's exponent",
    "K": "shear displacement of Janosi [m]",
    "plate": "diameter of the plate whose curve the material follows, 0.15 by default [m]",
    "cone_index": "mean of the first 15 cm [Pa]",
}
EXAMPLES = """examples:
  furrow-soil make my_sand.yaml --c 500 --phi 33 --density 1600 --oedometer oedometer.csv
  furrow-soil make my_loam.yaml --k_c 5270 --k_phi 1515040 --n 0.7 --c 1720 --phi 29 --K 0.025
  furrow-soil make my_clay.yaml --cone_index 4e5 --class CL --no-check
  furrow-soil card dry_sand_smooth -o results/card --export chrono altair table
  furrow-soil card sand_cmu -o results/card_of_grains
  furrow-soil export results/card/card.yaml chrono"""


def parser() -> argparse.ArgumentParser:
    whole = argparse.ArgumentParser(
        prog="furrow-soil",
        description="Material files from data, and soil cards from virtual tests. SI units, degrees.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    whole.add_argument("--version", action="version", version=f"furrow-soil {__version__}")
    commands = whole.add_subparsers(dest="command", required=True, metavar="command")
    make = commands.add_parser("make", help="writes a material file and checks it by a virtual test")
    make.add_argument("file", type=path, help="material file to write")
    make.add_argument("--title", type=words, help="by default the name of the file")
    for name, meaning in NUMBERS.items():
        make.add_argument(f"--{name}", type=number, help=meaning)
    make.add_argument("--oedometer", type=path, help="table with the columns stress_Pa and strain")
    make.add_argument("--class", dest="soil_class", help=f"of the USCS: {', '.join(CLASSES)}")
    make.add_argument("--no-check", action="store_true", help="no virtual plate or cone")
    make.set_defaults(run=run_make)
    card = commands.add_parser("card", help="runs plates, shear ring and cone, and fits a card")
    card.add_argument("ground", type=words, help="material file, ground of grains (.lig), or the name of one of inputs/materials or inputs/laboratory/grounds")
    card.add_argument("-o", "--output", type=path, help="folder, by default results/soil_GROUND")
    card.add_argument(
        "--sizes",
        type=positive,
        nargs="+",
        help="diameters of the plates [m], by default 0.1 0.15 0.2, or 10 and 13 grains",
    )
    card.add_argument("--quick", action="store_true", help="coarse cells or one packing, and two loads: a first look")
    card.add_argument("--jobs", type=at_least(1), default=1, help="tests at a time (default: 1)")
    card.add_argument("--gravity", type=positive, default=EARTH, help="of the tests [m/s2]")
    card.add_argument("--export", nargs="+", choices=EXPORTS, default=list(EXPORTS), help="formats")
    card.set_defaults(run=run_card)
    export = commands.add_parser("export", help="writes a card for vehicle codes, next to the card")
    export.add_argument("card", type=path, help="of furrow-soil card, written by hand, or the JSON of Chrono's SCM")
    export.add_argument("formats", nargs="+", choices=EXPORTS)
    export.add_argument("--K", type=positive, help="measured shear displacement, in place of the card's [m]")
    export.set_defaults(run=run_export)
    table = commands.add_parser("table", help="prints cards as a table in Markdown")
    table.add_argument("cards", type=path, nargs="+")
    table.set_defaults(run=run_table)
    return whole


def run_card(given: argparse.Namespace) -> None:
    ground = find_ground(given.ground)
    folder = given.output or default_folder(ground)
    if given.sizes and len(set(given.sizes)) < 2:
        raise ResultsError("--sizes: k_c and k_phi need plates of two diameters or more")
    make = _grain_card if ground.suffix == OF_GRAINS else _continuum_card
    card = make(given, ground, folder)
    print(card.report())
    print(f"  card          {folder / 'card.yaml'}\n  page          {folder / 'card.html'}")


def _continuum_card(given: argparse.Namespace, ground: Path, folder: Path) -> SoilCard:
    bench = Bench.of(ground, card_executor(folder, given.jobs), given.gravity)
    folder.mkdir(parents=True, exist_ok=True)
    return make_card(bench, given.sizes or SIZES, QUICK if given.quick else FULL, given.export)


def _grain_card(given: argparse.Namespace, path: Path, folder: Path) -> SoilCard:
    ground = grains.read_ground(path)
    sizes = given.sizes or [part * ground.diameter for part in grains.SIZES]
    grains.require_sizes(sizes, ground)
    folder.mkdir(parents=True, exist_ok=True)
    bench = grains.GrainBench(ground, card_executor(folder, given.jobs), max(sizes), given.gravity)
    return make_grain_card(bench, sizes, grains.QUICK if given.quick else grains.FULL, given.export)


def run_export(given: argparse.Namespace) -> None:
    card = read_card(given.card)
    if given.K is not None:
        _, shear = card.bekker_and_shear()
        require_plausible("K", given.K)
        card = replace(card, shear=replace(shear, K=Fitted(given.K, math.nan)))
    for name in given.formats:
        file, write = EXPORTS[name]
        target = given.card.with_name(file)
        write(card, target)
        print(f"  {name:13} {target}")
    for doubt in card.doubts():
        print(f"furrow-soil: warning: {doubt}", file=sys.stderr)


def run_table(given: argparse.Namespace) -> None:
    print(markdown([read_card(card) for card in given.cards]))


def run_make(given: argparse.Namespace) -> None:
    route = next((name for name in ROUTES if getattr(given, name) is not None), None)
    if route is None:
        raise ResultsError("furrow-soil make needs --c, --k_phi or --cone_index, and what belongs to it")
    needed, further = ROUTES[route]
    every = {*NUMBERS, "oedometer", "soil_class"}
    present = {name for name in every if getattr(given, name) is not None}
    missing = [name for name in needed if name not in present]
    if missing:
        raise ResultsError(f"--{route} needs {', '.join(map(_option, missing))} as well")
    unread = sorted(present - {route, *needed, *further})
    if unread:
        raise ResultsError(
            f"--{route} does not use {', '.join(map(_option, unread))}; leave it out"
        )
    material = _material(route, given)
    given.file.parent.mkdir(parents=True, exist_ok=True)
    given.file.write_text(material.text(), encoding="utf-8")
    print(f"{given.file}: written")
    for guess in material.guesses():
        print(f"  guessed       {guess}")
    if not given.no_check:
        print(f"  check         {_check(route, given)}")


def _option(name: str) -> str:
    return "--class" if name == "soil_class" else f"--{name}"


def _material(route: str, given: argparse.Namespace) -> NewMaterial:
    title = given.title or given.file.stem
    if route == "c":
        oedometer = read_oedometer(given.oedometer) if given.oedometer else None
        return from_strength(title, given.c, given.phi, given.density, oedometer, given.E)
    if route == "k_phi":
        return from_bekker(
            title,
            given.k_c,
            given.k_phi,
            given.n,
            given.c,
            given.phi,
            given.K,
            _radius(given),
            given.density,
        )
    return from_cone(title, given.cone_index, given.soil_class, given.density)


def _radius(given: argparse.Namespace) -> float:
    diameter: float = 0.15 if given.plate is None else given.plate
    if not 0.02 <= diameter <= 2:
        raise ResultsError(f"--plate is {diameter:g} m; allowed: 0.02 to 2. Give SI units: cm over 100.")
    return 0.5 * diameter


def _check(route: str, given: argparse.Namespace) -> str:
    """A virtual test of the file, in words."""
    if route == "c":
        oedometer = read_oedometer(given.oedometer) if given.oedometer else None
        curve = compression(oedometer, given.E)
        misfit = oedometer_misfit(given.file, curve)
        of = "measured" if oedometer else "guessed"
        return f"virtual oedometer: rms {misfit:.1%} of the greatest {of} strain"
    folder = given.file.with_suffix("").with_name(f"{given.file.stem}_check")
    bench = Bench.of(given.file, card_executor(folder), EARTH)
    if route == "cone_index":
        misfit = cone_misfit(bench, given.cone_index)
        return f"virtual cone: cone index {misfit:+.0%} of the given one"
    radius = _radius(given)
    modulus, n = given.k_c / radius + given.k_phi, float(given.n)
    misfit = plate_misfit(bench, lambda z: float(modulus * z**n), radius)
    return f"virtual plate of {2e3 * radius:g} mm: pressure within a factor of {math.exp(misfit):.2f} (rms)"


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a subcommand; the result is the exit status."""
    given = shield_negative_numbers(sys.argv[1:] if arguments is None else arguments)

    def run() -> int | None:
        parsed = parser().parse_args(given)
        status: int | None = parsed.run(parsed)
        return status

    return run_program("furrow-soil", run)
