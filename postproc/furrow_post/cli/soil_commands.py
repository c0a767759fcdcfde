# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands card, material files from what is known of a soil and soil cards of a ground, and laboratory."""

import math
import sys
from dataclasses import replace
from pathlib import Path

from ..arguments import at_least, number, path, positive
from ..errors import ResultsError
from ..figures.laboratory_figure import draw_laboratory
from ..laboratory.report import report_tests
from ..read.soil_card import EARTH, Fitted, PressureSinkage, Range, SoilCard, markdown, read_card
from ..soil.exports import EXPORTS
from ..soil import grains
from ..soil.instruments import Bench, card_executor
from ..soil.make import CLASSES, compression, from_bekker, from_cone, from_strength
from ..soil.material import OF_GRAINS, NewMaterial, find_ground, require_plausible
from ..soil.oedometer import oedometer_misfit, read_oedometer
from ..soil.testing import FULL, QUICK, cone_misfit, default_folder, make_card, make_grain_card, plate_misfit
from .parameters import Given, argument, command, flag, option, output_options, repeated, target, target_option

SIZES = (0.1, 0.15, 0.2)  # [m]
ROUND_OFF = 1e-9
ROUTES = {  # option that chooses the route -> required and optional further options
    "cone_index": (("soil_class",), ("density", "phi")),
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


@command(
    argument(
        "ground",
        "material file, ground of grains (.lig), or the name of one of inputs/materials or inputs/laboratory/grounds",
    ),
    target_option("folder, by default results/soil_GROUND"),
    repeated("--sizes", parse=positive, help="diameters of the plates [m], by default 0.1 0.15 0.2, or 10 and 13 grains"),
    flag("--quick", help="coarse cells or one packing, and two loads: a first look"),
    option("--jobs", parse=at_least(1), default=1, show_default=True, help="tests at a time"),
    option("--gravity", parse=positive, default=EARTH, show_default=True, help="of the tests [m/s2]"),
    repeated("--export", choices=EXPORTS, default=list(EXPORTS), help="formats"),
)
def card_make(given: Given) -> None:
    ground = find_ground(given.ground)
    folder = given.output or default_folder(ground)
    if given.sizes and len(set(given.sizes)) < 2:
        raise ResultsError("--sizes: k_c and k_phi need plates of two diameters or more")
    make = _grain_card if ground.suffix == OF_GRAINS else _continuum_card
    card = make(given, ground, folder)
    print(card.report())
    print(f"  card          {folder / 'card.yaml'}\n  page          {folder / 'card.html'}")


def _continuum_card(given: Given, ground: Path, folder: Path) -> SoilCard:
    bench = Bench.of(ground, card_executor(folder, given.jobs), given.gravity)
    folder.mkdir(parents=True, exist_ok=True)
    return make_card(bench, given.sizes or SIZES, QUICK if given.quick else FULL, given.export)


def _grain_card(given: Given, path: Path, folder: Path) -> SoilCard:
    ground = grains.read_ground(path)
    sizes = given.sizes or [part * ground.diameter for part in grains.SIZES]
    grains.require_sizes(sizes, ground)
    folder.mkdir(parents=True, exist_ok=True)
    bench = grains.GrainBench(ground, card_executor(folder, given.jobs), max(sizes), given.gravity)
    return make_grain_card(bench, sizes, grains.QUICK if given.quick else grains.FULL, given.export)


@command(
    argument("card", "of card make, written by hand, or the JSON of Chrono's SCM", path),
    argument("formats", f"one or more of {', '.join(EXPORTS)}", choices=EXPORTS, nargs=-1, required=True),
    option("--K", "K", parse=positive, help="measured shear displacement, in place of the card's [m]"),
)
def card_export(given: Given) -> None:
    card = read_card(given.card)
    if given.K is not None:
        _, shear = card.bekker_and_shear()
        require_plausible("K", given.K)
        card = replace(card, shear=replace(shear, K=Fitted(given.K, math.nan)))
    for name in given.formats:
        file, write = EXPORTS[name]
        exported = given.card.with_name(file)
        write(card, exported)
        print(f"  {name:13} {exported}")
    for warning in card.warnings():
        print(f"furrow-post card: warning: {warning}", file=sys.stderr)


@command(argument("cards", "files of cards", path, nargs=-1, required=True))
def card_table(given: Given) -> None:
    print(markdown([read_card(card) for card in given.cards]))


@command(
    argument("card", "of card make, of dry sand", path),
    option("--sinkage", parse=positive, help="down to which the pressure counts, by default that of the plates [m]"),
    option("--width", parse=positive, help="of the contact, by default the mean diameter of the plates [m]"),
)
def card_rft(given: Given) -> None:
    card = read_card(given.card)
    plates = card.pressure_sinkage
    if not isinstance(plates, PressureSinkage):
        raise ResultsError(f"{card.title}: has no values of the plates ({plates.reason})")
    sinkage = given.sinkage or plates.sinkage.high
    width = given.width or plates.radii.low + plates.radii.high
    of_plates = (("sinkage", sinkage, plates.sinkage), ("width", width, Range(2 * plates.radii.low, 2 * plates.radii.high)))
    for name, value, tested in of_plates:
        if not tested.low * (1 - ROUND_OFF) <= value <= tested.high * (1 + ROUND_OFF):
            raise ResultsError(
                f"--{name} is {value:g} m; allowed: {tested.low:.3g} to {tested.high:.3g} m, as the plates of {card.title} "
                f"had; make a card with plates like the contact: --sizes"
            )
    xi, deviation = plates.rft_strength(sinkage, 0.5 * width)
    print(f"  xi            {xi:.3g} N/m^3, for a sinkage to {1e3 * sinkage:.3g} mm under a width of {1e3 * width:.3g} mm")
    print(f"  deviation     the pressure over depth deviates from a line by {deviation:.1%} of its greatest value (rms)")


@command(
    argument("file", "material file to write", path),
    option("--title", help="by default the name of the file"),
    *(option(f"--{name}", name, parse=number, help=meaning) for name, meaning in NUMBERS.items()),
    option("--oedometer", parse=path, help="table of stress and strain or void ratio, units in the headings"),
    option("--class", "soil_class", parse=str, help=f"of the USCS: {', '.join(CLASSES)}"),
    flag("--no-check", help="no virtual plate or cone"),
)
def card_material(given: Given) -> None:
    route = next((name for name in ROUTES if getattr(given, name) is not None), None)
    if route is None:
        raise ResultsError("card material needs --c, --k_phi or --cone_index, and what belongs to it")
    needed, further = ROUTES[route]
    every = {*NUMBERS, "oedometer", "soil_class"}
    present = {name for name in every if getattr(given, name) is not None}
    missing = [name for name in needed if name not in present]
    if missing:
        raise ResultsError(f"--{route} needs {', '.join(map(_option, missing))} as well")
    unread = sorted(present - {route, *needed, *further})
    if unread:
        raise ResultsError(f"--{route} does not use {', '.join(map(_option, unread))}; leave it out")
    material = _material(route, given)
    given.file.parent.mkdir(parents=True, exist_ok=True)
    given.file.write_text(material.text(), encoding="utf-8")
    print(f"{given.file}: written")
    for guess in material.guesses():
        print(f"  guessed       {guess}")
    for band in material.bands:
        print(f"  band          {band}")
    if not given.no_check:
        print(f"  check         {_check(route, given)}")


def _option(name: str) -> str:
    return "--class" if name == "soil_class" else f"--{name}"


def _material(route: str, given: Given) -> NewMaterial:
    title = given.title or given.file.stem
    if route == "c":
        oedometer = read_oedometer(given.oedometer) if given.oedometer else None
        for note in oedometer.notes if oedometer else ():
            print(f"  oedometer     {note}")
        return from_strength(title, given.c, given.phi, given.density, oedometer, given.E)
    if route == "k_phi":
        return from_bekker(
            title, given.k_c, given.k_phi, given.n, given.c, given.phi, given.K, _radius(given), given.density
        )
    return from_cone(title, given.cone_index, given.soil_class, given.density, given.phi)


def _radius(given: Given) -> float:
    diameter: float = 0.15 if given.plate is None else given.plate
    if not 0.02 <= diameter <= 2:
        raise ResultsError(f"--plate is {diameter:g} m; allowed: 0.02 to 2. Give SI units: cm over 100.")
    return 0.5 * diameter


def _check(route: str, given: Given) -> str:
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


@command(
    argument("folders", "results folders of one test of inputs/laboratory", nargs=-1, required=True, metavar="RESULTS..."),
    option("--reference", parse=path, help="reference.csv of an oedometer, with columns rho_kgm3 and sigma1_Pa"),
    repeated("--point", help="results folder of furrow-point with the same path, for comparison"),
    *output_options("figure to write (default: in the first folder)"),
)
def laboratory(given: Given) -> None:
    found = report_tests(given.folders, given.reference, given.point)
    print(found.report)
    file = target(given, found.tests[0].folder, "laboratory")
    draw_laboratory(found, file)
    print(file)
