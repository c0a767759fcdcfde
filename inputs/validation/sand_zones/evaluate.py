# SPDX-License-Identifier: GPL-2.0-or-later
"""Zones in the ground under a wheel: principal stresses as mean of the last instants, and flow at the end of a run.

x is counted from the axle, positive ahead; depth from the undisturbed surface.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from furrow_post.analyse.statistics import place_of_greatest
from furrow_post.arrays import Booleans, Floats
from furrow_post.figures.terrain_stress import draw_stress
from furrow_post.read.results import MIRROR
from furrow_post.read.terrain import (
    Outline,
    Terrain,
    TerrainStress,
    is_half,
    read_terrain_fields,
)
from furrow_post.study.output import Output
from furrow_post.study.runs import Runs

NEAR = 0.3  # [m] to both sides of the axle that are looked at
DEPTHS = (0.019, 0.044, 0.069, 0.094, 0.144, 0.19)  # [m] of the layers of the table
GREATEST = 20  # particles of a layer, of both halves, whose mean place is that of the greatest
UNDER = (0.08, 0.03)  # [m] along and across, from the axle: under the contact
BESIDE = (0.10, 0.20)  # [m] across, beyond the tyre's edge
MOVING = 0.02  # of the wheel's speed: ground that counts as moving
DRAWN = "brick_cap"  # the run of the figure
MIDDLE = 0.05  # [m] to both sides of the middle plane where flow is looked at

Row = dict[str, object]


@dataclass(frozen=True)
class Ground:
    """Particles within NEAR of the axle. x: (n, 3) from the axle, z from the undisturbed level;
    depth_before: of where they stood [m]."""

    x: Floats
    depth_before: Floats
    volume: Floats
    chosen: Booleans  # which of the terrain's particles these are

    @classmethod
    def read(cls, folder: Path) -> "Ground":
        terrain = Terrain.read(folder)
        axle = float(Outline(folder, terrain).centre[0])
        x = terrain.x - np.array([axle, 0.0, terrain.level])
        near = np.abs(x[:, 0]) < NEAR
        before = terrain.level - terrain.initial_position[near, 2]
        return cls(x[near], before, terrain.volume[near], near)

    def layer(self, depth: float) -> Booleans:
        """The layer of particles nearest to a depth [m]."""
        levels = np.unique(np.round(self.depth_before, 4))
        nearest = levels[np.abs(levels - depth).argmin()]
        inside: Booleans = np.abs(self.depth_before - nearest) < 1e-3
        return inside

    def ahead_of(self, layer: Booleans, field: Floats) -> float:
        """Where the field is greatest in a layer, ahead of the axle [mm]."""
        return round(1e3 * place_of_greatest(self.x[layer, 0], field[layer], GREATEST))


def stresses(folder: Path) -> list[Row]:
    """The three findings of [Shoop2001] on principal stresses under a rolling tyre, by depth."""
    ground, stress = Ground.read(folder), TerrainStress.read(folder)
    principal = stress.principal[ground.chosen]
    tension, compression = principal[:, 0], -principal[:, 2]
    shear = 0.5 * (principal[:, 0] - principal[:, 2])
    # |cos| of the angle between the axis of tension and the way from the middle of the contact
    away = np.abs((stress.tension_axis[ground.chosen] * ground.x).sum(axis=1))
    away /= np.linalg.norm(ground.x, axis=1)
    along, across = np.abs(ground.x[:, 0]), np.abs(ground.x[:, 1])
    under = (along < UNDER[0]) & (across < UNDER[1])
    beside = (along < BESIDE[0]) & (across > BESIDE[0]) & (across < BESIDE[1])
    rows: list[Row] = []
    for depth in DEPTHS:
        layer = ground.layer(depth)
        row: Row = {
            "depth_mm": round(1e3 * float(ground.depth_before[layer].mean())),
            "compression_kPa": round(float(compression[layer].max()) / 1e3),
            "compression_ahead_mm": ground.ahead_of(layer, compression),
            "shear_kPa": round(float(shear[layer].max()) / 1e3),
            "shear_ahead_mm": ground.ahead_of(layer, shear),
        }
        for name, zone in (("under", layer & under), ("beside", layer & beside)):
            row[f"largest_{name}_kPa"] = round(float(tension[zone].mean()) / 1e3, 1)
            row[f"away_{name}"] = round(float(away[zone].mean()), 2)
        rows.append(row)
    return rows


def flow(folder: Path, speed: float) -> Row:
    """Where the ground in the middle plane moves forward, and where backward.

    speed: of the wheel [m/s]
    """
    ground, fields = Ground.read(folder), read_terrain_fields(folder)
    v = fields["v"]
    if is_half(fields["initial_position"]):
        v = np.vstack([v, v * MIRROR])
    v = v[ground.chosen] / speed
    moving = (np.linalg.norm(v, axis=1) > MOVING) & (np.abs(ground.x[:, 1]) < MIDDLE)
    amount = np.where(moving, np.abs(v[:, 0]) * ground.volume, 0.0)
    row: Row = {}
    for name, zone in (("forward", v[:, 0] > 0), ("backward", v[:, 0] < 0)):
        part = float(amount[zone].sum())
        row[f"{name}_share"] = round(part / float(amount.sum()), 3) if part > 0 else 0.0
        if part > 0:
            mean = (amount[zone, None] * ground.x[zone]).sum(axis=0) / part
            row[f"{name}_at_mm"] = round(1e3 * float(mean[0]))
            row[f"{name}_depth_mm"] = round(-1e3 * float(mean[2]))
    return row


def mean_of(instants: Sequence[Sequence[Row]]) -> list[Row]:
    """Tables by depth at several instants -> one by depth: the mean of each quantity and, as NAME_error, the standard
    error of that mean; none of the angles."""
    found: list[Row] = []
    for layers in zip(*instants):
        row: Row = {"depth_mm": layers[0]["depth_mm"], "instants": len(layers)}
        for name in [name for name in layers[0] if name != "depth_mm"]:
            values = np.array([float(str(layer[name])) for layer in layers])
            row[name] = round(float(values.mean()), 2)
            if not name.startswith("away"):
                row[f"{name}_error"] = round(float(values.std(ddof=1) / np.sqrt(len(layers))), 2)
        found.append(row)
    return found


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    stress, zones = [], []
    for run in runs.done("tyre", "tyre_38mm", "wheel", "wheel_5cm"):
        row: Row = {"run": run.name, "what": run.what, "user_s": run.seconds}
        if run.case.stage.startswith("tyre"):
            instants = [stresses(folder) for folder in sorted(run.folder.glob("instant_*"))]
            stress += [{**row, **layer} for layer in mean_of(instants)]
        else:
            zones.append({**row, **flow(run.folder, run.number("speed"))})
        if run.name == DRAWN:
            draw_stress(run.folder / "instant_1", run.what, output.path(f"{run.name}.png"), dpi=80)
    output.table("stress.csv", stress)
    output.table("flow.csv", zones)
    return []
