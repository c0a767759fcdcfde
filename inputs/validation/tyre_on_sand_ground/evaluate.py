# SPDX-License-Identifier: GPL-2.0-or-later
"""Where the stress in the ground under the tyre is, its forces, and the figure of both."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.analyse.statistics import block_mean
from furrow_post.arrays import Booleans, Floats
from furrow_post.figures.style import save
from furrow_post.read.results import Results
from furrow_post.read.terrain import read_terrain_fields
from furrow_post.study.output import Output
from furrow_post.study.runs import Runs
from furrow_post.study.tables import transposed

LAYERS = (0.0, 0.025, 0.05, 0.1, 0.15, 0.2)  # [m] depths of the sections of the table
BOUSSINESQ_DEPTHS = (0.1, 0.2)  # [m]
CRUISE = 0.3  # [m] of travel before the end, over which forces are averaged
AT_REST = 0.03  # [s] before the end, the same for a tyre that does not roll
NEAR = 0.2  # [m] to both sides of the axle that are counted: beyond lies the load's past


class Ground:
    """The half of the ground that was computed, at the end.

    x: counted from the axle [m]; stress: vertical, compression positive [Pa]; depth: before [m]
    """

    def __init__(self, folder: Path) -> None:
        self.history = Results(folder).columns
        terrain = read_terrain_fields(folder)
        now, before = terrain["x"], terrain["initial_position"]
        self.x, self.y = now[:, 0] - self.history["x"][-1], now[:, 1]
        self.x_before, self.depth = before[:, 0], -before[:, 2]
        self.displacement = now - before
        self.volume, self.mises = terrain["volume"], terrain["mises"]
        self.stress, self.pressure = -terrain["vertical_stress"], terrain["pressure"]
        self.compaction = terrain["compaction"]
        self.layer_depths = np.unique(np.round(self.depth, 6))

    def layer(self, depth: float) -> tuple[Booleans, float]:
        """Particles of the layer nearest to a depth, and its depth [m]."""
        nearest = float(self.layer_depths[np.argmin(np.abs(self.layer_depths - depth))])
        return np.abs(self.depth - nearest) < 1e-5, nearest

    def distribution(self, depth: float, field: Floats) -> dict[str, float]:
        """Of a field in a layer: centroid [m], share of the front half, peak and its place [m]."""
        inside, _ = self.layer(depth)
        # all particles of a layer have its height
        weight = np.maximum(field[inside], 0.0) * self.volume[inside]
        x = self.x[inside]
        near = np.abs(x) < NEAR
        weight, x, values = weight[near], x[near], field[inside][near]
        largest, total = np.argmax(values), weight.sum()
        # the axle may cut a column of particles: their weight spreads over the distance between columns
        columns, of = np.unique(np.round(x, 6), return_inverse=True)
        in_column = np.bincount(of, weight)
        behind = np.interp(0.0, columns, np.cumsum(in_column) - 0.5 * in_column)
        return {
            "centroid": (weight * x).sum() / total,
            "front": 1.0 - behind / total,
            "peak": values[largest],
            "place": x[largest],
        }

    def forces(self) -> dict[str, float]:
        """Means over the end of the cruise, with the standard errors of eight blocks.

        Resistance coefficient; arm: how far ahead of the axle the ground's pressure acts [m];
        height of the axle [m]; load [N] and its fluctuation over it
        """
        h = self.history
        if h["x"][-1] - h["x"][0] > CRUISE:
            last = h["x"] > h["x"][-1] - CRUISE
        else:
            last = h["time"] > h["time"][-1] - AT_REST
        load = h["force_z"][last].mean()
        arm = -(h["moment_y"][last] + h["z"][last] * h["force_x"][last]) / load
        return {
            "coefficient": -h["force_x"][last].mean() / load,
            "coefficient_error": block_mean(h["force_x"][last] / load)[1],
            "arm": arm.mean(),
            "arm_error": block_mean(arm)[1],
            "height": h["z"][last].mean(),
            "load": load,
            "fluctuation": h["force_z"][last].std() / load,
        }

    def carried(self, depth: float) -> float:
        """Vertical force through a layer, of both halves [N].

        In equilibrium the load, less what the sides hold.
        """
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
        ends = (below, below - 1)
        return float(np.interp(share * peaks[0], peaks[list(ends)], depths[list(ends)]))

    def boussinesq(self, depth: float) -> float:
        """Vertical stress under the axle [Pa] that the uppermost layer's makes in an elastic half
        space: J. Boussinesq (1885)."""
        top, z_top = self.layer(0.0)
        spacing = np.sqrt(self.volume[top] / (2 * z_top))
        load = self.stress[top] * spacing**2
        z = depth - z_top
        total = 0.0
        for mirror in (1, -1):
            squares = self.x[top] ** 2 + (mirror * self.y[top]) ** 2 + z**2
            total += (3 * load * z**3 / (2 * np.pi * squares**2.5)).sum()
        return float(total)

    def over_boussinesq(self, depth: float) -> float:
        """Vertical stress under the axle over Boussinesq's."""
        inside, at = self.layer(depth)
        close = inside & (np.hypot(self.x, self.y) < 0.03)
        return float(self.stress[close].mean() / self.boussinesq(at))

    def settlements(self) -> dict[str, object]:
        """Of the surface in the track behind, under and ahead of the axle [mm]."""
        top, _ = self.layer(0.0)
        track = top & (np.abs(self.y) < 0.03) & (np.abs(self.x) < 0.3)
        found: dict[str, object] = {}
        for label, where in (
            ("behind", self.x < -0.2),
            ("under", np.abs(self.x) < 0.05),
            ("before", self.x > 0.15),
        ):
            inside = track & where
            value = round(-1e3 * self.displacement[inside, 2].mean(), 3) if inside.any() else ""
            found[f"settlement_{label}_mm"] = value
        return found


