# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of the continuum at the end of a run: ruts, layers, zones of stress and flow."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..analyse.evaluations import whole_plate_curve
from ..laws.half_space import ELASTIC, below_point_loads
from ..analyse.rut import bow_wave, displacements, rut_densities, rut_depth, share_left
from ..uncertainty.statistics import block_mean, place_of_greatest
from ..arrays import Booleans, Floats
from ..laboratory.deposit import outer_radius, slope_angle
from ..read.results import MIRROR, Results
from ..read.terrain import Outline, Terrain, TerrainStress, is_half, read_terrain_fields
from ..run.executor import Run
from .frames import Row
from .wheel_measures import last_part


def rut(run: Run) -> Row:
    """Densities under the wheel, next to it and behind; depth of the rut; share of the mass left; bow wave."""
    terrain = Terrain.read(run.folder)
    body = Outline(run.folder, terrain)
    return {
        **vars(rut_densities(terrain, body)),
        "rut_depth": rut_depth(terrain, body),
        "mass_left": share_left(terrain, body),
        "bow_wave": bow_wave(terrain, body),
    }


def moved(run: Run) -> Row:
    """Displacements where the finished rut is [m]: names of Displacements in rut.py."""
    terrain = Terrain.read(run.folder)
    return dict(vars(displacements(terrain, Outline(run.folder, terrain))))


