# SPDX-License-Identifier: GPL-2.0-or-later
"""Flow fields of two runs of one wheel on the same axes: displacement, density and stress.

Both grounds, grains and continuum particles alike, are coarse-grained with one kernel (I.
Goldhirsch, Granular Matter 12, 239 (2010), section 3):

    rho(r) = sum_i m_i phi(r - r_i),   u(r) = sum_i m_i u_i phi(r - r_i)/rho(r)
    sigma_zz(r) = sum_i (V sigma_zz)_i phi(r - r_i)

with r in the wheel's plane (x along, z up, from the axle and the undisturbed ground), phi a
Gaussian of standard deviation w, cut at 3 w, over the middle half of the wheel's width, and u_i the
displacement since the start of the run. Masses stand for the places where they are at the end. The
part of phi below the floor is left out of its norm. A wider kernel sees less: w is written with
every result. V sigma_zz is stress times volume: of a particle its own, of a grain by its contacts
with other grains in the last step, each laid on the two centres by halves instead of along the line
between them (w is no less than a grain); contacts with the wheel and the floor are not in it, so
that a grain's width beside them too little is seen.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import h5py
import numpy as np
from scipy.stats import norm

from ..arrays import Booleans, Floats
from ..csv_table import write_rows
from ..errors import ResultsError
from ..read.results import MIRROR
from ..read.terrain import read_terrain_fields
from ..read.wheel_run import WheelRun
from .density import ground_points

REACH = 3.0  # of the kernel, in standard deviations
CELLS_PER_WIDTH = 2.0  # of the picture, for each standard deviation
GRAINS_PER_WIDTH = 1.0  # least width of the kernel over the size of the coarser ground
# Share of the density that a kernel's room would have at the typical density: less is the surface's blur
COVERED = 0.5


class Window(NamedTuple):
    """A grid of points in the wheel's plane [m]."""

    x: Floats
    z: Floats


@dataclass
class Flow:
    """Fields of a run: displacement (rows up, columns along, x and z) [m], density [kg/m3].

    vertical_stress [Pa], compression positive; NaN where no ground is, or where the run kept none.
    """

    label: str
    displacement: Floats
    density: Floats
    vertical_stress: Floats

    @property
    def covered(self) -> Booleans:
        there: Booleans = np.isfinite(self.density)
        return there

    @property
    def length(self) -> Floats:
        """Magnitude of the displacement [m]."""
        length: Floats = np.linalg.norm(self.displacement, axis=2)
        return length


@dataclass
class FlowComparison:
    """Two flows on one grid, and how far they are apart where both have ground.

    displacement_difference: mass that moves differently: integral of rho |u_a - u_b| over that of
    rho (|u_a| + |u_b|)/2, so 0 for equal fields and 2 for opposite ones; density_difference: mean
    of |rho_a - rho_b| over the mean of both; stress_difference: that of the vertical stress' size,
    NaN where a run kept none.
    """

    window: Window
    width: float  # [m] standard deviation of the kernel
    flows: tuple[Flow, Flow]
    displacement_difference: float
    density_difference: float
    stress_difference: float

    @property
    def has_stress(self) -> bool:
        return math.isfinite(self.stress_difference)


def _moved_and_loaded(run: WheelRun) -> tuple[Floats, Floats]:
    """Displacement (n, 3) [m] and load, vertical stress times volume, compression positive (n) [J], of the points of
    density.ground_points, in their order; the load NaN of a run that kept none."""
    if run.ground == "continuum":
        fields = read_terrain_fields(run.folder)
        moved: Floats = fields["x"] - fields["initial_position"]
        load: Floats = -fields["vertical_stress"] * fields["volume"]
        return (np.concatenate([moved, moved * MIRROR]), np.tile(load, 2)) if run.half else (moved, load)
    grains = run.results.grains("final")
    moved = grains.displacement_from(run.results.grains("reference"))
    return moved, np.full(len(moved), np.nan) if grains.virial is None else -grains.virial[:, 2]


class _Points(NamedTuple):
    """Points of the middle half of a wheel's width."""

    x: Floats  # (n, 2) in the wheel's plane [m]
    carried: Floats  # (n, 4) mass [kg], mass times displacement along x and z [kg m], load [J]
    size: float  # mean [m]

    @classmethod
    def of(cls, run: WheelRun) -> "_Points":
        """@raises ResultsError where there are none"""
        ground, (moved, load) = ground_points(run), _moved_and_loaded(run)
        middle = np.abs(ground.x[:, 1]) < 0.25 * run.number("wheel_width")
        above = ground.x[:, 2] > run.floor - run.ground_level
        followed = middle & above & np.isfinite(moved).all(axis=1)
        if not followed.any():
            raise ResultsError(
                f"{run.label}: has no ground under the wheel whose displacement is known; repeat the "
                "run with its history and terrain written to the end"
            )
        plane, mass = [0, 2], ground.mass[:, None]
        carried = np.hstack([mass, mass * moved[:, plane], load[:, None]])
        return cls(ground.x[followed][:, plane], carried[followed], float(np.mean(ground.size[followed])))

    def sums(self, window: Window, width: float) -> Floats:
        """(rows, columns, 4) of what the points carry, weighted by the kernel's exponential."""
        columns, rows = len(window.x), len(window.z)
        sums = np.zeros((4, rows * columns))
        steps = np.array([window.x[1] - window.x[0], window.z[1] - window.z[0]])
        near_x, near_z = np.ceil(REACH * width / steps).astype(int)
        centres = np.rint((self.x - [window.x[0], window.z[0]]) / steps).astype(int)
        for down in range(-near_z, near_z + 1):
            for along in range(-near_x, near_x + 1):
                j, i = (centres + [along, down]).T
                inside = (i >= 0) & (i < rows) & (j >= 0) & (j < columns)
                i, j, (x, z) = i[inside], j[inside], self.x[inside].T
                square = (window.x[j] - x) ** 2 + (window.z[i] - z) ** 2
                weight = np.where(square <= (REACH * width) ** 2, np.exp(-square / (2 * width**2)), 0.0)
                for total, values in zip(sums, self.carried[inside].T):
                    total += np.bincount(i * columns + j, weight * values, rows * columns)
        found: Floats = sums.T.reshape(rows, columns, 4)
        return found

    def flow(self, label: str, window: Window, width: float, slab: float, depth: float) -> Flow:
        """slab: [m] across, over which the masses are spread; depth: [m] of the floor"""
        sums = self.sums(window, width)
        kernel = 2 * math.pi * width**2 * (1 - math.exp(-(REACH**2) / 2)) * slab
        volume = kernel * norm.cdf((window.z + depth) / width)[:, None]
        density, stress = sums[:, :, 0] / volume, sums[:, :, 3] / volume
        there = density > COVERED * np.median(density[density > 0])
        with np.errstate(invalid="ignore", divide="ignore"):
            displacement = np.where(there[:, :, None], sums[:, :, 1:3] / sums[:, :, :1], np.nan)
        return Flow(label, displacement, *(np.where(there, field, np.nan) for field in (density, stress)))


