# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post ground on ground made here: densities in closed form, a picture with something on it, a clear error."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

from synthetic import wheel

SOURCE = Path(os.environ["FURROW_SOURCE"])
FURROW_POST = SOURCE / "postproc" / "furrow-post"
sys.path.insert(0, str(SOURCE / "postproc"))

from furrow_post import ground as furrow_ground

SPACING, DEPTH, DENSITY = 0.02, 0.2, 200.0
AXLE, RADIUS, WIDTH = 0.9, 0.3, 0.2


def write_ground(path):
    """Half a model: under and behind the wheel the ground is pressed to half its depth and twice its density; beside it nothing moves."""
    axes = [np.arange(0.5 * SPACING, length, SPACING) for length in (1.4, 0.4, DEPTH)]
    home = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    pressed = (home[:, 1] < 0.5 * WIDTH) & (home[:, 0] < AXLE + 0.06)
    ratio = np.where(pressed, 0.5, 1.0)
    x = home * np.stack([np.ones_like(ratio), np.ones_like(ratio), ratio], axis=1)
    with h5py.File(path, "w") as content:
        group = content.create_group("ground")
        group["x"], group["home"], group["density"], group["volume"] = x, home, DENSITY / ratio, SPACING**3 * ratio


class Ground(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        write_ground(self.folder / "ground.h5")
        triangles, x = wheel(RADIUS, WIDTH, np.array([AXLE, 0.0, 0.5 * DEPTH + RADIUS]))
        with h5py.File(self.folder / "history.h5", "w") as content:
            content["surface/triangles"], content["surface/x"] = triangles, x

    def test_densities_are_those_of_the_ground(self):
        ground = furrow_ground.Ground.read(self.folder)
        body = furrow_ground.Body(self.folder, ground)
        self.assertEqual(len(ground.x), 2 * 70 * 20 * 10)  # mirrored
        self.assertAlmostEqual(ground.level, DEPTH)
        self.assertAlmostEqual(ground.spacing, SPACING)
        values = furrow_ground.densities(ground, body)
        self.assertAlmostEqual(values["undisturbed"], DENSITY)
        self.assertAlmostEqual(values["under the wheel"], 2 * DENSITY)
        self.assertAlmostEqual(values["in the rut behind"], 2 * DENSITY)
        self.assertAlmostEqual(values["at the shoulder"], DENSITY)

    def test_mean_density_is_mass_over_volume(self):
        ground = furrow_ground.Ground.read(self.folder)
        # half of the mass at 200, half at 400 kg/m3: 2/(1/200 + 1/400)
        one, two = np.flatnonzero(ground.density == DENSITY)[:50], np.flatnonzero(ground.density == 2 * DENSITY)[:50]
        inside = np.zeros(len(ground.x), bool)
        inside[one] = inside[two] = True
        self.assertAlmostEqual(ground.mean_density(inside), 2 / (1 / DENSITY + 0.5 / DENSITY))
        self.assertTrue(np.isnan(ground.mean_density(np.zeros(len(ground.x), bool))))

    def test_picture_shows_the_compacted_track(self):
        target = self.folder / "ground.png"
        furrow_ground.draw(self.folder, "synthetic", "", target, pixels=300)
        picture = matplotlib.image.imread(target)[..., :3]
        dark = (picture.sum(axis=2) < 1.2).mean()
        self.assertGreater(dark, 0.01)
        self.assertLess(dark, 0.5)

    def test_folder_without_ground_is_refused(self):
        for name in ("ground.h5", "history.h5"):
            (self.folder / name).unlink()
        done = subprocess.run([sys.executable, FURROW_POST, "ground", self.folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("ground.h5: has no ground at the end of a run", done.stderr)
        self.assertIn("fix terrain/history", done.stderr)


if __name__ == "__main__":
    unittest.main()
