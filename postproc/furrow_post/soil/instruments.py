# SPDX-License-Identifier: GPL-2.0-or-later
"""Virtual plates, shear ring and cone on a continuum, and their curves."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..analyse.statistics import line_fit
from ..arrays import Floats
from ..csv_table import read_matrix
from ..errors import ResultsError
from ..programs import find_program, inputs_folder
from ..scene.process import Runs
from .fits import ConeCurve, PlateCurve, ShearCurve
from .material import Material, content_with_bases, read_material

# Of the wave speed: slow enough that a faster test gives the same curve within its noise
PLATE_PACE, PRESS_PACE, CONE_PACE = 1 / 300, 1 / 400, 1 / 60
# Two speeds of the ring: the grid adds a shear stress that grows with the speed (fit_shear in fits.py)
RING_PACE, FAST_RING_PACE = 1 / 1600, 1 / 400
FASTEST = 1.0  # [m/s] 100 Pa of dynamic pressure on snow, 800 Pa on sand
RING = (0.2, 0.12)  # [m] outer and inner diameter
PRESS = 0.015  # [m] that the drive would move in the time of pressing
# Young's modulus over the pressure under the smallest plate. Above STIFF one step of the drive changes the pressure
# of the ring by more than its load, and the ring's ground has SCALED. Sand has 20 to 100, snow 1000 to 4000
STIFF, SCALED = 500, 100
SOFTEST = 0.01  # modulus_scale of terrain/continuum
CONE_BASE = 0.02027  # [m] 323 mm2, ASABE S313.3
CONE_ANGLE = 30.0  # [degrees]


@dataclass(frozen=True)
class Bench:
    """The ground and where its tests go."""

    path: Path  # of the material
    material: Material
    folder: Path
    gravity: float

    @classmethod
    def of(cls, path: Path, folder: Path, gravity: float) -> "Bench":
        return cls(path, read_material(path), folder, gravity)

    def speed(self, pace: float) -> float:
        """[m/s]"""
        return min(pace * self.material.wave_speed, FASTEST)

    def run(self, instrument: str, name: str, variables: Mapping[str, float], runs: Runs) -> Path:
        """Runs a script of inputs/soils/instruments unless its results are there.

        @return folder of the results @raises ResultsError, Stopped, Failed
        """
        values = {"gravity": self.gravity, **variables}
        content = content_with_bases(self.path)
        return run_instrument(instrument, self.folder / name, {"material": self.path}, content, values, runs)


def run_instrument(
    instrument: str,
    folder: Path,
    surroundings: Mapping[str, object],
    content: str,
    values: Mapping[str, float],
    runs: Runs,
) -> Path:
    """Runs a script of inputs/soils/instruments unless its results are in the folder.

    @param surroundings  variables that name files
    @param content       of the ground: another one repeats the run
    @return the folder @raises ResultsError, Stopped, Failed
    """
    inputs = inputs_folder()
    if inputs is None:
        raise ResultsError("furrow-soil needs Furrow's inputs; run it from the tree or installed")
    script = inputs / "soils" / "instruments" / f"{instrument}.lig"
    name, folder = folder.name, folder.resolve()
    lines = [*map(str, surroundings.values()), content]
    record = "\n".join([*lines, *(f"{key} {value!r}" for key, value in values.items())])
    done = folder / "done.txt"
    if done.is_file() and done.read_text(encoding="utf-8") == record:
        return folder
    folder.mkdir(parents=True, exist_ok=True)
    done.unlink(missing_ok=True)
    command: list[object] = [find_program("furrow"), "-in", script, "-log", folder / "log.liggghts"]
    command += ["-var", "results", folder]
    for key, place in surroundings.items():
        command += ["-var", key, place]
    for key, value in values.items():
        command += ["-var", key, repr(float(value)) if isinstance(value, float) else value]
    print(f"{name} ...", flush=True)
    runs.run(command, folder, folder, f"{name}: ")
    done.write_text(record, encoding="utf-8")
    return folder


def plate_test(bench: Bench, size: float, sinkage: float, cells: int, runs: Runs) -> PlateCurve:
    """A round plate of a diameter, to a sinkage [m]."""
    variables = {
        "size": size,
        "sinkage": sinkage,
        "cells": cells,
        "speed": bench.speed(PLATE_PACE),
    }
    folder = bench.run("plate", f"plate_{1e3 * size:.0f}mm", variables, runs)
    rows = read_curve(folder)
    return PlateCurve(0.5 * size, rows[:, 1], rows[:, 3])


def ring_scale(young: float, carried: float) -> float:
    """Factor on Young's modulus [Pa] under the ring; carried: by the smallest plate [Pa]."""
    ratio = young / carried
    return 1.0 if ratio < STIFF else max(SOFTEST, SCALED / ratio)


def ring_test(
    bench: Bench, pressure: float, turn: float, cells: int, runs: Runs, pace: float, scale: float = 1.0
) -> ShearCurve:
    """The ring under a mean pressure [Pa], whose middle turns by so many metres; stresses from its
    force and torque. scale: of Young's modulus"""
    outer, inner = 0.5 * RING[0], 0.5 * RING[1]
    middle = mean_radius(outer, inner)
    slower = math.sqrt(scale)  # as waves are
    speed, press_speed = bench.speed(pace * slower), bench.speed(PRESS_PACE * slower)
    variables = {
        "size": RING[0],
        "inner_size": RING[1],
        "load": pressure * math.pi * (outer**2 - inner**2),
        "cells": cells,
        "press_speed": press_speed,
        "press_time": PRESS / press_speed,
        "spin": speed / middle,
        "angle": turn / middle,
        "modulus_scale": scale,
    }
    name = f"ring_{1e-3 * pressure:.3g}kPa{'_fast' if pace == FAST_RING_PACE else ''}"
    rows = read_curve(bench.run("shear", name, variables, runs))
    # half a cell on each side shears too
    half = 0.5 * (outer - inner) / cells
    widening = ((outer + half) ** 3 - (inner - half) ** 3) / (outer**3 - inner**3)
    return replace(ring_curve(rows, outer, inner, speed, pressure), widening=widening, compacts=scale < 1)


def mean_radius(outer: float, inner: float) -> float:
    """Of a ring, over its area [m]."""
    return 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)


def ring_curve(rows: Floats, outer: float, inner: float, speed: float, pressure: float) -> ShearCurve:
    """From the torque, which a uniform shear stress has: tau = T / (2 pi integral r^2 dr). Radii in m."""
    middle = mean_radius(outer, inner)
    turning = rows[rows[:, 5] > 0]
    tau = -turning[:, 4] / (2 / 3 * math.pi * (outer**3 - inner**3))
    curve = ShearCurve(turning[:, 5] * middle, turning[:, 3], tau, speed, pressure)
    late = curve.late()
    return replace(curve, sinking=line_fit(curve.displacement[late], turning[late, 1])[0])


def cone_test(bench: Bench, depth: float, cells: int, runs: Runs) -> ConeCurve:
    """The cone of 30 degrees and 323 mm2, until its base is at a depth [m]."""
    variables = {
        "size": CONE_BASE,
        "angle": CONE_ANGLE,
        "depth_of_base": depth,
        "cells": cells,
        "speed": bench.speed(CONE_PACE),
    }
    rows = read_curve(bench.run("cone", "cone", variables, runs))
    return cone_curve(rows, CONE_BASE)


def cone_curve(rows: Floats, size: float) -> ConeCurve:
    """Of a base with a diameter [m], from the sinkage of the tip."""
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
