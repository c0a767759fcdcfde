# SPDX-License-Identifier: GPL-2.0-or-later
"""Mobility of a wheel on a slope, from a surrogate: best pull, slip it needs, energy, speed.

A wheel of weight W on a slope alpha carries W cos(alpha) and needs the pull W sin(alpha) to climb at
constant speed. It can where its largest net traction coefficient is at least tan(alpha). It then has
the smallest slip i at which pull and need are equal. Energy per distance is T/(r (1 - i)) with the
torque T and the radius r. With the power P the speed is limited to P over this energy.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates
from scipy.special import ndtr

from ..arrays import Booleans, Floats
from ..errors import ResultsError
from .model import Surrogate
from .training import HUB_DROP, PULL, TORQUE

SLIPS = 41  # scanned between the ends of the training range
CHUNK = 20_000  # points of the surrogate at a time
NODES = (9, 17, 33, 65, 129, 257)  # of the table along each axis, until its error is small
MOST_NODES = 20_000
PROBES = 400  # cells at which the table is compared with the surrogate
TOLERANCE = {"best": 0.2, "energy": 0.02, "slip": 0.02, "drop": 0.02}  # rms; "best": in deviations


@dataclass(frozen=True)
class Vehicle:
    """One wheel; power: infinite without a limit."""

    load: float  # [N], weight on the wheel on level ground
    speed: float  # [m/s], wanted
    power: float = math.inf  # [W]


UNITS = {  # of the mobility of a cell
    "probability": "",  # probability that the wheel climbs
    "pull": "N",  # pull that remains at the wanted speed; 0 if the wheel does not climb
    "energy": "J/m",  # NaN where it does not climb, as all below
    "speed": "m/s",
    "slip": "",
    "hub_drop": "m",
}


def evaluate(
    surrogate: Surrogate, vehicle: Vehicle, ground: Mapping[str, Floats], shift: float = 0.0
) -> dict[str, Floats]:
    """Smooth fields over cells. ground: "slope" in degrees and all inputs but slip and load.

    Where the wheel does not climb, slip, energy and sinkage are those of the best pull. shift: of the pull, in its
    standard deviations.
    """
    some = CHUNK // SLIPS
    starts = range(0, len(ground["slope"]), some)
    chunks = ({name: values[k : k + some] for name, values in ground.items()} for k in starts)
    parts = [_evaluate(surrogate, vehicle, chunk, shift) for chunk in chunks]
    return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}


def _evaluate(
    surrogate: Surrogate, vehicle: Vehicle, ground: Mapping[str, Floats], shift: float
) -> dict[str, Floats]:
    slip_range = surrogate.inputs[surrogate.names.index("slip")]
    slip = np.linspace(slip_range.low, slip_range.high, SLIPS)
    tilt = np.radians(ground["slope"])
    load = vehicle.load * np.cos(tilt)
    # the rig tilts the load of a surrogate over slopes
    known = {**ground, "load": np.full_like(load, vehicle.load) if "slope" in surrogate.names else load}
    values = {name: known[name][:, None] for name in surrogate.names if name != "slip"}
    x = surrogate.scaled({**values, "slip": slip[None, :]})
    flat = x.reshape(-1, x.shape[-1])
    traction, torque = (
        surrogate.processes[name].mean_at(flat).reshape(x.shape[:2]) for name in (PULL, TORQUE)
    )
    if shift:
        traction = traction + shift * surrogate.processes[PULL].predict(flat)[1].reshape(x.shape[:2])
    rows = np.arange(len(x))
    peak = np.argmax(traction, axis=1)
    best = traction[rows, peak]
    deviation = surrogate.processes[PULL].predict(x[rows, peak])[1]
    # The slip at which the pull first reaches the need, between two scanned ones
    need = np.minimum(np.tan(tilt), best)
    above = np.argmax(traction >= need[:, None], axis=1)
    below = np.maximum(above - 1, 0)
    rise = traction[rows, above] - traction[rows, below]
    share = np.where(above > 0, (need - traction[rows, below]) / np.where(rise > 0, rise, 1.0), 0.0)

    def at(of: Floats) -> Floats:
        found: Floats = of[rows, below] + share * (of[rows, above] - of[rows, below])
        return found

    running = slip[below] + share * (slip[above] - slip[below])
    operating = x[rows, below] + share[:, None] * (x[rows, above] - x[rows, below])
    # Pull that the power allows: torque times spin rate at the wanted speed
    power = load[:, None] * torque * vehicle.speed * _rim_over_speed(slip)
    usable = np.where(power <= vehicle.power, traction, -np.inf).max(axis=1)
    return {
        "best": best,
        "deviation": deviation,
        "pull": np.maximum(usable, traction.min(axis=1)),
        "slip": running,
        "energy": at(torque) * _rim_over_speed(running),
        "drop": surrogate.processes[HUB_DROP].mean_at(operating),
    }


def inside_ranges(surrogate: Surrogate, vehicle: Vehicle, ground: Mapping[str, Floats]) -> Booleans:
    """True where all inputs but the slip lie in the training ranges."""
    loads = vehicle.load * np.cos(np.radians(ground["slope"]))
    given = dict(ground)
    if "slope" not in surrogate.names:
        given["load"] = loads
        del given["slope"]
    inside = np.ones(loads.shape, bool)
    with np.errstate(invalid="ignore"):
        for name in set(given) & set(surrogate.names):
            inside &= surrogate.inside(name, given[name])
    return inside


def _rim_over_speed(slip: Floats) -> Floats:
    """v_rim/v of a slip (v_rim - v)/max(|v_rim|, |v|)."""
    return np.where(slip >= 0, 1 / (1 - np.clip(slip, 0, 1)), 1 + np.minimum(slip, 0))


def mobility_of(fields: Mapping[str, Floats], vehicle: Vehicle, slope: Floats) -> dict[str, Floats]:
    """Mobility of each cell, by the names of UNITS. slope [degrees]"""
    tilt = np.radians(slope)
    load, need = vehicle.load * np.cos(tilt), np.tan(tilt)
    climbs = fields["best"] >= need
    energy = np.maximum(load * fields["energy"], 0.0)
    with np.errstate(divide="ignore"):
        speed = np.minimum(vehicle.speed, vehicle.power / energy)
    moving = {"energy": energy, "speed": speed, "slip": fields["slip"], "hub_drop": fields["drop"]}
    return {
        "probability": ndtr((fields["best"] - need) / fields["deviation"]),
        "pull": np.where(climbs, np.maximum(load * (fields["pull"] - need), 0.0), 0.0),
        **{name: np.where(climbs, values, np.nan) for name, values in moving.items()},
    }


@dataclass(frozen=True)
class MobilityTable:
    """The fields on a grid over those quantities that differ between cells."""

    axes: Mapping[str, tuple[float, float]]
    nodes: int  # along each axis
    fields: Mapping[str, Floats]
    errors: Mapping[str, float]  # rms, relative; "best": over its standard deviation

    def at(self, ground: Mapping[str, Floats]) -> dict[str, Floats]:
        places = [
            (ground[name] - low) / (high - low) * (self.nodes - 1)
            for name, (low, high) in self.axes.items()
        ]
        return {
            name: map_coordinates(values, places, order=1, mode="nearest")
            for name, values in self.fields.items()
        }


def tabulate(surrogate: Surrogate, vehicle: Vehicle, ground: Mapping[str, Floats]) -> MobilityTable:
    """A table for cells, refined until its errors at some of them are within TOLERANCE.

    @raises ResultsError where they stay above
    """
    axes = {
        name: (float(values.min()), float(values.max()))
        for name, values in ground.items()
        if np.ptp(values) > 0
    }
    axes = axes or {"slope": (float(ground["slope"][0]), float(ground["slope"][0]) + 1e-6)}
    probes = np.random.default_rng(0).integers(0, len(ground["slope"]), PROBES)
    some = {name: values[probes] for name, values in ground.items()}
    exact = evaluate(surrogate, vehicle, some)
    for nodes in NODES:
        if nodes ** len(axes) > MOST_NODES and nodes > NODES[0]:
            break
        lines = [np.linspace(low, high, nodes) for low, high in axes.values()]
        grid = dict(zip(axes, (line.ravel() for line in np.meshgrid(*lines, indexing="ij"))))
        rest = {name: np.full(nodes ** len(axes), values[0]) for name, values in ground.items()}
        found = evaluate(surrogate, vehicle, {**rest, **grid})
        fields = {name: values.reshape([nodes] * len(axes)) for name, values in found.items()}
        errors = _errors(MobilityTable(axes, nodes, fields, {}).at(some), exact, some)
        if all(errors[name] <= TOLERANCE[name] for name in TOLERANCE):
            return MobilityTable(axes, nodes, fields, errors)
    worst = max(errors, key=lambda name: errors[name] / TOLERANCE[name])
    raise ResultsError(
        f"the table over {', '.join(axes)} has an interpolation error of {errors[worst]:.2g} in '{worst}', "
        f"not below {TOLERANCE[worst]:g}; give fewer rasters of soil parameters, or classes"
    )


def _errors(
    found: Mapping[str, Floats], exact: Mapping[str, Floats], ground: Mapping[str, Floats]
) -> dict[str, float]:
    """Slip, energy and sinkage where the wheel climbs."""
    climbs = exact["best"] >= np.tan(np.radians(ground["slope"]))

    def rms(name: str, scale: Floats | float, where: Booleans) -> float:
        squares = ((found[name] - exact[name]) / scale)[where] ** 2
        return float(np.sqrt(np.mean(squares))) if len(squares) else 0.0

    sizes = {name: float(np.mean(np.abs(exact[name]))) for name in ("energy", "drop")}
    return {
        "best": rms("best", exact["deviation"], np.ones_like(climbs)),
        "slip": rms("slip", 1.0, climbs),
        **{name: rms(name, size, climbs) for name, size in sizes.items()},
    }
