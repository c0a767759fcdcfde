# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress and density at depth below the track of a wheel, tyre or plate on continuum terrain.

Depths count from the undisturbed surface, distances from the lowest point of the body. Stresses are
those at the end of the run, compression positive; the weight of the ground above is subtracted from
the vertical stress. Formulas have the load of that instant, as uniform pressure on an ellipse that has
the area and the ratio of the axes of the contact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Booleans, Floats
from ..csv_table import write_rows
from ..errors import ResultsError
from ..formatting import with_error
from ..read.results import Results
from ..read.terrain import Outline, Terrain, is_half, read_terrain_fields
from ..laws.half_space import ELASTIC, SOEHNE, below_ellipse, below_point_loads
from ..uncertainty.statistics import block_mean

TOUCHING = 0.1  # of the largest surface stress: what more stress counts as contact
TOUCHING_RANGE = (0.05, 0.2)  # the same, whose areas give the error of the area
PEAK_REACH = 0.3  # of contact length and depth: how far the fit of a peak reaches
LEAST_PARTICLES = 5  # of the fit of a peak
BEHIND = (0.2, 0.65)  # of the body's length, behind the axle: where the density is taken
FAR = 0.2  # of the particles of a layer: those whose density is that before
AT_END = 0.1  # of the history: whose loads must be steady
UNSTEADY = 0.05  # of the load
CARRIED = (0.5, 2.0)  # share of the load in the uppermost particles of a body that presses steadily


@dataclass(frozen=True)
class Contact:
    """Contact with the ground at the end of a run."""

    load: float  # [N]
    fluctuation: float  # of the load at the end of the run, over its mean
    area: float  # [m2]
    area_error: float  # [m2]
    semi_axes: tuple[float, float]  # along and across the travel, of the ellipse [m]
    carried: float  # sum of the vertical stress of the uppermost particles, over the load

    @property
    def pressure(self) -> float:
        """Mean [Pa]."""
        return self.load / self.area

    def ellipse(self, depth: Floats, concentration: float, area: float | None = None) -> Floats:
        """Vertical stress by a formula [Pa]; area: another one [m2]."""
        chosen = self.area if area is None else area
        a, b = (axis * math.sqrt(chosen / self.area) for axis in self.semi_axes)
        return self.load / chosen * below_ellipse(depth, (a, b), concentration)

    def circle(self, depth: Floats) -> Floats:
        radius = math.sqrt(self.area / math.pi)
        return self.pressure * below_ellipse(depth, (radius, radius), ELASTIC)

    def ellipse_error(self, depth: Floats, concentration: float) -> Floats:
        """By the error of the area [Pa]."""
        ends = [
            self.ellipse(depth, concentration, self.area + sign * self.area_error)
            for sign in (-1, 1)
        ]
        error: Floats = 0.5 * np.abs(ends[0] - ends[1])
        return error


@dataclass(frozen=True)
class Compaction:
    """Compaction of one run, an entry for each layer of particles from above [m, Pa, kg/m3]."""

    label: str
    inflation: float  # pressure [Pa]; NaN for a rigid wheel
    contact: Contact
    depth: Floats
    distance: Floats
    place: Floats  # of the largest vertical stress, from the axle
    stress: Floats
    stress_error: Floats
    mean_stress: Floats
    mean_stress_error: Floats
    of_surface: Floats  # by Boussinesq from the stress of the uppermost particles
    density: Floats
    density_error: Floats
    density_before: Floats

    @property
    def title(self) -> str:
        inflated = "" if math.isnan(self.inflation) else f", {1e-3 * self.inflation:.0f} kPa"
        return f"{self.label}: {1e-3 * self.contact.load:.2f} kN{inflated}"


@dataclass(frozen=True)
class _Ground:
    """Particles at the end of a run; x, y: from the centre of the body [m]."""

    x: Floats
    y: Floats
    z: Floats
    level: Floats  # at which they stood [m]
    stress: Floats  # vertical, less the weight above [Pa]
    mean_stress: Floats
    density: Floats
    density_before: Floats
    track: Booleans  # those of the rows next to the middle plane


