#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress and slip along a wheel's arc of contact, both grounds side by side. See README.md.

Reads the arc.csv (fix wheel/arc) of finished runs, writes their means over the end of each run to
wheel_on_snow_shear.csv, and draws wheel_on_snow_shear.png from it. Without a folder it draws alone.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.arguments import path
from furrow_post.arrays import Floats
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command
from furrow_post.csv_table import read_columns, read_rows, write_rows
from furrow_post.figures.style import RUN_COLOURS, annotate_panel, panel_letters, save, use_style

HERE = Path(__file__).resolve().parent
TABLE, FIGURE = HERE / "wheel_on_snow_shear.csv", HERE / "wheel_on_snow_shear.png"
GROUNDS = ("continuum", "clusters")
RUNS = {  # folder without the ground -> legend
    "towed": "towed",
    "slip_0": "slip 0",
    "slip_0.1": "slip 0.1",
    "slip_0.3": "slip 0.3",
    "slip_0_smooth": "slip 0, no friction",
}
WINDOW = 0.5  # [s] at the end of a run
SPEED = 2.235  # [m/s]
LEAST = 3e3  # [Pa] below it friction and slip are not drawn
COLUMNS = ("ground", "run", "angle", "normal_stress", "shear_stress", "slip_velocity")
COMMENTS = (
    "# Means along the wheel's arc over the last 0.5 s of each run: degrees, Pa, Pa, m/s.",
    "# Made by shear.py",
)


def mean_profile(file: Path) -> list[Floats]:
    """Angle and means over the window; the slip is weighted by the normal stress."""
    columns = read_columns(file)
    late = columns["time"] > columns["time"].max() - WINDOW
    angle = np.unique(columns["angle"])
    normal, shear, slip = (
        columns[name][late].reshape(-1, angle.size)
        for name in ("normal_stress", "shear_stress", "slip_velocity")
    )
    weight = np.maximum(normal.sum(axis=0), 1e-9)
    return [angle, normal.mean(axis=0), shear.mean(axis=0), (normal * slip).sum(axis=0) / weight]


def write_table(results: Path) -> None:
    rows = []
    for ground in GROUNDS:
        for run in RUNS:
            profile = mean_profile(results / f"{ground}_{run}" / "arc.csv")
            rows += [
                dict(zip(COLUMNS, (ground, run, *(f"{number:.6g}" for number in numbers))))
                for numbers in zip(*profile)
                if numbers[1] > 0.0
            ]
    write_rows(TABLE, rows, COMMENTS)


def draw() -> None:
    rows = read_rows(TABLE)
    use_style()
    figure, grid = plt.subplots(
        3, 2, figsize=(8.4, 7.2), sharex=True, sharey="row", layout="constrained"
    )
    letters = panel_letters()
    for column, ground in enumerate(GROUNDS):
        for (run, legend), colour in zip(RUNS.items(), RUN_COLOURS):
            angle, normal, shear, slip = (
                np.array([float(r[name]) for r in rows if (r["ground"], r["run"]) == (ground, run)])
                for name in COLUMNS[2:]
            )
            pressed = normal > LEAST
            quantities = (
                (angle, 1e-3 * normal),
                (angle[pressed], (shear / normal)[pressed]),
                (angle[pressed], slip[pressed] / SPEED),
            )
            for axes, (x, y) in zip(grid[:, column], quantities):
                axes.plot(x, y, color=colour, lw=1.4, ls="--" if "smooth" in run else "-", label=legend)
        for axes, text in zip(
            grid[:, column], ("normal stress, kPa", "shear over normal stress", "slip over speed")
        ):
            annotate_panel(axes, next(letters), f"{ground}: {text}")
            axes.axhline(0.0, color="0.7", lw=0.6, zorder=0)
        grid[2, column].set_xlabel("angle ahead of the lowest point, degrees")
    grid[2, 0].set_ylim(-0.12, 0.5)
    grid[2, 0].set_xlim(-15.0, 45.0)
    grid[0, 1].legend(loc="upper right")
    save(figure, FIGURE)


@command(
    argument("results", "folder with continuum_towed, clusters_slip_0, ...", path, required=False),
    description=__doc__ or "",
)
def shear(given: Given) -> None:
    if given.results:
        write_table(given.results)
    draw()


if __name__ == "__main__":
    sys.exit(start(shear, "shear.py"))
