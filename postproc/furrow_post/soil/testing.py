# SPDX-License-Identifier: GPL-2.0-or-later
"""All tests of a card on one ground, and the checks of a new material."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np

from ..uncertainty.statistics import rms
from ..errors import ResultsError
from ..read.soil_card import INDEX_DEPTH, Cone, NoResult, Shear, SoilCard, write_card
from .exports import EXPORTS
from .fits import ShearCurve, cone_index, fit_plates, fit_shear
from .grain_cone import cone_notes, fit_grain_cones, widest
from .grains import NO_CONE_ON_SNOW, STICKING_LOADS, GrainBench, Packings, grain_notes, steepest
from .instruments import (
    FAST_RING_PACE,
    RING_PACE,
    Bench,
    RingLoad,
    carried_pressure,
    cone_test,
    plate_tests,
    ring_scale,
    ring_tests,
)
from .card_page import Curves, draw_card, write_page
from .material import read_contact, usual_ranges

Part = TypeVar("Part")
SINKAGE = 0.3  # of the diameter
# Ground that is soft for its modulus is snow, which compacts while it shears: loads of the ring over what the smallest
# plate carries and turn of its middle [m]. A smaller load does not press all of the ring on the ground
SOFT_LOADS, SOFT_TURN, SOFT_PACES = (0.08, 0.16, 0.32), 0.04, (1 / 800, 1 / 400)
LARGEST_GROWTH = 0.05  # of the shear stress in the second half of the turn, which a note states
SOFT_CELLS = (
    "three cells across the ring lower the shear stress by 7 to 9 % on the snow of inputs/soils; the standard errors do "
    "not have this"
)
SMALL_K = (
    "K is that of the law, which mobilises its strength at once; soils have 5 to 25 mm: for traction over "
    "slip take a measured K"
)


@dataclass(frozen=True)
class Effort:
    """Cost settings of a card. cells: across plate, ring and cone."""

    plate_cells: int
    ring_cells: int
    cone_cells: int
    loads: tuple[float, ...]  # of the ring, over what the smallest plate carries
    turn: float  # [m] of the middle of the ring
    cone_depth: float  # [m] of the base


FULL = Effort(6, 2, 3, (0.03, 0.06, 0.12), 0.003, INDEX_DEPTH)
QUICK = Effort(4, 2, 2, (0.03, 0.12), 0.003, INDEX_DEPTH)


def make_card(
    bench: Bench, sizes: Sequence[float], effort: Effort, formats: Sequence[str]
) -> SoilCard:
    """Runs plates of these diameters [m], ring and cone, and writes card.yaml, card.html, card.png
    and the exports into the folder. @raises ResultsError, Interrupted"""
    cells = effort.plate_cells
    plates = plate_tests(bench, sizes, SINKAGE, cells)
    carried = carried_pressure(plates)
    scale = ring_scale(bench.material.young, carried) if bench.material.linear else 1.0
    loads, turn, paces = effort.loads, effort.turn, (RING_PACE, FAST_RING_PACE)
    if scale < 1:
        loads, turn, paces = SOFT_LOADS, SOFT_TURN, SOFT_PACES
    across = effort.ring_cells
    slow = [RingLoad(load * carried, paces[0]) for load in loads]
    *rings, fast = ring_tests(bench, [*slow, RingLoad(loads[0] * carried, paces[1])], turn, across, scale)
    cone = cone_test(bench, effort.cone_depth, effort.cone_cells)
    material = bench.material
    shear = _result_of(lambda: fit_shear(rings, fast))
    card = SoilCard(
        f"Soil card of {material.title}",
        bench.path.name,
        material.density,
        material.punch_stiffness(0.5 * float(np.mean(sizes))),
        bench.gravity,
        _result_of(lambda: fit_plates(plates)),
        shear,
        _result_of(lambda: cone_index(cone)),
        (
            *((SMALL_K,) if isinstance(shear, Shear) and shear.K.value < usual_ranges()["K"].lower else ()),
            *_growth(rings),
            *((SOFT_CELLS,) if scale < 1 and isinstance(shear, Shear) else ()),
            f"plates {cells} cells across, ring {across}, cone {effort.cone_cells}: errors of "
            "the cells are not in the standard errors",
        ),
        contact=read_contact(bench.path),
    )
    _write(card, Curves(plates, rings, [cone]), bench.executor.results, formats)
    return card


def make_grain_card(
    bench: GrainBench, sizes: Sequence[float], effort: Packings, formats: Sequence[str]
) -> SoilCard:
    """Makes a card on beds of grains. The cone is wider than the standard one; sticking grains have none.
    @raises ResultsError, Interrupted"""
    plates = bench.plates(sizes, effort.seeds)
    carried = carried_pressure(plates)
    loads = STICKING_LOADS if bench.ground.sticks else effort.loads
    rings = bench.rings([load * carried for load in loads], effort.seeds)
    shear = _result_of(lambda: fit_shear(rings))
    cones = bench.cones(effort)
    cone: Cone | NoResult = fit_grain_cones(cones) if cones else NO_CONE_ON_SNOW
    card = SoilCard(
        f"Soil card of {bench.ground.title}",
        bench.ground.path.name,
        bench.bulk_density(effort.seeds),
        steepest(plates),
        bench.gravity,
        _result_of(lambda: fit_plates(plates)),
        shear,
        cone,
        (*_growth(rings), *grain_notes(bench, effort, sizes), *cone_notes(cones)),
    )
    _write(card, Curves(plates, rings, [cone.curve for cone in widest(cones)]), bench.executor.results, formats)
    return card


def _write(card: SoilCard, curves: Curves, folder: Path, formats: Sequence[str]) -> None:
    write_card(card, folder / "card.yaml")
    draw_card(card, curves, folder / "card.png")
    write_page(card, folder / "card.png", folder / "card.html")
    for name in formats:
        file, write = EXPORTS[name]
        try:
            write(card, folder / file)
        except ResultsError as error:
            print(f"{name}: not written: {error}")


def _result_of(fit: Callable[[], Part]) -> Part | NoResult:
    """Result of an instrument. One that failed has the reason instead."""
    try:
        return fit()
    except ResultsError as error:
        return NoResult(str(error))


def _growth(rings: Sequence[ShearCurve]) -> tuple[str, ...]:
    """A note on the ring that is furthest from a steady state."""
    curve = max(rings, key=ShearCurve.growth)
    if curve.growth() <= LARGEST_GROWTH:
        return ()
    return (
        f"ring under {float(np.mean(curve.normal)):.3g} Pa: the shear stress grows by {curve.growth():.0%} in the second "
        f"half of {1e3 * float(curve.displacement.max()):.3g} mm; c and phi hold up to there and not for a steady state",
    )


def plate_misfit(bench: Bench, pressure: Callable[[float], float], radius: float) -> float:
    """rms of ln p of a virtual plate over the pressure [Pa] that it should have at a sinkage [m]."""
    (plate,) = plate_tests(bench, [2 * radius], SINKAGE, FULL.plate_cells)
    curve = plate.used()
    wanted = np.array([pressure(z) for z in curve.sinkage])
    return rms(np.log(curve.pressure / wanted))


def cone_misfit(bench: Bench, cone_index_wanted: float) -> float:
    """Virtual over wanted cone index, less 1."""
    found = cone_index(cone_test(bench, FULL.cone_depth, FULL.cone_cells))
    return found.index.value / cone_index_wanted - 1


def default_folder(path: Path) -> Path:
    return Path("results") / f"soil_{path.stem}"