def deviator_below_wheel(run: Run, within: float, greatest: int) -> Row:
    """q, the largest deviatoric stress in the middle plane near the axle [Pa], and where it is greatest ahead of the
    axle [m] in the middle layer and in the lowest. within: [m] to both sides; greatest: particles whose mean place
    counts."""
    terrain, stress = Terrain.read(run.folder), TerrainStress.read(run.folder)
    body = Outline(run.folder, terrain)
    assert body.surface
    x, z = terrain.x[:, 0] - body.centre[0], terrain.x[:, 2]
    near = (np.abs(terrain.x[:, 1]) < terrain.spacing) & (np.abs(x) < within)
    near &= z < body.surface.x[:, 2].min()
    layers = terrain.levels(near)
    found: Row = {"q": float(stress.mises[near].max())}
    for name, level in (("middle", layers[len(layers) // 2]), ("base", layers[0])):
        layer = near & terrain.at_level(level)
        found[f"q_{name}_ahead"] = place_of_greatest(x[layer], stress.mises[layer], greatest)
    return found


def below_plate(run: Run, radius: float, depth: float, layers: int, under: float, beside: Sequence[float]) -> Row:
    """layers: densities below a round plate, from its face to the base; density beside it; how far the snow below its
    edge moved outwards [m]. under: share of the radius; beside: [m] from the edge."""
    snow, curve = Terrain.read(run.folder), whole_plate_curve(run.folder)
    r, before = (np.hypot(x[:, 0], x[:, 1]) for x in (snow.x, snow.initial_position))
    z, plate = snow.x[:, 2], snow.level - float(curve[:, 1].max())
    edges = np.linspace(plate, snow.level - depth, layers + 1)
    edge = (before < radius) & (before > under * radius)
    inside = [(r < under * radius) & (z < high) & (z > low) for high, low in zip(edges[:-1], edges[1:])]
    return {
        "layers": np.array([snow.mean_density(one) for one in inside]),
        "beside": snow.mean_density((r > radius + beside[0]) & (r < radius + beside[1])),
        "greatest": float(snow.density.max()),
        "moved_out": float(np.mean(r[edge] - before[edge])),
    }


def deposit(run: Run, radius: float, layer: float, reach: float, ring: float, thin: float) -> Row:
    """Deposit of a column of this radius that fell on a layer: runout, from its edge to where the deposit is as thin
    as given [m]; top, height of its middle above the layer [m]; slope [degrees]. reach, ring: radius and width of the
    profile's rings [m]."""
    terrain = Terrain.read(run.folder)
    edges = np.arange(0.0, reach, ring)
    volume = np.histogram(np.hypot(terrain.x[:, 0], terrain.x[:, 1]), edges, weights=terrain.volume)[0]
    thickness = volume / (np.pi * np.diff(edges**2)) - layer
    return {
        "runout": outer_radius(thickness, edges, thin) - radius,
        "top": volume[:2].sum() / (np.pi * edges[2] ** 2) - layer,
        "slope": slope_angle(thickness, edges)[0],
    }


@dataclass(frozen=True)
class NearGround:
    """Particles near the axle. x: (n, 3) from the axle, z from the undisturbed level; depth_before: where they stood."""

    x: Floats
    depth_before: Floats
    volume: Floats
    chosen: Booleans  # of the terrain's particles

    @classmethod
    def read(cls, folder: Path, near: float) -> "NearGround":
        terrain = Terrain.read(folder)
        axle = float(Outline(folder, terrain).centre[0])
        x = terrain.x - np.array([axle, 0.0, terrain.level])
        chosen = np.abs(x[:, 0]) < near
        before = terrain.level - terrain.initial_position[chosen, 2]
        return cls(x[chosen], before, terrain.volume[chosen], chosen)

    def layer(self, depth: float) -> Booleans:
        """The layer of particles nearest to a depth [m]."""
        levels = np.unique(np.round(self.depth_before, 4))
        inside: Booleans = np.abs(self.depth_before - levels[np.abs(levels - depth).argmin()]) < 1e-3
        return inside


def stress_layers(
    folder: Path, near: float, depths: Sequence[float], greatest: int, under: Sequence[float], beside: Sequence[float]
) -> list[Row]:
    """Rows over depth: largest compression and shear and their places ahead of the axle; the largest principal stress, and
    the |cos| of the angle between its axis and the way from the middle of the contact, under and beside it."""
    ground, stress = NearGround.read(folder, near), TerrainStress.read(folder)
    principal = stress.principal[ground.chosen]
    tension, compression = principal[:, 0], -principal[:, 2]
    shear = 0.5 * (principal[:, 0] - principal[:, 2])
    away = np.abs((stress.tension_axis[ground.chosen] * ground.x).sum(axis=1)) / np.linalg.norm(ground.x, axis=1)
    along, across = np.abs(ground.x[:, 0]), np.abs(ground.x[:, 1])
    zones = {
        "under": (along < under[0]) & (across < under[1]),
        "beside": (along < beside[0]) & (across > beside[0]) & (across < beside[1]),
    }
    rows: list[Row] = []
    for depth in depths:
        layer = ground.layer(depth)
        row: Row = {"depth_mm": round(1e3 * float(ground.depth_before[layer].mean()))}
        for name, field in (("compression", compression), ("shear", shear)):
            row[f"{name}_kPa"] = round(float(field[layer].max()) / 1e3)
            row[f"{name}_ahead_mm"] = round(1e3 * place_of_greatest(ground.x[layer, 0], field[layer], greatest))
        for name, zone in zones.items():
            row[f"largest_{name}_kPa"] = round(float(tension[zone & layer].mean()) / 1e3, 1)
            row[f"away_{name}"] = round(float(away[zone & layer].mean()), 2)
        rows.append(row)
    return rows


def mean_of_instants(instants: Sequence[Sequence[Row]], without_error: str) -> list[Row]:
    """Mean of each quantity by depth; as NAME_error the standard error of that mean, except of names that begin so."""
    found: list[Row] = []
    for layers in zip(*instants):
        row: Row = {"depth_mm": layers[0]["depth_mm"], "instants": len(layers)}
        for name in [name for name in layers[0] if name != "depth_mm"]:
            values = np.array([float(layer[name]) for layer in layers])
            row[name] = round(float(values.mean()), 2)
            if not name.startswith(without_error):
                row[f"{name}_error"] = round(float(values.std(ddof=1) / np.sqrt(len(layers))), 2)
        found.append(row)
    return found


def stress_of_instants(run: Run, **arguments: float) -> list[Row]:
    """Mean of stress_layers over the folders instant_*."""
    folders = sorted(run.folder.glob("instant_*"))
    return mean_of_instants([stress_layers(folder, **arguments) for folder in folders], "away")  # type: ignore[arg-type]


def flow_zones(run: Run, speed: float, near: float, moving: float, middle: float) -> Row:
    """Share, place and depth of the ground that moves forward and backward in the middle plane [m]. speed: of the wheel
    [m/s]; moving: share of it that counts as moving; middle: [m] to both sides of the middle plane."""
    ground, fields = NearGround.read(run.folder, near), read_terrain_fields(run.folder)
    v = fields["v"]
    if is_half(fields["initial_position"]):
        v = np.vstack([v, v * MIRROR])
    v = v[ground.chosen] / speed
    chosen = (np.linalg.norm(v, axis=1) > moving) & (np.abs(ground.x[:, 1]) < middle)
    amount = np.where(chosen, np.abs(v[:, 0]) * ground.volume, 0.0)
    row: Row = {}
    for name, zone in (("forward", v[:, 0] > 0), ("backward", v[:, 0] < 0)):
        part = float(amount[zone].sum())
        row[f"{name}_share"] = round(part / float(amount.sum()), 3) if part > 0 else 0.0
        if part > 0:
            mean = (amount[zone, None] * ground.x[zone]).sum(axis=0) / part
            row[f"{name}_at_mm"] = round(1e3 * float(mean[0]))
            row[f"{name}_depth_mm"] = round(-1e3 * float(mean[2]))
    return row


# ---- the ground under a tyre: layers by their depth before the run


class TyreGround:
    """The computed half of the ground at the end. x: from the axle [m]; stress: vertical, compression positive [Pa];
    depth: before the run [m]."""

    def __init__(self, folder: Path) -> None:
        self.history = Results(folder).columns
        terrain = read_terrain_fields(folder)
        now, before = terrain["x"], terrain["initial_position"]
        self.x, self.y = now[:, 0] - self.history["x"][-1], now[:, 1]
        self.x_before, self.depth = before[:, 0], -before[:, 2]
        self.sunk = -1e3 * (now - before)[:, 2]  # [mm]
        self.volume, self.mises = terrain["volume"], terrain["mises"]
        self.stress, self.pressure = -terrain["vertical_stress"], terrain["pressure"]
        self.compaction = terrain["compaction"]
        self.layer_depths = np.unique(np.round(self.depth, 6))

    def layer(self, depth: float) -> tuple[Booleans, float]:
        """Particles of the layer nearest to a depth, and its depth [m]."""
        nearest = float(self.layer_depths[np.argmin(np.abs(self.layer_depths - depth))])
        return np.abs(self.depth - nearest) < 1e-5, nearest

    def distribution(self, depth: float, field: Floats, near: float) -> Row:
        """Distribution of a field in a layer near the axle: centroid [m], share of the front half, peak and its place [m]."""
        inside, _ = self.layer(depth)
        # all particles of a layer have its height
        weight = np.maximum(field[inside], 0.0) * self.volume[inside]
        x = self.x[inside]
        chosen = np.abs(x) < near
        weight, x, values = weight[chosen], x[chosen], field[inside][chosen]
        largest, total = np.argmax(values), weight.sum()
        # the axle may cut a column of particles: their weight spreads over the distance between columns
        columns, of = np.unique(np.round(x, 6), return_inverse=True)
        in_column = np.bincount(of, weight)
        behind = np.interp(0.0, columns, np.cumsum(in_column) - 0.5 * in_column)
        return {"centroid": (weight * x).sum() / total, "front": 1.0 - behind / total, "peak": values[largest], "place": x[largest]}

    def carried(self, depth: float) -> float:
        """Vertical force through a layer, of both halves [N]: in equilibrium the load less what the sides hold."""
        inside, _ = self.layer(depth)
        under = inside & (np.abs(self.x) < 0.1) & (self.y < 0.05)  # evenly divided
        spacing = np.median(np.diff(np.unique(np.round(self.x_before[under], 6))))
        thickness = np.median(self.volume[under]) / spacing**2
        return float(2 * (self.stress[inside] * self.volume[inside]).sum() / thickness)

    def reach(self, share: float) -> float:
        """Depth where the largest vertical stress is a share of that in the uppermost layer [m]."""
        depths = self.layer_depths
        peaks = np.array([self.stress[np.abs(self.depth - d) < 1e-5].max() for d in depths])
        below = np.argmax(peaks < share * peaks[0])
        ends = [below, below - 1]
        return float(np.interp(share * peaks[0], peaks[ends], depths[ends]))

    def over_boussinesq(self, depth: float) -> float:
        """Vertical stress under the axle over that which the uppermost layer's makes in an elastic half-space."""
        inside, at = self.layer(depth)
        top, z_top = self.layer(0.0)
        load = self.stress[top] * self.volume[top] / (2 * z_top)
        both = [below_point_loads(at - z_top, self.x[top], side * self.y[top], load, ELASTIC) for side in (1, -1)]
        close = inside & (np.hypot(self.x, self.y) < 0.03)
        return float(self.stress[close].mean() / sum(both))

    def settled(self, low: float, high: float) -> float:
        """Settlement of the surface in the track between two places from the axle [m]; NaN where there is none [mm]."""
        top, _ = self.layer(0.0)
        inside = top & (np.abs(self.y) < 0.03) & (np.abs(self.x) < 0.3) & (self.x > low) & (self.x < high)
        return float(self.sunk[inside].mean()) if inside.any() else np.nan


def tyre_ground(run: Run, metres: float, rest: float) -> Row:
    """ground: a TyreGround; forces over the end of the travel [m], or of a run without travel over its last time [s]:
    load and its fluctuation, coefficient, arm (how far ahead of the axle the ground's pressure acts [m]), height of the
    axle [m], with standard errors of blocks."""
    ground = TyreGround(run.folder)
    h = ground.history
    last = last_part(h, metres, rest)
    load = h["force_z"][last].mean()
    arm = -(h["moment_y"][last] + h["z"][last] * h["force_x"][last]) / load
    return {
        "ground": ground,
        "load": load,
        "fluctuation": h["force_z"][last].std() / load,
        "coefficient": -h["force_x"][last].mean() / load,
        "coefficient_error": block_mean(h["force_x"][last] / load)[1],
        "arm": arm.mean(),
        "arm_error": block_mean(arm)[1],
        "height": h["z"][last].mean(),
    }


def layer_stress(run: Run, depths: Sequence[float], near: float, half_space: Sequence[float]) -> Row:
    """Vertical stress (sz) and Mises stress (q) in layers: sz_DEPTH_centroid_mm, _front, _peak_kPa, _place_mm; at
    depths half_space sz_DEPTH_over_boussinesq."""
    ground, row = TyreGround(run.folder), dict[str, float]()
    for depth in depths:
        for field, short in ((ground.stress, "sz"), (ground.mises, "q")):
            found, at = ground.distribution(depth, field, near), f"{short}_{1e3 * depth:.0f}"
            row[f"{at}_centroid_mm"] = round(1e3 * found["centroid"], 1)
            row[f"{at}_front"] = round(found["front"], 3)
            row[f"{at}_peak_kPa"] = round(found["peak"] / 1e3, 1)
            row[f"{at}_place_mm"] = round(1e3 * found["place"])
    for depth in half_space:
        row[f"sz_{1e3 * depth:.0f}_over_boussinesq"] = round(ground.over_boussinesq(depth), 3)
    return row