def read_compaction(folder: Path | str, label: str | None = None) -> Compaction:
    """@raises ResultsError where the run has no continuum, no body or no contact"""
    results = Results(folder)
    terrain = Terrain.read(results.folder)
    body = Outline(results.folder, terrain)
    if body.surface is None:
        raise ResultsError(
            f"{results.file}: has no surface of a wheel, tyre or plate; give the folder of a run "
            "with a history of its body that came to its end"
        )
    ground = _read_ground(results, terrain, body)
    length = float(np.ptp(body.surface.x[:, 0]))
    contact, loads = _contact(results, ground, terrain, length)
    lowest = float(body.surface.x[:, 2].min())
    travelled = float(np.ptp(results.columns["x"])) > BEHIND[1] * length
    rows = []
    for level in np.unique(ground.level[ground.track])[::-1]:
        layer = ground.track & (ground.level == level) & (np.abs(ground.x) < 0.5 * length)
        depth = terrain.level - float(level)
        reach = max(PEAK_REACH * math.hypot(contact.semi_axes[0], depth), 2.5 * terrain.spacing)
        if np.count_nonzero(layer) < LEAST_PARTICLES:
            continue
        place, stress, error = _peak(ground.x[layer], ground.stress[layer], reach)
        _, mean_stress, mean_error = _peak(ground.x[layer], ground.mean_stress[layer], reach)
        near = np.abs(ground.x[layer] - place) < reach
        distance = lowest - float(ground.z[layer][near].mean())
        density, density_error, before = _density(ground, float(level), length, travelled)
        below = distance - loads.depth
        surface = math.nan
        if below > 0:
            surface = below_point_loads(below, loads.x - place, loads.y, loads.force, ELASTIC)
        stresses = [stress, error, mean_stress, mean_error, surface]
        rows.append([depth, distance, place, *stresses, density, density_error, before])
    if not rows:
        raise ResultsError(f"{results.folder}: has no terrain below the body")
    wheel = results.styles().of_kind("wheel")
    inflation = wheel.number("pressure") if wheel and wheel.has("pressure") else math.nan
    columns = np.array(rows).T
    return Compaction(label or results.folder.resolve().name, inflation, contact, *columns)


def _read_ground(results: Results, terrain: Terrain, body: Outline) -> _Ground:
    """Half models are mirrored."""
    fields = read_terrain_fields(results.folder)
    fields.require_finite("vertical_stress", "pressure")
    vertical, pressure = fields["vertical_stress"], fields["pressure"]
    if is_half(fields["initial_position"]):
        vertical, pressure = np.tile(vertical, 2), np.tile(pressure, 2)
    level = np.round(terrain.initial_position[:, 2], 6)
    y = terrain.initial_position[:, 1] - body.centre[1]
    before = _density_before(level, np.abs(y), terrain.density)
    soil = results.styles().of_kind("terrain")
    gravity = soil.number("gravity", 0.0) if soil else 0.0
    surcharge = soil.number("surcharge", 0.0) if soil else 0.0
    weight = surcharge + gravity * _mass_above(level, before, terrain.level)
    x, lateral, z = (terrain.x - [body.centre[0], body.centre[1], 0.0]).T
    track = np.abs(y) < np.abs(y).min() + 0.5 * terrain.spacing
    return _Ground(
        x, lateral, z, level, -vertical - weight, pressure, terrain.density, before, track
    )


def _density_before(level: Floats, aside: Floats, density: Floats) -> Floats:
    """Density around each particle (n) before: median of those of its layer that stand farthest from the track."""
    levels, layer = np.unique(level, return_inverse=True)
    found = np.empty(len(levels))
    for k in range(len(levels)):
        inside = layer == k
        far = aside >= np.quantile(aside[inside], 1 - FAR)
        found[k] = np.median(density[inside & far])
    before: Floats = found[layer]
    return before


