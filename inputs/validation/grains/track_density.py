#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Snow of clusters: density under the track of a wheel and next to it, how much is left there, and the surface ahead.
Density is mass over volume between floor and surface. The surface is the mean of the highest tops in squares of two
diameters, less what that is above the level of the undisturbed bed."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np

from furrow_post.analyse.density import Interval, ground_points
from furrow_post.arguments import path
from furrow_post.arrays import Booleans, Floats
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command
from furrow_post.errors import ResultsError
from furrow_post.read.wheel_run import WheelRun, read_wheel_run

BEHIND = (-1.3, -0.6)  # [radii] from the axle: rolled over, as in furrow-post compare
SHOULDER = 0.05  # [m] outwards of the wheel's side
AHEAD = (0.4, 0.8)  # [m] from the axle: where a bow wave would be
_LATTICE = np.stack(np.meshgrid(*[np.linspace(-0.8, 0.8, 5)] * 3), axis=-1).reshape(-1, 3)
IN_SPHERE = _LATTICE[np.linalg.norm(_LATTICE, axis=1) < 1]  # stand for a cluster's volume


class Ground:
    """The clusters at the end of a run, in the wheel's coordinates."""

    def __init__(self, run: WheelRun) -> None:
        points = ground_points(run)
        self.x, self.size = points.x, points.size
        self.floor = run.floor - run.ground_level
        self.parts: Floats = (self.x[:, None, :] + 0.5 * self.size[:, None, None] * IN_SPHERE).reshape(-1, 3)
        self.part_mass = np.repeat(points.mass / len(IN_SPHERE), len(IN_SPHERE))
        before = run.results.grains("reference")
        tops = _tops(before.x, 2 * before.radius, run.floor, (-np.inf, np.inf), (0.0, np.inf))
        self.rough = tops - run.number("depth")  # [m] of tops over the level

    def mass(self, along: Interval, beside: Interval) -> float:
        """Mass above the floor on both sides of the wheel's middle plane [kg/m2]. `beside`: range of |y| [m]"""
        inside = _inside(self.parts, along, beside) & (self.parts[:, 2] > self.floor)
        area = 2 * (beside[1] - beside[0]) * (along[1] - along[0])
        return float(self.part_mass[inside].sum()) / area

    def surface(self, along: Interval, beside: Interval) -> float:
        """Height of the surface above the floor [m]. @raises ResultsError without clusters"""
        return _tops(self.x, self.size, self.floor, along, beside) - self.rough


def _tops(x: Floats, size: Floats, floor: float, along: Interval, beside: Interval) -> float:
    """Mean of the highest in each square, above the floor [m]. @raises ResultsError of none"""
    square = 2 * np.median(size)
    tops: dict[tuple[int, int], float] = {}
    for i in np.flatnonzero(_inside(x, along, beside) & (x[:, 2] > floor)):
        place = (int(x[i, 0] // square), int(x[i, 1] // square))
        tops[place] = max(tops.get(place, 0.0), x[i, 2] + size[i] / 2 - floor)
    if not tops:
        raise ResultsError(f"no clusters {along[0]:.2f} to {along[1]:.2f} m from the axle")
    return float(np.mean(list(tops.values())))


def _inside(x: Floats, along: Interval, beside: Interval) -> Booleans:
    across = np.abs(x[:, 1])
    inside: Booleans = (across >= beside[0]) & (across < beside[1])
    return inside & (x[:, 0] > along[0]) & (x[:, 0] < along[1])


def report(folder: Path) -> str:
    """A line for each place. @raises ResultsError without grains or wheel"""
    run = read_wheel_run(folder, folder.name)
    if run.ground != "grains":
        raise ResultsError(f"{folder}: its ground is no grains ({run.ground})")
    if not np.isfinite(run.number("density")):
        raise ResultsError(f"{folder}: its bed did not measure its density")
    ground, side, before = Ground(run), 0.5 * run.number("wheel_width"), run.number("density") * run.number("depth")
    behind = (BEHIND[0] * run.radius, BEHIND[1] * run.radius)
    places = {"middle half of the track": (0.0, 0.5 * side), f"{100 * SHOULDER:.0f} cm beside it": (side, side + SHOULDER)}
    lines = []
    for name, beside in places.items():
        mass, height = ground.mass(behind, beside), ground.surface(behind, beside)
        text = f"{mass / height:4.0f} kg/m3, {1e3 * height:3.0f} mm high, {mass / before:.2f} of the mass before"
        lines.append(f"{name:25} {text}")
    risen = ground.surface(AHEAD, (0.0, side)) - run.number("depth")
    lines.append(f"surface {AHEAD[0]:g} to {AHEAD[1]:g} m ahead   {1e3 * risen:+.0f} mm risen")
    return "\n".join(lines)


@command(argument("results", "results folder of the run", path), description=__doc__ or "")
def density(given: Given) -> None:
    print(report(given.results))


if __name__ == "__main__":
    sys.exit(start(density, "track_density.py"))
