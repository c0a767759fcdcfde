# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of grains with a relief.

    bed_relief_test.py <furrow> <inputs/beds> <mpirun -n>

The tops of the grains follow the relief: mean and rms of their distance are below one diameter, and
their wave has the amplitude of the relief. This holds for a washboard on one and on two ranks and
for a heightmap. Equal heightmaps share a kept bed. A run that continues gives
the grains of the run in one, bit for bit.

In a hybrid the bed keeps its relief, and base and continuum carry the weight of the grains (momentum,
equilibrium).
"""

import os
import re
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from furrow_run import run, words_of

HERE = Path(__file__).resolve().parent
DIAMETER, DEPTH, LENGTH, WIDTH = 0.01, 0.035, 0.2, 0.04  # of bed.lig [m]
WAVELENGTH, AMPLITUDE = 0.1, 0.008  # [m]
AMPLITUDE_ERROR = 0.35  # of the amplitude: a crest is a grain wide
GRAVITY, GRAIN_DENSITY = 100.0, 2600.0  # of bed.lig, hybrid.lig
WEIGHT_ERROR, STRESS_ERROR = 0.001, 0.02
MAKING = "Making the bed"


class Bed:
    """Runs bed.lig in a folder with its own cache."""

    def __init__(self, furrow, beds, folder):
        self.furrow, self.beds, self.folder = furrow, beds, folder

    def run(self, relief, launcher=(), cache="cache", start="none", script="bed.lig"):
        elastic = Path(self.beds).parent / "materials" / "compacted_sand_elastic.yaml"
        more = {"from": start} if script == "bed.lig" else {"material": elastic}
        words = words_of({"beds": self.beds, "relief": relief, **more})
        return run([*launcher, self.furrow, "-in", HERE / script, "-log", "none", *words], self.folder, 120,
                   FURROW_CACHE=str(self.folder / cache))

    def grains(self, relief, made, **how):
        """Positions and radii by tag."""
        status, said = self.run(relief, **how)
        assert status == 0, said[-3000:]
        assert (MAKING in said) == made, f"{relief}: made {made}\n{said[-3000:]}"
        rows = np.loadtxt(self.folder / "grains.txt", skiprows=9)
        return rows[np.argsort(rows[:, 0])], dict(re.findall(r"\b(MEAN|RMS) (\S+)", said))


def tops(grains):
    """Places and heights of the highest grain on vertical lines half a diameter apart."""
    x, y = np.meshgrid(np.arange(-LENGTH / 2 + DIAMETER, LENGTH / 2 - DIAMETER, DIAMETER / 2),
                       np.arange(-WIDTH / 2 + DIAMETER, WIDTH / 2 - DIAMETER, DIAMETER / 2), indexing="ij")
    squares = grains[:, 4]**2 - (x[..., None] - grains[:, 1])**2 - (y[..., None] - grains[:, 2])**2
    return x, y, np.where(squares > 0, grains[:, 3] + np.sqrt(np.maximum(squares, 0)), 0.0).max(axis=-1)


def check(name, grains, facts, height):
    x, y, top = tops(grains)
    relief = height(x, y)
    off = top - DEPTH - relief
    mean, rms = off.mean(), np.sqrt((off**2).mean())
    wave = relief - relief.mean()
    share = (wave * (top - top.mean())).sum() / (wave**2).sum()
    print(f"{name}: {len(grains)} grains, mean {mean / DIAMETER:.2f} and rms {rms / DIAMETER:.2f} diameters off, "
          f"{share:.2f} of the amplitude; Furrow {facts}")
    assert abs(mean) < DIAMETER and rms < DIAMETER
    assert abs(share - 1) < AMPLITUDE_ERROR
    # on other lines, and with those at the walls
    assert abs(float(facts["MEAN"]) - mean) < 0.3 * DIAMETER and abs(float(facts["RMS"]) - rms) < 0.3 * DIAMETER


def check_continuum(folder, grains):
    """The impulse of the base is that of all weights. The mean vertical stress is that of equilibrium, whatever
    way the grains spread their weight: the grains over the area and half of the ground."""
    with h5py.File(folder / "ground" / "terrain.h5") as file:
        history, ground = file["history"], file["terrain"]
        base = np.ptp(history["base_impulse"][:]) / np.ptp(history["time"][:])
        volume = ground["volume"][:]
        weight = (ground["density"][:] * volume).sum() * GRAVITY
        stress = -(ground["vertical_stress"][:] * volume).sum() / volume.sum()
    grain_weight = (4 / 3 * np.pi * grains[:, 4]**3).sum() * GRAIN_DENSITY * GRAVITY
    expected = (grain_weight + weight / 2) / (LENGTH * WIDTH)
    print(f"base {base:.2f} N of {grain_weight + weight:.2f} N, vertical stress {stress:.0f} Pa of {expected:.0f} Pa")
    assert abs(base / (grain_weight + weight) - 1) < WEIGHT_ERROR
    assert abs(stress / expected - 1) < STRESS_ERROR


def write_map(path, height):
    """An ESRI grid with nodes a grain apart."""
    x, y = np.arange(-0.11, 0.111, 0.01), np.arange(-0.03, 0.031, 0.01)
    rows = [" ".join(f"{value:.6f}" for value in height(x, north)) for north in y[::-1]]
    path.write_text(f"ncols {len(x)}\nnrows {len(y)}\nxllcenter -0.11\nyllcenter -0.03\ncellsize 0.01\n" + "\n".join(rows) + "\n")


def main(furrow, beds, *mpirun):
    def washboard(x, y):
        return AMPLITUDE * np.sin(2 * np.pi * x / WAVELENGTH) + 0 * y

    def ridge(x, y):
        return AMPLITUDE * np.cos(2 * np.pi * x / LENGTH) * (1 + 5 * y)

    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        bed = Bed(furrow, beds, folder)
        words = f"washboard {WAVELENGTH} {AMPLITUDE}"
        whole, facts = bed.grains(words, made=True)
        check("washboard", whole, facts, washboard)
        checkpoint, = (path for path in folder.glob("checkpoint.*") if path.is_file())
        continued, _ = bed.grains(words, made=False, start=checkpoint.name)
        assert np.array_equal(whole, continued), "the run that continues has other grains"

        check("hybrid", *bed.grains(words, made=False, script="hybrid.lig"), washboard)
        check_continuum(folder, np.loadtxt(folder / "grains.txt", skiprows=9))

        write_map(folder / "one.asc", ridge)
        write_map(folder / "equal.asc", ridge)
        here = lambda name: os.path.relpath(folder / name, HERE)
        check("heightmap", *bed.grains(f"heightmap {here('one.asc')}", made=True), ridge)
        bed.grains(f"heightmap {here('equal.asc')}", made=False)
        status, said = bed.run(f"heightmap {here('one.asc')}", start=checkpoint.name)
        assert status != 0 and "the parameters of the bed" in said and "heightmap 23x7 " in said, said[-3000:]

        check("two ranks", *bed.grains(words, made=True, launcher=[*mpirun, "2"], cache="two"), washboard)


if __name__ == "__main__":
    main(*sys.argv[1:])