def _mass_above(level: Floats, density: Floats, top: float) -> Floats:
    """[kg/m2] of undisturbed ground above particles (n)."""
    levels, layer = np.unique(level, return_inverse=True)
    mean = np.bincount(layer, density) / np.bincount(layer)
    edges = np.append(0.5 * (levels[1:] + levels[:-1]), top)  # upper ends of the layers
    thick = np.diff(edges, prepend=2 * levels[0] - edges[0])
    mass = mean * thick
    above: Floats = (np.cumsum(mass[::-1])[::-1] - 0.5 * mass)[layer]
    return above


@dataclass(frozen=True)
class _SurfaceLoads:
    """Forces [N] of the uppermost particles, at places from the body's centre [m]."""

    x: Floats
    y: Floats
    force: Floats
    depth: float  # of their centres below the surface [m]


def _contact(
    results: Results, ground: _Ground, terrain: Terrain, length: float
) -> tuple[Contact, _SurfaceLoads]:
    top = float(ground.level.max())
    near = (ground.level == top) & (np.abs(ground.x) < 0.5 * length)
    depth = terrain.level - top
    volume = terrain.volume[near] * terrain.density[near] / ground.density_before[near]
    area = volume / (2 * depth)  # that a particle had, seen from above
    stress, x, y = ground.stress[near], ground.x[near], ground.y[near]
    load = results.columns["force_z"]
    carried = float((stress * area).sum() / load[-1]) if load[-1] > 0 else 0.0
    if not CARRIED[0] < carried < CARRIED[1]:
        raise ResultsError(
            f"{results.folder}: the stress of the uppermost particles carries {100 * carried:.0f} % of "
            f"the load; allowed: {100 * CARRIED[0]:.0f} to {100 * CARRIED[1]:.0f} %. End the run while "
            "the body presses steadily on the ground"
        )
    touching = stress > TOUCHING * stress.max()
    areas = [area[stress > share * stress.max()].sum() for share in TOUCHING_RANGE]
    found = float(area[touching].sum())
    x_contact, y_contact, weights = x[touching], y[touching], area[touching]
    middle = np.average(x_contact, weights=weights)
    moments = [np.average(v**2, weights=weights) for v in (x_contact - middle, y_contact)]
    ratio = math.sqrt(moments[0] / moments[1]) if min(moments) > 0 else 1.0
    semi_axes = math.sqrt(found / math.pi * ratio), math.sqrt(found / math.pi / ratio)
    # rows of particles at the edge, each uncertain by its place in a particle's width
    edge = 2 * math.pi * math.sqrt(0.5 * (semi_axes[0] ** 2 + semi_axes[1] ** 2)) / terrain.spacing
    area_error = math.hypot(0.5 * float(areas[0] - areas[1]), terrain.spacing**2 * math.sqrt(edge / 12))
    last = load[-max(2, int(AT_END * len(load))) :]
    contact = Contact(
        float(load[-1]),
        float(last.std() / last.mean()),
        found,
        area_error,
        semi_axes,
        carried,
    )
    return contact, _SurfaceLoads(x, y, stress * area, depth)


def _peak(x: Floats, values: Floats, reach: float) -> tuple[float, float, float]:
    """Place and value of the maximum by a parabola over the particles around it, and its error."""
    middle = x[np.argmax(values)]
    near = np.abs(x - middle) < reach
    u, v = (x[near] - middle) / reach, values[near]
    if len(u) < LEAST_PARTICLES or np.ptp(u) < 0.5:
        return float(middle), float(values.max()), math.nan
    design = np.column_stack((np.ones_like(u), u, u * u))
    fit, *_ = np.linalg.lstsq(design, v, rcond=None)
    top = float(np.clip(-0.5 * fit[1] / fit[2], -1.0, 1.0)) if fit[2] < 0 else 0.0
    at = np.array([1.0, top, top * top])
    variance = np.sum((v - design @ fit) ** 2) / (len(u) - 3)
    error = math.sqrt(variance * at @ np.linalg.inv(design.T @ design) @ at)
    return float(middle + reach * top), float(at @ fit), error


