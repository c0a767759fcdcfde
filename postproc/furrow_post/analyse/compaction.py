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
import pandas as pd

from ..arrays import Floats
from ..csv_table import write_rows
from ..errors import ResultsError
from ..formatting import with_error
from ..read.results import Results
from ..read.terrain import Outline, Terrain, is_half, read_terrain_fields
from ..laws.half_space import ELASTIC, SOEHNE, below_ellipse, below_point_loads
from ..uncertainty.statistics import block_mean

TOUCHING = 0.1  # of the largest surface stress: what more stress counts as contact
TOUCHING_RANGE = (0.05, 0.2)  # range of TOUCHING, whose areas give the error of the area
PEAK_REACH = 0.3  # of contact length and depth: how far the fit of a peak reaches
LEAST_PARTICLES = 5  # of the fit of a peak
BEHIND = (0.2, 0.65)  # of the body's length, behind the axle: where the density is taken
FAR = 0.2  # share of a layer's particles, the farthest ones, with the initial density
AT_END = 0.1  # last share of the history, in which the loads must be steady
UNSTEADY = 0.05  # of the load
CARRIED = (0.5, 2.0)  # share of the load in the uppermost particles of a body that presses steadily
# Layers of particles below the track: depth, distance and place of the largest vertical stress, from the axle [m];
# stresses [Pa], boussinesq_surface from the stress of the uppermost particles; densities [kg/m3]
LAYERS = (
    *("depth", "distance", "place", "vertical_stress", "vertical_stress_error", "mean_stress", "mean_stress_error"),
    *("boussinesq_surface", "density", "density_error", "density_before"),
)


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
        """Mean pressure [Pa]."""
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
        """Error of ellipse() by the error of the area [Pa]."""
        less, more = (self.ellipse(depth, concentration, self.area + sign * self.area_error) for sign in (-1, 1))
        error: Floats = 0.5 * np.abs(less - more)
        return error


@dataclass(frozen=True)
class Compaction:
    """Compaction of one run. layers: a row for each layer of particles from above, with the columns LAYERS."""

    label: str
    inflation: float  # pressure [Pa]; NaN for a rigid wheel
    contact: Contact
    layers: pd.DataFrame

    @property
    def title(self) -> str:
        inflated = "" if math.isnan(self.inflation) else f", {1e-3 * self.inflation:.0f} kPa"
        return f"{self.label}: {1e-3 * self.contact.load:.2f} kN{inflated}"


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
    below = ground[ground.x.abs() < 0.5 * length]
    loads = _surface_loads(below[below.level == ground.level.max()], terrain)
    contact = _contact(results, loads, terrain.spacing)
    lowest = float(body.surface.x[:, 2].min())
    travelled = float(np.ptp(results.columns["x"])) > BEHIND[1] * length
    track = ground[ground.track]
    rows = []
    for level, layer in below[below.track].groupby("level", sort=True):
        if len(layer) < LEAST_PARTICLES:
            continue
        depth = terrain.level - level
        reach = max(PEAK_REACH * math.hypot(contact.semi_axes[0], depth), 2.5 * terrain.spacing)
        x = layer.x.to_numpy()
        place, *stress = _peak(x, layer.stress.to_numpy(), reach)
        _, *mean_stress = _peak(x, layer.mean_stress.to_numpy(), reach)
        distance = lowest - layer.z[np.abs(x - place) < reach].mean()
        z = distance - (terrain.level - ground.level.max())  # below the centres of the uppermost particles
        surface = below_point_loads(z, loads.x - place, loads.y, loads.force, ELASTIC) if z > 0 else math.nan
        density = _density(track[track.level == level], length, travelled)
        rows.append([depth, distance, place, *stress, *mean_stress, surface, *density])
    if not rows:
        raise ResultsError(f"{results.folder}: has no terrain below the body")
    wheel = results.styles().of_kind("wheel")
    inflation = wheel.number("pressure") if wheel and wheel.has("pressure") else math.nan
    layers = pd.DataFrame(rows[::-1], columns=LAYERS)
    return Compaction(label or results.folder.resolve().name, inflation, contact, layers)


def _read_ground(results: Results, terrain: Terrain, body: Outline) -> pd.DataFrame:
    """Particles at the end of a run; half models are mirrored. Columns: x, y from the centre of the body and z [m];
    level at which they stood [m]; track: in the rows next to the middle plane; stress: vertical, less the weight
    above, and mean_stress [Pa]; density, and before [kg/m3]; volume [m3]."""
    fields = read_terrain_fields(results.folder)
    fields.require_finite("vertical_stress", "pressure")
    halves = 2 if is_half(fields["initial_position"]) else 1
    x, lateral, z = (terrain.x - [body.centre[0], body.centre[1], 0.0]).T
    aside = np.abs(terrain.initial_position[:, 1] - body.centre[1])
    columns = {"x": x, "y": lateral, "z": z, "level": np.round(terrain.initial_position[:, 2], 6), "aside": aside}
    ground = pd.DataFrame({**columns, "density": terrain.density, "volume": terrain.volume})
    ground["track"] = aside < aside.min() + 0.5 * terrain.spacing
    ground["mean_stress"] = np.tile(fields["pressure"], halves)
    # particles of each layer that stand farthest from the track
    far = ground.aside >= ground.groupby("level").aside.transform("quantile", 1 - FAR)
    ground["before"] = ground.level.map(ground[far].groupby("level").density.median())
    soil = results.styles().of_kind("terrain")
    gravity, surcharge = (soil.number(name, 0.0) if soil else 0.0 for name in ("gravity", "surcharge"))
    weight = surcharge + gravity * ground.level.map(_mass_above(ground.groupby("level").before.mean(), terrain.level))
    ground["stress"] = -np.tile(fields["vertical_stress"], halves) - weight
    return ground


