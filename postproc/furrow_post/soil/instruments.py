# SPDX-License-Identifier: GPL-2.0-or-later
"""Virtual plates, shear ring and cone on a continuum, and their curves."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..uncertainty.statistics import line_fit
from ..arrays import Floats
from ..csv_table import read_matrix
from ..errors import ResultsError
from ..programs import inputs_folder
from ..read.soil_card import STANDARD_CONE
from ..run.case import Case, Value, script_case
from ..run.executor import Executor
from ..run.tools import Tools
from .fits import ConeCurve, PlateCurve, ShearCurve
from .material import Material, read_material

# Shares of the wave speed: slow enough that a faster test gives the same curve within its noise
PLATE_PACE, PRESS_PACE, CONE_PACE = 1 / 300, 1 / 400, 1 / 60
# Two speeds of the ring: the grid adds a shear stress that grows with the speed (fit_shear in fits.py)
RING_PACE, FAST_RING_PACE = 1 / 1600, 1 / 400
FASTEST = 1.0  # [m/s] 100 Pa of dynamic pressure on snow, 800 Pa on sand
RING = (0.2, 0.12)  # [m] outer and inner diameter
PRESS = 0.015  # [m] travel of a free drive in the time of pressing
# Young's modulus over the pressure under the smallest plate. Above STIFF one step of the drive changes the pressure
# of the ring by more than its load, and the ring's ground has SCALED. Sand has 20 to 100, snow 1000 to 4000
STIFF, SCALED = 500, 100
SOFTEST = 0.01  # modulus_scale of terrain/continuum
CONE_ANGLE = 30.0  # [degrees]


def card_executor(folder: Path, jobs: int = 1) -> Executor:
    """Executor of virtual tests. A test is repeated when its program, script or ground has changed."""
    return Executor(folder, Tools.found(), jobs, again=True, low_priority=False, watch=True)


def instrument_case(
    name: str, instrument: str, surroundings: Mapping[str, Path], values: Mapping[str, float]
) -> Case:
    """A script of inputs/soils/instruments; surroundings: variables that name files. @raises ResultsError"""
    inputs = inputs_folder()
    if inputs is None:
        raise ResultsError("furrow-post card needs Furrow's inputs; run it from the tree or installed")
    script = inputs / "soils" / "instruments" / f"{instrument}.lig"
    variables: dict[str, Value] = {**surroundings, **values}
    return script_case(name, script, variables, log=True)


@dataclass(frozen=True)
class Bench:
    """The ground and where its tests go."""

    path: Path  # of the material
    material: Material
    executor: Executor
    gravity: float

    @classmethod
    def of(cls, path: Path, executor: Executor, gravity: float) -> "Bench":
        return cls(path.resolve(), read_material(path), executor, gravity)

    def speed(self, pace: float) -> float:
        """[m/s]"""
        return min(pace * self.material.wave_speed, FASTEST)

    def case(self, instrument: str, name: str, values: Mapping[str, float]) -> Case:
        return instrument_case(name, instrument, {"material": self.path}, {"gravity": self.gravity, **values})


def plate_tests(bench: Bench, sizes: Sequence[float], sinkage: float, cells: int) -> list[PlateCurve]:
    """Round plates of these diameters [m]; sinkage: over the diameter."""
    cases = [
        bench.case(
            "plate",
            f"plate_{1e3 * size:.0f}mm",
            {"size": size, "sinkage": sinkage * size, "cells": cells, "speed": bench.speed(PLATE_PACE)},
        )
        for size in sizes
    ]
    return plate_curves(bench.executor, cases, sizes)


def plate_curves(executor: Executor, cases: Sequence[Case], sizes: Sequence[float]) -> list[PlateCurve]:
    """Curves of the plates of these cases, with their diameters [m]."""
    rows = [read_curve(run.folder) for run in executor.completed(cases)]
    return [PlateCurve(0.5 * size, curve[:, 1], curve[:, 3]) for size, curve in zip(sizes, rows)]


@dataclass(frozen=True)
class RingLoad:
    """One test of the ring: its mean pressure [Pa], and its speed over that of waves."""

    pressure: float
    pace: float


def ring_scale(young: float, carried: float) -> float:
    """Factor on Young's modulus [Pa] under the ring; carried: by the smallest plate [Pa]."""
    ratio = young / carried
    return 1.0 if ratio < STIFF else max(SOFTEST, SCALED / ratio)


