# SPDX-License-Identifier: GPL-2.0-or-later
"""Plates, shear ring and cones on a bed of grains, packing by packing."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import ResultsError
from ..programs import inputs_folder
from ..read.soil_card import EARTH, NoResult
from ..run.case import Case
from ..run.executor import Executor
from ..run.script import script_variables
from .fits import PlateCurve, ShearCurve
from .grain_cone import GrainCone
from .instruments import CONE_ANGLE, cone_curve, instrument_case, mean_radius, plate_curves, read_curve, ring_curve

FEWEST_GRAINS = 10.0  # across a plate: below, single grains make the curve
SIZES = (10.0, 13.0)  # diameters of the plates, in grains
SINKAGE = 0.2  # of the diameter of a plate
RING = (18.0, 10.0)  # outer and inner diameter of the ring, in grains
GROUSER = 1.0  # height of the grousers, in grains
BARS, PARTS = 16, 4  # grousers around the ring; one part in so many of the way around is grouser
HEIGHT = 5.0  # of the ring, in grains
# On the Earth; in another gravity times and speeds keep the inertial number of the grains, so that rigid grains
# without cohesion have one curve of pressure over gravity
PRESS_TIME = 0.12  # [s] time of pressing before the ring turns
ACCELERATE_TIME = 0.02  # [s] of every instrument
PLATE_SPEED, RING_SPEED = 0.2, 0.12  # [m/s] of the middle of the ring
PRESS_SPEED = 0.2  # [m/s] of the ring without load
TURN = 2.0  # grains that the middle of the ring turns
BED_WIDTH, BED_DEPTH = 28.0, 11.0  # least of a bed, in grains
RING_BED_WIDTH = 2 * RING[0]  # in grains
WIDTH_OF_PLATE, DEPTH_OF_PLATE = 2.1, 0.8  # least width and depth of a bed over the largest plate
CONE_SPEED, CONE_FRICTION = 0.4, 0.3  # [m/s]; of steel and grains
CONE_BED = (5.0, 3.5)  # width and depth of the bed of a cone over the diameter of its base
LOADS = (0.06, 0.12, 0.24)  # of the ring, over what the smallest plate carries
STICKING_LOADS = (0.06, 0.12)  # the same on grains that stick: a larger load presses the ring into the snow
FAMILIES = ("sand", "snow_bonded")  # beds of the laboratory that have room for plates and ring
SEEDS = (86028121, 49979687)  # of the packings
FACE_FRICTION = 0.5  # of plates, ring and grains
CONTINUUM = ("terrain/continuum", "terrain/scm", "material", "cell")  # variables that a ground of grains lacks


@dataclass(frozen=True)
class GrainGround:
    """A file of inputs/laboratory/grounds, or one like it: variables of the grains and how a bed is made."""

    path: Path
    diameter: float  # [m] mean of the grains
    sticks: bool  # whether its grains stick

    @property
    def title(self) -> str:
        return f"{self.path.stem}, grains of {1e3 * self.diameter:g} mm"


@dataclass(frozen=True)
class Packings:
    """How much a card of grains costs: packings by their seeds, loads of the ring, and cones."""

    seeds: tuple[int, ...]
    loads: tuple[float, ...]
    cones: tuple[float, ...]  # diameters of their bases, in grains


FULL = Packings(SEEDS, LOADS, (4.0, 6.0, 8.0))
QUICK = Packings(SEEDS[:1], LOADS[::2], (4.0, 6.0))


def laboratory_folder() -> Path:
    """@raises ResultsError where the inputs are missing"""
    inputs = inputs_folder()
    if inputs is None or not (inputs / "laboratory" / "parts").is_dir():
        raise ResultsError("a card of grains needs inputs/laboratory; run furrow-post card from the source tree")
    return inputs / "laboratory"


def read_ground(path: Path) -> GrainGround:
    """@raises ResultsError where the file is no ground of grains"""
    _refuse_continuum(path)
    text = path.read_text(encoding="utf-8")
    named = [line.split()[3] for line in text.splitlines() if line.split()[:3] == ["variable", "family", "string"]]
    if not named or named[-1] not in FAMILIES:
        raise ResultsError(
            f"{path}: a card of grains needs the line 'variable family string NAME', NAME one of "
            f"{', '.join(FAMILIES)}; copy a file of inputs/laboratory/grounds"
        )
    value = script_variables(path, {}).defaults.get("diameter", "")
    try:
        diameter = float(value)
    except ValueError:
        diameter = 0.0
    if not 1e-4 <= diameter <= 0.5:
        raise ResultsError(f"{path}: variable diameter is '{value}'; allowed: 0.0001 to 0.5 m, of the grains")
    return GrainGround(path, diameter, named[-1] != "sand")


def _refuse_continuum(path: Path) -> None:
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        words = line.partition("#")[0].split()
        found = next((word for word in CONTINUUM if word in words), None)
        if found:
            raise ResultsError(
                f"{path}:{number}: '{found}' belongs to a continuum, and this file to grains; allowed: "
                "variables of grains, as in inputs/laboratory/grounds. For a card of a continuum name its material file"
            )


def require_sizes(sizes: Sequence[float], ground: GrainGround) -> None:
    """@raises ResultsError for a plate that is narrower than ten grains"""
    for size in sizes:
        if size < (FEWEST_GRAINS - 1e-6) * ground.diameter:
            raise ResultsError(
                f"--sizes: a plate of {size:g} m is {size / ground.diameter:.1f} grains wide; allowed: "
                f"{FEWEST_GRAINS:g} grains or more, {FEWEST_GRAINS * ground.diameter:g} m on {ground.path.name}. Below "
                "that single grains make the curve"
            )


def write_ring(path: Path, grain: float) -> None:
    """The ring as STL [m]: a plate with grousers, which stand on z = 0."""
    outer, inner = 0.5 * RING[0] * grain, 0.5 * RING[1] * grain
    top, low = HEIGHT * grain, GROUSER * grain
    count = BARS * PARTS

    def at(radius: float, k: int, z: float) -> tuple[float, float, float]:
        angle = 2 * math.pi * k / count
        return radius * math.cos(angle), radius * math.sin(angle), z

    quads = []
    for k in range(count):
        bar, n = k % PARTS == 0, k + 1
        face = 0.0 if bar else low
        quads.append((at(inner, k, top), at(outer, k, top), at(outer, n, top), at(inner, n, top)))
        quads.append((at(inner, k, face), at(inner, n, face), at(outer, n, face), at(outer, k, face)))
        for a, b in [(0.0, low)] * bar + [(low, top)]:
            quads.append((at(outer, k, a), at(outer, n, a), at(outer, n, b), at(outer, k, b)))
            quads.append((at(inner, n, a), at(inner, k, a), at(inner, k, b), at(inner, n, b)))
        if bar:
            quads.append((at(inner, k, 0), at(outer, k, 0), at(outer, k, low), at(inner, k, low)))
            quads.append((at(outer, n, 0), at(inner, n, 0), at(inner, n, low), at(outer, n, low)))
    lines = ["solid ring"]
    for first, second, third, fourth in quads:
        for corners in ((first, second, third), (first, third, fourth)):
            vertices = "".join(f"vertex {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in corners)
            lines.append(f"facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet")
    path.write_text("\n".join([*lines, "endsolid ring", ""]), encoding="utf-8")


@dataclass(frozen=True)
class GrainBench:
    """A ground of grains, the beds of its tests, and where the results go."""

    ground: GrainGround
    executor: Executor
    largest: float  # [m] plate
    gravity: float = EARTH  # [m/s2]

    @property
    def pace(self) -> float:
        """Factor on speeds from those on the Earth."""
        return math.sqrt(self.gravity / EARTH)

    def _case(self, script: str, name: str, seed: int, values: dict[str, float]) -> Case:
        grain = self.ground.diameter
        surroundings = {"ground": self.ground.path.resolve(), "laboratory": laboratory_folder()}
        width, depth = max(BED_WIDTH * grain, WIDTH_OF_PLATE * self.largest), max(BED_DEPTH * grain, DEPTH_OF_PLATE * self.largest)
        if script == "grain_ring":
            surroundings["ring"] = self.executor.results / "ring.stl"
            width = RING_BED_WIDTH * grain
        elif script == "grain_cone":
            width, depth = (part * values["size"] for part in CONE_BED)
        bed = {"width": width, "depth": depth, "face_friction": FACE_FRICTION, "gravity": self.gravity}
        bed["accelerate_time"] = ACCELERATE_TIME / self.pace
        return instrument_case(f"{name}_{seed}", script, surroundings, {"seed": seed, **bed, **values})

    def plates(self, sizes: Sequence[float], seeds: Sequence[int]) -> list[PlateCurve]:
        """Round plates of these diameters [m] on each packing."""
        speed = PLATE_SPEED * self.pace
        values = {size: {"size": size, "sinkage": SINKAGE * size, "speed": speed} for size in sizes}
        cases = [self._case("grain_plate", plate_name(size), seed, values[size]) for seed in seeds for size in sizes]
        return plate_curves(self.executor, cases, [*sizes] * len(seeds))

    def rings(self, pressures: Sequence[float], seeds: Sequence[int]) -> list[ShearCurve]:
        """The ring under these mean pressures [Pa] on each packing."""
        write_ring(self.executor.results / "ring.stl", self.ground.diameter)
        outer, inner = (0.5 * part * self.ground.diameter for part in RING)
        middle, speed = mean_radius(outer, inner), RING_SPEED * self.pace
        every = [(seed, pressure) for seed in seeds for pressure in pressures]
        cases = []
        for seed, pressure in every:
            values = {
                "load": pressure * math.pi * (outer**2 - inner**2),
                "press_speed": PRESS_SPEED * self.pace,
                "press_time": PRESS_TIME / self.pace,
                "spin": speed / middle,
                "angle": TURN * self.ground.diameter / middle,
            }
            cases.append(self._case("grain_ring", f"ring_{1e-3 * pressure:.3g}kPa", seed, values))
        rows = [read_curve(run.folder) for run in self.executor.completed(cases)]
        return [ring_curve(curve, outer, inner, speed, pressure) for (_, pressure), curve in zip(every, rows)]

    def cones(self, effort: Packings) -> list[GrainCone]:
        """Cones of several sizes on every packing, until the base is as deep as it is wide; none on
        grains that stick."""
        every = [] if self.ground.sticks else [(seed, grains) for seed in effort.seeds for grains in effort.cones]
        cases = []
        for seed, grains in every:
            size = grains * self.ground.diameter
            values = {
                "size": size,
                "angle": CONE_ANGLE,
                "depth_of_base": size,
                "speed": CONE_SPEED * self.pace,
                "face_friction": CONE_FRICTION,
            }
            cases.append(self._case("grain_cone", f"cone_{1e3 * size:.0f}mm", seed, values))
        cones = []
        for run, (_, grains) in zip(self.executor.completed(cases), every):
            size = grains * self.ground.diameter
            curve = cone_curve(read_curve(run.folder), size).down_to(size)
            cones.append(GrainCone(curve, grains, bulk_density(run.folder) * self.gravity * size))
        return cones

    def bulk_density(self, seeds: Sequence[int]) -> float:
        """Bulk density of the beds of the plates, mean [kg/m3]."""
        return float(np.mean([bulk_density(self.executor.results / f"{plate_name(self.largest)}_{seed}") for seed in seeds]))


def bulk_density(folder: Path) -> float:
    """Bulk density of the bed of a run [kg/m3]."""
    words = (folder / "facts.txt").read_text(encoding="utf-8").split()
    return float(words[words.index("bulk") + 1])


def plate_name(size: float) -> str:
    return f"plate_{1e3 * size:.0f}mm"


NO_CONE_ON_SNOW = NoResult(
    "the cone on grains is wider than the standard one, and its index is known over size only where grains do not stick"
)


def grain_notes(bench: GrainBench, effort: Packings, sizes: Sequence[float]) -> tuple[str, ...]:
    grain = bench.ground.diameter
    wide = ", ".join(f"{size / grain:.3g}" for size in sizes)
    count = len(effort.seeds)
    scatter = "their scatter is part of the errors" if count > 1 else "the scatter of packings is not in the errors"
    return (
        f"grains of {1e3 * grain:g} mm, packings: {count}; {scatter}",
        f"plates {wide} grains wide, ring {0.5 * (RING[0] - RING[1]):g} grains wide with grousers of one grain",
        "stiffness is the steepest slope of the plates, a lower bound: no plate was unloaded",
    )


def steepest(plates: Sequence[PlateCurve]) -> float:
    """Largest pressure over sinkage between points a tenth of the sinkage apart, mean of the plates [Pa/m]."""
    slopes = []
    for curve in plates:
        used = curve.used()
        step = max(used.sinkage.size // 10, 1)
        rise = used.pressure[step:] - used.pressure[:-step]
        slopes.append(float((rise / (used.sinkage[step:] - used.sinkage[:-step])).max()))
    return float(np.mean(slopes))