def _mean_difference(a: Floats, b: Floats) -> float:
    """Mean of |a - b| over that of (|a| + |b|)/2; NaN of fields that are zero or not known."""
    size = float(np.mean(np.abs(a) + np.abs(b))) / 2
    return float(np.mean(np.abs(a - b))) / size if size > 0 else math.nan


def compare_flows(runs: Sequence[WheelRun], width: float | None = None) -> FlowComparison:
    """Comparison of two runs. width [m] of the kernel; without it the size of the coarser ground.

    @raises ResultsError for other than two runs, a run without ground, a kernel finer than it
    """
    if len(runs) != 2:
        raise ResultsError(f"flow compares two results folders, not {len(runs)}")
    for run in runs:
        if not run.ground_kind.has_density:
            raise ResultsError(f"{run.label}: has no terrain of grains or of a continuum, and so no flow")
    taken = [_Points.of(run) for run in runs]
    least = GRAINS_PER_WIDTH * max(points.size for points in taken)
    kernel = least if width is None else width
    if kernel < least * (1 - 1e-9):
        raise ResultsError(
            f"--width is {1e3 * kernel:.3g} mm; allowed: at least {1e3 * least:.3g} mm, the size "
            "of the coarser ground"
        )
    radius, depth, slab = runs[0].radius, runs[0].number("depth"), 0.5 * runs[0].number("wheel_width")
    cell = kernel / CELLS_PER_WIDTH
    window = Window(np.arange(-1.5 * radius, 1.5 * radius, cell), np.arange(-depth + 0.5 * cell, 0.4 * depth, cell))
    a, b = (points.flow(run.label, window, kernel, slab, depth) for run, points in zip(runs, taken))
    both = a.covered & b.covered
    if not both.any():
        raise ResultsError("the two runs have no ground in common under the wheel")
    rho = 0.5 * (a.density + b.density)[both]
    apart = float(np.sum(rho * np.linalg.norm(a.displacement - b.displacement, axis=2)[both]))
    moved = float(np.sum(rho * 0.5 * (a.length + b.length)[both]))
    density = _mean_difference(a.density[both], b.density[both])
    stress = _mean_difference(a.vertical_stress[both], b.vertical_stress[both])
    return FlowComparison(window, kernel, (a, b), apart / moved if moved > 0 else math.nan, density, stress)


def flow_report(result: FlowComparison) -> str:
    """Text of the differences of two flow fields."""
    a, b = result.flows
    stress = (
        f"differs by {100 * result.stress_difference:.0f} % of its mean"
        if result.has_stress
        else "is not known: a run that was interrupted, or of an older Furrow, keeps none of grains"
    )
    lines = [
        f"{a.label} and {b.label} in the wheel's plane, kernel of {1e3 * result.width:.3g} mm",
        f"  displacement     differs by {100 * result.displacement_difference:.0f} % of its "
        "mean (0: equal fields, 200 %: opposite)",
        f"  density          differs by {100 * result.density_difference:.1f} % of its mean",
        f"  vertical stress  {stress}",
    ]
    return "\n".join(lines)


def write_flow(result: FlowComparison, folder: Path) -> None:
    """flow.csv: the numbers; flow.h5: the fields."""
    folder.mkdir(parents=True, exist_ok=True)
    labels = {place: flow.label for place, flow in zip(("first", "second"), result.flows)}
    names = (f"{name}_difference" for name in ("displacement", "density", "stress"))
    row: dict[str, object] = {**labels, "kernel_m": result.width, **{name: getattr(result, name) for name in names}}
    write_rows(folder / "flow.csv", [row], ["# differences as furrow_post/analyse/flow.py defines them"])
    with h5py.File(folder / "flow.h5", "w") as content:
        content.attrs["kernel"] = result.width
        content["x"], content["z"] = result.window
        for place, flow in zip(labels, result.flows):
            group: Any = content.create_group(place)
            group.attrs["label"] = flow.label
            group["displacement"], group["density"] = flow.displacement, flow.density
            if result.has_stress:
                group["vertical_stress"] = flow.vertical_stress
