# SPDX-License-Identifier: GPL-2.0-or-later
"""The shape of the pressed tyre in the section below its axle: the sidewall's profile (Fig 55), and
how far the walls of ribs lean (Fig 54)."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from math import atan2, degrees
from pathlib import Path

import matplotlib.pyplot as plt

import cases

from furrow_post.figures.style import save
from furrow_post.read.vtk import read_vtp
from furrow_post.study.runner import Runner

BELOW = 1e-3  # [m] from the section below the axle: its nodes
BESIDE = 0.08  # [m] from the mid-plane: beside the tread
WALL_HEIGHT = (4e-3, 6.5e-3)  # [m] of a groove's wall
WALL_LEAN = 2.5e-3  # [m] by which an unloaded wall is out of the vertical at most

Point = tuple[float, float]  # [m] y, z
Row = dict[str, object]


def below(file: Path) -> list[Point]:
    """Nodes of the outside below the axle, in the file's order: of every state of a tyre the same,
    and along the sidewall from the tread to the bead."""
    x = read_vtp(file).x
    middle = 0.5 * (x[:, 2].min() + x[:, 2].max())
    return [(float(y), float(z)) for at, y, z in x if abs(at) < BELOW and z < middle]


def sidewall(points: Sequence[Point]) -> list[Point]:
    """The profile from the tread to the bead, heights above the lowest point."""
    floor = min(z for _, z in points)
    return [(y, z - floor) for y, z in points if y > BESIDE]


def state_file(runner: Runner, pressure: int, load: int) -> Path:
    return runner.folder(cases.TABLE6) / f"{pressure}kPa_{load}N.vtp"


def profile_table(runner: Runner) -> list[Row]:
    """Where the sidewall is widest, without load and under it; the carcass is inside of it."""
    found: list[Row] = []
    if not runner.record(cases.TABLE6):
        return found
    for pressure in cases.PRESSURES:
        row: Row = {"pressure_kPa": pressure}
        for name, load in (("inflated", 0), ("loaded", cases.LOAD)):
            profile = sidewall(below(state_file(runner, pressure, load)))
            widest = max(profile)
            row[f"{name}_half_width_cm"] = round(100 * widest[0], 2)
            row[f"{name}_height_of_it_cm"] = round(100 * widest[1], 2)
            row[f"{name}_bead_height_cm"] = round(100 * profile[-1][1], 2)
        found.append(row)
    return found


def draw_profiles(runner: Runner, path: Path) -> None:
    figure, axes = plt.subplots(figsize=(6.5, 5), constrained_layout=True)
    drawn = [(p, cases.LOAD, f"{p} kPa, {cases.LOAD} N", "") for p in cases.PRESSURES]
    last = cases.PRESSURES[-1]
    for pressure, load, label, look in (*drawn, (last, 0, f"{last} kPa, no load", "k--")):
        profile = sidewall(below(state_file(runner, pressure, load)))
        axes.plot([100 * y for y, _ in profile], [100 * z for _, z in profile], look, label=label)
    axes.set(xlabel="from the mid-plane [cm]", ylabel="above the tread [cm]", aspect="equal")
    axes.set(xlim=(7.5, 21))
    axes.legend(loc="upper right")
    save(figure, path, dpi=90)


@dataclass(frozen=True)
class Wall:
    """Of a groove: nodes of a section, by their places in it."""

    foot: int
    top: int

    def lean(self, points: Sequence[Point]) -> float:
        """[degrees] of the top, outwards from the mid-plane."""
        (y0, z0), (y1, z1) = points[self.foot], points[self.top]
        return degrees(atan2(y1 - y0, z0 - z1))


def walls(points: Sequence[Point]) -> list[Wall]:
    """Of the unloaded section."""
    found = []
    for a, b in combinations(range(len(points)), 2):
        (y0, z0), (y1, z1) = points[a], points[b]
        if WALL_HEIGHT[0] < abs(z1 - z0) < WALL_HEIGHT[1] and abs(y1 - y0) < WALL_LEAN:
            found.append(Wall(a, b) if z0 > z1 else Wall(b, a))
    return sorted(found, key=lambda wall: points[wall.top][0])


def rib_table(runner: Runner) -> list[Row]:
    """By how much the load leans the walls of ribs, below the axle."""
    found: list[Row] = []
    places: list[str] = []  # of the walls, at the first pressure
    for (tread, pressure), case in cases.TREADS.items():
        if tread != "ribbed" or not runner.ended(case):
            continue
        folder = runner.folder(case)
        unloaded = below(folder / f"{pressure}kPa_0N.vtp")
        places = places or [f"{100 * unloaded[wall.top][0]:.1f}" for wall in walls(unloaded)]
        for load in cases.TREAD_STATES[pressure]:
            file = folder / f"{pressure}kPa_{load}N.vtp"
            if not file.is_file():
                continue
            loaded = below(file)
            row: Row = {"pressure_kPa": pressure, "load_N": load}
            for place, wall in zip(places, walls(unloaded), strict=True):
                lean = wall.lean(loaded) - wall.lean(unloaded)
                row[f"lean_at_{place}_cm_deg"] = round(lean, 1)
            found.append(row)
    return found