def ring_tests(
    bench: Bench, loads: Sequence[RingLoad], turn: float, cells: int, scale: float = 1.0
) -> list[ShearCurve]:
    """The ring under several loads, its middle turned by so many metres; stresses from its force and
    torque. scale: of Young's modulus"""
    outer, inner = 0.5 * RING[0], 0.5 * RING[1]
    middle = mean_radius(outer, inner)
    slower = math.sqrt(scale)  # waves are slower by this factor
    press_speed = bench.speed(PRESS_PACE * slower)
    speeds = [bench.speed(load.pace * slower) for load in loads]
    cases = [
        bench.case(
            "shear",
            f"ring_{1e-3 * load.pressure:.3g}kPa{'_fast' if load.pace == FAST_RING_PACE else ''}",
            {
                "size": RING[0],
                "inner_size": RING[1],
                "load": load.pressure * math.pi * (outer**2 - inner**2),
                "cells": cells,
                "press_speed": press_speed,
                "press_time": PRESS / press_speed,
                "spin": speed / middle,
                "angle": turn / middle,
                "modulus_scale": scale,
            },
        )
        for load, speed in zip(loads, speeds)
    ]
    # half a cell on each side shears too
    half = 0.5 * (outer - inner) / cells
    widening = ((outer + half) ** 3 - (inner - half) ** 3) / (outer**3 - inner**3)
    curves = []
    for run, load, speed in zip(bench.executor.completed(cases), loads, speeds):
        curve = ring_curve(read_curve(run.folder), outer, inner, speed, load.pressure)
        curves.append(replace(curve, widening=widening, compacts=scale < 1))
    return curves


def mean_radius(outer: float, inner: float) -> float:
    """Mean radius of a ring, over its area [m]."""
    return 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)


def ring_curve(rows: Floats, outer: float, inner: float, speed: float, pressure: float) -> ShearCurve:
    """Shear curve from the torque, with a uniform shear stress: tau = T / (2 pi integral r^2 dr). Radii in m."""
    middle = mean_radius(outer, inner)
    turning = rows[rows[:, 5] > 0]
    tau = -turning[:, 4] / (2 / 3 * math.pi * (outer**3 - inner**3))
    curve = ShearCurve(turning[:, 5] * middle, turning[:, 3], tau, speed, pressure)
    late = curve.late()
    return replace(curve, sinking=line_fit(curve.displacement[late], turning[late, 1])[0])


def cone_test(bench: Bench, depth: float, cells: int) -> ConeCurve:
    """The cone of 30 degrees and 323 mm2, until its base is at a depth [m]."""
    values = {
        "size": STANDARD_CONE,
        "angle": CONE_ANGLE,
        "depth_of_base": depth,
        "cells": cells,
        "speed": bench.speed(CONE_PACE),
    }
    (run,) = bench.executor.completed([bench.case("cone", "cone", values)])
    return cone_curve(read_curve(run.folder), STANDARD_CONE)


def cone_curve(rows: Floats, size: float) -> ConeCurve:
    """Curve of a cone whose base has a diameter [m], from the sinkage of the tip."""
    height = 0.5 * size / math.tan(math.radians(0.5 * CONE_ANGLE))
    return ConeCurve(rows[:, 1] - height, rows[:, 3], size, CONE_ANGLE)


def read_curve(folder: Path) -> Floats:
    """Rows of step, sinkage [m], force [N], pressure [Pa], and of a ring torque [N m] and angle [rad]."""
    rows = read_matrix(folder / "curve.txt", 4)
    if len(rows) < 20 or not np.isfinite(rows).all():
        raise ResultsError(f"{folder}/curve.txt: has too few rows; remove the folder and run again")
    return rows[1:]


def carried_pressure(plates: Sequence[PlateCurve]) -> float:
    """Greatest pressure of the smallest plate behind first touch [Pa]: a ring as wide sinks little under a
    small share."""
    return float(min(plates, key=lambda curve: curve.radius).used().pressure.max())