def _density(
    ground: _Ground, level: float, length: float, travelled: bool
) -> tuple[float, float, float]:
    """Below the track behind the axle, or under a body that did not travel; its standard error over
    stretches, and the density before."""
    low, high = BEHIND
    if travelled:
        place = (ground.x > -high * length) & (ground.x < -low * length)
    else:
        place = np.abs(ground.x) < 0.05 * length
    chosen = np.flatnonzero(ground.track & (ground.level == level) & place)
    if len(chosen) == 0:
        return math.nan, math.nan, math.nan
    order = chosen[np.argsort(ground.x[chosen])]
    mean, error = block_mean(ground.density[order], 4)
    return mean, error, float(ground.density_before[order].mean())


def compaction_rows(runs: Sequence[Compaction]) -> list[dict[str, object]]:
    """A row for each layer of each run."""
    rows: list[dict[str, object]] = []
    for run in runs:
        contact, z = run.contact, run.distance
        factors = (ELASTIC, *SOEHNE)
        circle = contact.circle(z)
        formulas = np.array([contact.ellipse(z, factor) for factor in factors])
        errors = np.array([contact.ellipse_error(z, factor) for factor in factors])
        names = ("boussinesq_ellipse", *(f"soehne_{factor:.0f}" for factor in SOEHNE))
        for k in range(len(z)):
            row: dict[str, object] = {
                "run": run.label,
                "load_N": f"{contact.load:.1f}",
                "inflation_kPa": "" if math.isnan(run.inflation) else f"{1e-3 * run.inflation:g}",
                "depth_m": f"{run.depth[k]:.4f}",
                "distance_m": f"{z[k]:.4f}",
                "place_m": f"{run.place[k]:.4f}",
                "vertical_stress_kPa": _kilopascals(run.stress[k]),
                "vertical_stress_error_kPa": _kilopascals(run.stress_error[k]),
                "mean_stress_kPa": _kilopascals(run.mean_stress[k]),
                "mean_stress_error_kPa": _kilopascals(run.mean_stress_error[k]),
                "boussinesq_surface_kPa": _kilopascals(run.of_surface[k]),
                "boussinesq_circle_kPa": _kilopascals(circle[k]),
            }
            for name, values, error in zip(names, formulas, errors):
                row[f"{name}_kPa"] = _kilopascals(values[k])
                row[f"{name}_error_kPa"] = _kilopascals(error[k])
            row["density_kgm3"] = f"{run.density[k]:.5g}"
            row["density_error_kgm3"] = f"{run.density_error[k]:.2g}"
            row["density_before_kgm3"] = f"{run.density_before[k]:.5g}"
            rows.append(row)
    return rows


def _kilopascals(stress: float) -> str:
    return "" if math.isnan(stress) else f"{1e-3 * stress:.4g}"


def write_compaction(runs: Sequence[Compaction], file: Path) -> None:
    write_rows(
        file,
        compaction_rows(runs),
        ["# below the track at the end of the run; furrow_post/analyse/compaction.py defines the columns"],
    )


def report(run: Compaction) -> list[str]:
    """The contact of a run, for a person."""
    contact = run.contact
    length, width = (200 * axis for axis in contact.semi_axes)
    lines = [
        run.title,
        f"  contact area {with_error(1e4 * contact.area, 1e4 * contact.area_error)} cm2, "
        f"{length:.0f} cm long, {width:.0f} cm wide, mean pressure {1e-3 * contact.pressure:.0f} kPa",
        f"  the uppermost particles carry {100 * contact.carried:.0f} % of the load",
    ]
    if contact.fluctuation > UNSTEADY:
        lines.append(
            f"  the load fluctuates by {100 * contact.fluctuation:.0f} % at the end: run longer"
        )
    return lines
