#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Under a plate on clusters of snow (plate_snow_grains.lig): density layer by layer, how far the
clusters went sideways, and how much mass is left: the mean of several packings, next to the
laboratory's [Shoop2001]."""

import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "postproc"))

import furrow_post  # first: says which of the next ones are missing

import numpy as np
import pandas

from furrow_post.uncertainty.statistics import rms
from furrow_post.arguments import path, positive
from furrow_post.cli.main import start
from furrow_post.cli.parameters import Given, argument, command
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_matrix, read_numbers

RADIUS = 0.1016  # [m] of the plate
EDGE = 0.8  # of it: beyond is the edge, as in plate_variants
LAYERS = 10  # from the plate to the base
DENSITIES = [f"density_{n}" for n in range(1, LAYERS + 1)]


def clusters(file: Path) -> Floats:
    """(n, 4) x, y, z, radius [m] in the order of their numbers."""
    rows = read_matrix(file, 5, head=9)
    ordered: Floats = rows[np.argsort(rows[:, 0]), 1:]
    return ordered


def volume_below(level: float, z: Floats, radius: Floats) -> Floats:
    """Volume of each sphere below a level."""
    h = np.clip(level - z, -radius, radius)
    volume: Floats = np.pi / 3 * (2 * radius**3 + 3 * radius**2 * h - h**3)
    return volume


def layers(grains: Floats, plate: float, density: float) -> Floats:
    """[kg/m3] below the plate, from its face at this height down to the base; what is pressed into
    the face counts to the first one."""
    x, y, z, radius = grains[np.hypot(grains[:, 0], grains[:, 1]) < RADIUS].T
    below = [volume_below(level, z, radius).sum() for level in np.linspace(plate, 0, LAYERS + 1)]
    below[0] = volume_below(np.inf, z, radius).sum()
    mass: Floats = -density * np.diff(below)
    return mass / (np.pi * RADIUS**2 * plate / LAYERS)


def numbers(folder: Path, density: float) -> dict[str, float]:
    """Peak [N]; ten layers [kg/m3]; outwards [mm]: clusters under the edge, and the mean of the
    tenth of the height that went farthest, under the whole plate; mass left, a share."""
    before, after = clusters(folder / "before.txt"), clusters(folder / "after.txt")
    curve = read_matrix(folder / "curve.txt", 3)
    bed = float(read_matrix(folder / "bed_level.txt", 1)[0, 0])
    plate = bed - float(curve[-1, 1])
    r, now = (np.hypot(x[:, 0], x[:, 1]) for x in (before, after))
    out = 1e3 * (now - r)
    snow = before[:, 2] > 0.0  # below is the frozen base
    under = snow & (r < RADIUS)
    tenth = np.minimum(LAYERS - 1, (LAYERS * before[:, 2] / bed).astype(int))
    means = [out[under & (tenth == n)].mean() for n in range(LAYERS)]
    mass = after[:, 3] ** 3
    return {
        "peak_load_N": curve[:, 2].max(),
        **dict(zip(DENSITIES, layers(after, plate, density))),
        "edge_outwards_mm": out[under & (r > EDGE * RADIUS)].mean(),
        "farthest_tenth_outwards_mm": max(means, key=abs),
        "mass_left": mass[snow & (now < RADIUS)].sum() / mass[under].sum(),
    }


def report(folders: Sequence[Path], density: float) -> str:
    each = pandas.DataFrame([numbers(folder, density) for folder in folders])
    measured = read_numbers(HERE.parent / "plate_variants" / "reference.csv")[0]
    mean, real = each.mean(), pandas.Series({name: measured[name] for name in ("peak_load_N", *DENSITIES)})
    table = pandas.DataFrame({"mean": mean, "scatter": each.std(), "measured": real}).loc[mean.index]
    off = rms(np.log(mean[DENSITIES] / real[DENSITIES]))
    text: str = table.to_string(float_format="{:.4g}".format, na_rep="")
    return f"{text}\nrms of ln(density) {off:.2f}; {len(each)} packings"


@command(
    argument("density", "of a cluster [kg/m3]", positive),
    argument("results", "results folders of packings", path, nargs=-1, required=True),
    description=__doc__ or "",
)
def plate_layers(given: Given) -> None:
    print(report(given.results, given.density))


if __name__ == "__main__":
    sys.exit(start(plate_layers, "plate_layers.py"))