def row_of(name: str, run: Ground, seconds: float) -> dict[str, object]:
    f = run.forces()
    row: dict[str, object] = {
        "case": name,
        "user_s": seconds,
        "load_N": round(f["load"]),
        "load_fluctuation": round(f["fluctuation"], 3),
        "coefficient": round(f["coefficient"], 5),
        "coefficient_error": round(f["coefficient_error"], 5),
        "pressure_before_axle_mm": round(1e3 * f["arm"], 2),
        "pressure_before_axle_error_mm": round(1e3 * f["arm_error"], 2),
        "moment_balance_mm": round(1e3 * f["coefficient"] * f["height"], 2),
        "axle_height_mm": round(1e3 * f["height"], 2),
        "load_at_0_over_load": round(run.carried(0.0) / f["load"], 3),
        "load_at_100_over_load": round(run.carried(0.1) / f["load"], 3),
        "reach_half_mm": round(1e3 * run.reach(0.5)),
        "reach_tenth_mm": round(1e3 * run.reach(0.1)),
        "largest_pressure_kPa": round(run.pressure.max() / 1e3),
        "largest_compaction": round(run.compaction.max(), 5),
        **run.settlements(),
    }
    for depth in LAYERS:
        for field, short in ((run.stress, "sz"), (run.mises, "q")):
            found, at = run.distribution(depth, field), f"{short}_{1e3 * depth:.0f}"
            row[f"{at}_centroid_mm"] = round(1e3 * found["centroid"], 1)
            row[f"{at}_front"] = round(found["front"], 3)
            row[f"{at}_peak_kPa"] = round(found["peak"] / 1e3, 1)
            row[f"{at}_place_mm"] = round(1e3 * found["place"])
    for depth in BOUSSINESQ_DEPTHS:
        row[f"sz_{1e3 * depth:.0f}_over_boussinesq"] = round(run.over_boussinesq(depth), 3)
    return row


def draw_stress(runs: dict[str, Ground], target: Path) -> None:
    """Vertical and Mises stress in the middle plane, a row per run; runs: by what they are."""
    size = (10, 2.5 * len(runs))
    figure, panels = plt.subplots(
        len(runs), 2, figsize=size, constrained_layout=True, squeeze=False
    )
    for line, (what, run) in zip(panels, runs.items()):
        middle = run.y < np.unique(np.round(run.y, 6))[1] + 1e-4
        slab = middle & (np.abs(run.x) < 0.32) & (run.depth < 0.25)
        for axes, field, label, levels in (
            (line[0], run.stress, "vertical stress", np.arange(0, 301, 25)),
            (line[1], run.mises, "Mises stress q", np.arange(0, 401, 40)),
        ):
            place, values = (run.x[slab], -run.depth[slab]), field[slab] / 1e3
            shown = axes.tricontourf(*place, values, levels=levels, cmap="viridis", extend="both")
            axes.axvline(0, color="w", lw=0.8, ls="--")
            axes.set(aspect="equal", title=f"{what}: {label}", ylabel="z [m]")
            figure.colorbar(shown, ax=axes, label="kPa", shrink=0.9)
    for axes in panels[-1]:
        axes.set_xlabel("x from the axle [m], travel to the right")
    save(figure, target, dpi=80)


def evaluate(runs: Runs, output: Output) -> Sequence[str]:
    found = [(run, Ground(run.folder)) for run in runs.done("")]
    rows = [row_of(run.name, ground, run.seconds) for run, ground in found]
    if rows:
        output.table("results.csv", transposed(rows, "case"))
        draw_stress({run.what: ground for run, ground in found}, output.path("stress.png"))
    others = [run for stage in ("coarse", "instants", "fine") for run in runs.done(stage)]
    output.table("cells.csv", [row_of(run.name, Ground(run.folder), run.seconds) for run in others])
    return []