def _mass_above(density: pd.Series, top: float) -> pd.Series:
    """[kg/m2] of undisturbed ground above the middle of layers, from their densities by level."""
    levels = density.index.to_numpy()
    edges = np.append(0.5 * (levels[1:] + levels[:-1]), top)  # upper ends of the layers
    mass = density * np.diff(edges, prepend=2 * levels[0] - edges[0])
    return mass[::-1].cumsum()[::-1] - 0.5 * mass


def _surface_loads(top: pd.DataFrame, terrain: Terrain) -> pd.DataFrame:
    """The uppermost particles with their areas [m2] before, seen from above, and forces [N]."""
    area = top.volume * top.density / top.before / (2 * (terrain.level - top.level))
    return top.assign(area=area, force=top.stress * area)


def _contact(results: Results, loads: pd.DataFrame, spacing: float) -> Contact:
    load = results.columns["force_z"]
    carried = float(loads.force.sum() / load[-1]) if load[-1] > 0 else 0.0
    if not CARRIED[0] < carried < CARRIED[1]:
        raise ResultsError(
            f"{results.folder}: the stress of the uppermost particles carries {100 * carried:.0f} % of "
            f"the load; allowed: {100 * CARRIED[0]:.0f} to {100 * CARRIED[1]:.0f} %. End the run while "
            "the body presses steadily on the ground"
        )
    touching, wide, narrow = (loads[loads.stress > share * loads.stress.max()] for share in (TOUCHING, *TOUCHING_RANGE))
    area = float(touching.area.sum())
    along = touching.x - np.average(touching.x, weights=touching.area)
    moments = [np.average(v**2, weights=touching.area) for v in (along, touching.y)]
    ratio = math.sqrt(moments[0] / moments[1]) if min(moments) > 0 else 1.0
    semi_axes = math.sqrt(area / math.pi * ratio), math.sqrt(area / math.pi / ratio)
    # rows of particles at the edge, each uncertain by its place in a particle's width
    edge = 2 * math.pi * math.sqrt(0.5 * (semi_axes[0] ** 2 + semi_axes[1] ** 2)) / spacing
    area_error = math.hypot(0.5 * (wide.area.sum() - narrow.area.sum()), spacing**2 * math.sqrt(edge / 12))
    last = load[-max(2, int(AT_END * len(load))) :]
    return Contact(float(load[-1]), float(last.std() / last.mean()), area, area_error, semi_axes, carried)


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


def _density(layer: pd.DataFrame, length: float, travelled: bool) -> tuple[float, float, float]:
    """Density of a layer of the track behind the axle, or under a body that did not travel; its standard error over
    parts along the track, and the density before."""
    low, high = BEHIND
    chosen = layer.x.between(-high * length, -low * length, "neither") if travelled else layer.x.abs() < 0.05 * length
    behind = layer[chosen].sort_values("x")
    if behind.empty:
        return math.nan, math.nan, math.nan
    return *block_mean(behind.density.to_numpy(), 4), float(behind.before.mean())


def compaction_rows(runs: Sequence[Compaction]) -> list[dict[str, object]]:
    """A row for each layer of each run."""
    rows: list[dict[str, object]] = []
    for run in runs:
        contact, layers = run.contact, run.layers.set_index(["depth", "distance", "place"])
        z = run.layers.distance.to_numpy()
        stresses = layers.drop(columns=["density", "density_error", "density_before"])
        stresses["boussinesq_circle"] = contact.circle(z)
        for name, factor in (("boussinesq_ellipse", ELASTIC), *((f"soehne_{factor:.0f}", factor) for factor in SOEHNE)):
            stresses[name], stresses[f"{name}_error"] = contact.ellipse(z, factor), contact.ellipse_error(z, factor)
        head = {"run": run.label, "load_N": f"{contact.load:.1f}"}
        head["inflation_kPa"] = "" if math.isnan(run.inflation) else f"{1e-3 * run.inflation:g}"
        for places, values, densities in zip(stresses.index, stresses.to_dict("records"), layers.itertuples()):
            rows.append({
                **head,
                **{f"{name}_m": f"{place:.4f}" for name, place in zip(stresses.index.names, places)},
                **{f"{name}_kPa": "" if math.isnan(value) else f"{1e-3 * value:.4g}" for name, value in values.items()},
                "density_kgm3": f"{densities.density:.5g}",
                "density_error_kgm3": f"{densities.density_error:.2g}",
                "density_before_kgm3": f"{densities.density_before:.5g}",
            })  # fmt: skip
    return rows


def write_compaction(runs: Sequence[Compaction], file: Path) -> None:
    head = "# below the track at the end of the run; furrow_post/analyse/compaction.py defines the columns"
    write_rows(file, compaction_rows(runs), [head])


def report(run: Compaction) -> list[str]:
    """Lines of the report on the contact of a run."""
    contact = run.contact
    length, width = (200 * axis for axis in contact.semi_axes)
    lines = [
        run.title,
        f"  contact area {with_error(1e4 * contact.area, 1e4 * contact.area_error)} cm2, "
        f"{length:.0f} cm long, {width:.0f} cm wide, mean pressure {1e-3 * contact.pressure:.0f} kPa",
        f"  the uppermost particles carry {100 * contact.carried:.0f} % of the load",
    ]
    if contact.fluctuation > UNSTEADY:
        lines.append(f"  the load fluctuates by {100 * contact.fluctuation:.0f} % at the end: run longer")
    return lines
