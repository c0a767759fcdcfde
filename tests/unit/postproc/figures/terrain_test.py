# SPDX-License-Identifier: GPL-2.0-or-later
"""Continuum terrain made here: densities in closed form, a picture with something on it."""

import json
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

from furrow_post.analyse.rut import bow_wave, displacements, rut_densities, rut_depth, share_left
from furrow_post.analyse.stress import arc_ahead, in_plane
from furrow_post.errors import ResultsError
from furrow_post.figures.terrain_figure import draw_stress, draw_terrain
from furrow_post.read.terrain import Outline, Terrain, TerrainStress
from support.command import run_post
from support.folder import FolderTest
from support.rut import wheel

SPACING, DEPTH, DENSITY = 0.02, 0.2, 200.0  # [m], [m], [kg/m3]
AXLE, RADIUS, WIDTH = 0.9, 0.3, 0.2  # [m]


def write_terrain(path: Path) -> None:
    """Half a model: under and behind the wheel pressed to half its depth and twice its density.

    Beside it nothing moves.
    """
    axes = [np.arange(0.5 * SPACING, length, SPACING) for length in (1.4, 0.4, DEPTH)]
    initial = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    pressed = (initial[:, 1] < 0.5 * WIDTH) & (initial[:, 0] < AXLE + 0.06)
    ratio = np.where(pressed, 0.5, 1.0)
    one = np.ones_like(ratio)
    with h5py.File(path, "w") as content:
        content["run/styles"] = np.bytes_(json.dumps([]).encode())
        group = content.create_group("terrain")
        group["x"] = initial * np.stack([one, one, ratio], axis=1)
        group["initial_position"] = initial
        group["density"], group["volume"] = DENSITY / ratio, SPACING**3 * ratio


ARC = 0.15  # [m]


def write_stress(path: Path) -> None:
    """Compression along a line that goes down and ahead by 45 degrees, tension across it.

    q is greatest on a circle of radius ARC around the lowest point of the wheel.
    """
    with h5py.File(path, "a") as content:
        group = content["terrain"]
        x = group["x"][()]
        count = len(x)
        distance = np.hypot(x[:, 0] - AXLE, x[:, 2] - 0.5 * DEPTH)
        group["mises"] = 3e3 * np.exp(-(((distance - ARC) / 0.03) ** 2))
        group["principal_stress"] = np.tile([1e3, -2e3, -5e3], (count, 1))
        group["tension_axis"] = np.tile([0.5**0.5, 0.0, 0.5**0.5], (count, 1))
        group["compression_axis"] = np.tile([-(0.5**0.5), 0.0, 0.5**0.5], (count, 1))


class TerrainTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        write_terrain(self.folder / "terrain.h5")
        triangles, x = wheel(RADIUS, WIDTH, [AXLE, 0.0, 0.5 * DEPTH + RADIUS])
        with h5py.File(self.folder / "history.h5", "w") as content:
            content["surface/triangles"], content["surface/x"] = triangles, x

    def test_densities_equal_those_of_the_terrain(self) -> None:
        terrain = Terrain.read(self.folder)
        body = Outline(self.folder, terrain)
        self.assertEqual(len(terrain.x), 2 * 70 * 20 * 10)  # mirrored
        self.assertAlmostEqual(terrain.level, DEPTH)
        self.assertAlmostEqual(terrain.spacing, SPACING)
        densities = rut_densities(terrain, body)
        self.assertAlmostEqual(densities.undisturbed, DENSITY)
        self.assertAlmostEqual(densities.under, 2 * DENSITY)
        self.assertAlmostEqual(densities.in_rut, 2 * DENSITY)
        self.assertAlmostEqual(densities.shoulder, DENSITY)
        self.assertAlmostEqual(rut_depth(terrain, body), 0.5 * DEPTH)
        self.assertAlmostEqual(share_left(terrain, body), 1.0)
        self.assertAlmostEqual(bow_wave(terrain, body), 0.0)

    def test_long_particles_behind_the_wheel_do_not_change_the_density(self) -> None:
        """One of eight particles of the track is left, as a grid with fine cells around the wheel leaves them."""
        with h5py.File(self.folder / "terrain.h5", "r+") as content:
            group = content["terrain"]
            fields = {name: group[name][()] for name in group}
            initial = fields["initial_position"]
            behind = (initial[:, 0] < 0.48) & (initial[:, 1] < 0.5 * WIDTH)
            eighth = np.round(initial[:, 0] / SPACING - 0.5).astype(int) % 8
            for name in ("x", "initial_position"):
                fields[name][behind, 0] += 3.5 * SPACING
            fields["volume"][behind] *= 8
            for name, values in fields.items():
                del group[name]
                group[name] = values[~behind | (eighth == 0)]
        terrain = Terrain.read(self.folder)
        body = Outline(self.folder, terrain)
        self.assertAlmostEqual(terrain.spacing, SPACING)
        densities = rut_densities(terrain, body)
        self.assertAlmostEqual(densities.undisturbed, DENSITY)
        self.assertAlmostEqual(densities.in_rut, 2 * DENSITY)
        self.assertAlmostEqual(rut_depth(terrain, body), 0.5 * DEPTH)

    def test_half_model_of_a_tyre_is_drawn_whole(self) -> None:
        """Its surface is kept for y >= 0 alone: sections, shoulder and rut are those of both."""
        terrain = Terrain.read(self.folder)
        whole = Outline(self.folder, terrain)
        triangles, x = wheel(RADIUS, 0.5 * WIDTH, [AXLE, 0.25 * WIDTH, 0.5 * DEPTH + RADIUS])
        with h5py.File(self.folder / "history.h5", "r+") as content:
            del content["surface"]
            content["surface/triangles"], content["surface/x"] = triangles, x
        half = Outline(self.folder, terrain)
        np.testing.assert_allclose(half.centre, whole.centre, atol=1e-12)
        self.assertAlmostEqual(half.half_width, whole.half_width)
        self.assertEqual(rut_densities(terrain, half), rut_densities(terrain, whole))
        assert half.surface
        corners = half.surface.x[half.surface.triangles]
        volume = np.linalg.det(corners - whole.centre).sum() / 6  # outward normals: positive
        self.assertAlmostEqual(volume, np.pi * RADIUS**2 * WIDTH, delta=0.01 * volume)

    def test_displacements_equal_those_of_the_terrain(self) -> None:
        """The track is pressed to half, its surface drawn forward by 3 cm; beside it, in a layer at
        half of the depth, ground goes out by 1 cm, less far away, and up by 5 mm."""
        terrain = Terrain.read(self.folder)
        body = Outline(self.folder, terrain)
        before = terrain.initial_position
        side, height = np.abs(before[:, 1]), before[:, 2] / DEPTH
        terrain.x[:, 0] += np.where(side < 0.5 * WIDTH, 0.03 * height, 0.0)
        out = np.where(np.abs(height - 0.45) < 0.01, 0.01, 0.0) * (side > 0.5 * WIDTH)
        out[side > 0.5 * WIDTH + 0.09] *= 0.4
        terrain.x[:, 1] += out * np.sign(before[:, 1])
        terrain.x[:, 2] += 0.5 * out
        found = displacements(terrain, body)
        top, middle = DEPTH - 0.5 * SPACING, 0.45 * DEPTH
        for value, expected in (
            (found.surface_down, 0.5 * top),
            (found.surface_forward, 0.03 * top / DEPTH),
            (found.middle_down, 0.5 * middle),
            (found.middle_forward, 0.03 * middle / DEPTH),
            (found.aside, 0.01),
            (found.aside_far, 0.004),
            (found.raised, 0.005),
        ):
            self.assertAlmostEqual(value, expected)
        self.assertIn("beside the wheel            1.0 outwards, 0.5 up", found.report())

    def test_displaced_volume_is_missing_in_the_rut(self) -> None:
        """Snow of the track moves outwards: over 2 |y| it has half of its mass a length left."""
        terrain = Terrain.read(self.folder)
        body = Outline(self.folder, terrain)
        terrain.x[:, 1] *= 2.0
        self.assertAlmostEqual(share_left(terrain, body), 0.5, delta=0.03)
        terrain.x[-1] = [AXLE + 0.3, 0.3, DEPTH + 0.05 - 0.5 * SPACING]
        terrain.density[-1] = DENSITY
        self.assertAlmostEqual(bow_wave(terrain, body), 0.05)

    def test_mean_density_is_mass_over_volume(self) -> None:
        terrain = Terrain.read(self.folder)
        # half of the mass at 200, half at 400 kg/m3: 2/(1/200 + 1/400)
        one, two = (np.flatnonzero(terrain.density == k * DENSITY)[:50] for k in (1, 2))
        inside = np.zeros(len(terrain.x), bool)
        nothing = inside.copy()
        inside[one] = inside[two] = True
        expected = 2 / (1 / DENSITY + 0.5 / DENSITY)
        self.assertAlmostEqual(terrain.mean_density(inside), expected)
        self.assertTrue(np.isnan(terrain.mean_density(nothing)))

    def test_picture_shows_the_compacted_track(self) -> None:
        target = self.folder / "terrain.png"
        draw_terrain(self.folder, "synthetic", "", target, pixels=300)
        picture = matplotlib.image.imread(target)[..., :3]
        dark = (picture.sum(axis=2) < 1.2).mean()
        self.assertGreater(dark, 0.01)
        self.assertLess(dark, 0.5)

    def test_stress_is_composed_of_its_principal_values(self) -> None:
        write_stress(self.folder / "terrain.h5")
        stress = TerrainStress.read(self.folder)
        self.assertEqual(len(stress.mises), 2 * 70 * 20 * 10)
        tensor = stress.tensor(np.array([7]))
        # (1 - 5)/2 on the diagonal, (1 + 5)/2 beside it, -2 across the plane
        expected = 1e3 * np.array([[-2, 0, 3], [0, -2, 0], [3, 0, -2]])
        np.testing.assert_allclose(tensor[0], expected, atol=1e-9)
        values, directions = in_plane(tensor, 0)
        np.testing.assert_allclose(values[0], [-5e3, 1e3])
        self.assertAlmostEqual(abs(directions[0, :, 1] @ np.array([0.5**0.5, 0.5**0.5])), 1.0)
        np.testing.assert_allclose(in_plane(tensor, 1)[0][0], [-2e3, -2e3])

    def test_arc_follows_the_largest_deviatoric_stress(self) -> None:
        write_stress(self.folder / "terrain.h5")
        terrain, stress = Terrain.read(self.folder), TerrainStress.read(self.folder)
        arc = arc_ahead(terrain, stress, Outline(self.folder, terrain))
        self.assertGreater(len(arc.x), 2)
        radius = np.hypot(arc.x - AXLE, arc.z - 0.5 * DEPTH)
        np.testing.assert_allclose(radius, ARC, atol=0.75 * SPACING)
        self.assertGreater(arc.ahead, 0.5 * ARC)

    def test_recorded_stress_is_drawn(self) -> None:
        target = self.folder / "stress.png"
        with self.assertRaisesRegex(ResultsError, "has no 'mises'"):
            draw_stress(self.folder, "synthetic", target)
        write_stress(self.folder / "terrain.h5")
        draw_stress(self.folder, "synthetic", target)
        picture = matplotlib.image.imread(target)[..., :3]
        red = (picture[..., 0] > 0.6) & (picture[..., 1] < 0.3) & (picture[..., 2] < 0.3)
        self.assertGreater(red.mean(), 1e-3)  # tension

    def test_recorded_plastic_strain_is_drawn(self) -> None:
        """Two more panels; where it strained, ahead of the axle, they are dark."""
        write_stress(self.folder / "terrain.h5")
        shapes, dark = [], []
        for strain in (None, 0.0, 0.5):
            if strain is not None:
                with h5py.File(self.folder / "terrain.h5", "a") as content:
                    group = content["terrain"]
                    group.pop("plastic_strain", None)
                    group["plastic_strain"] = np.where(group["x"][:, 0] > AXLE, strain, 0.0)
            draw_stress(self.folder, "synthetic", self.folder / "stress.png", dpi=60)
            picture = matplotlib.image.imread(self.folder / "stress.png")[..., :3]
            shapes.append(picture.shape[0])
            last = picture[-picture.shape[0] // 5 :]
            dark.append(float((last.sum(axis=2) < 1.2).mean()))
        stress = TerrainStress.read(self.folder)
        assert stress.plastic_strain is not None
        self.assertEqual(stress.plastic_strain.max(), 0.5)
        self.assertEqual(len(stress.plastic_strain), len(stress.mises))
        self.assertGreater(shapes[1], shapes[0])
        self.assertGreater(dark[2], 2 * dark[1])

    def test_stress_is_drawn_for_an_axle_between_two_layers(self) -> None:
        """A run that stopped early: no particle lies within half a spacing of the axle."""
        write_stress(self.folder / "terrain.h5")
        with h5py.File(self.folder / "terrain.h5", "a") as content:
            x = content["terrain/x"][()]
            x[:, 0] += np.where(x[:, 0] < AXLE, -0.004, 0.004)
            content["terrain/x"][...] = x
        target = self.folder / "stress.png"
        draw_stress(self.folder, "synthetic", target, dpi=60)
        self.assertGreater(target.stat().st_size, 0)

    def test_section_of_three_particles_is_drawn(self) -> None:
        target = self.folder / "terrain.png"
        with h5py.File(self.folder / "terrain.h5", "a") as content:
            group = content["terrain"]
            x = group["x"][()]
            away = np.abs(x[:, 0] - AXLE) < 0.1
            away[np.flatnonzero(np.abs(x[:, 0] - AXLE) < 0.6 * SPACING)[:3]] = False
            for name in ("x", "initial_position", "density", "volume"):
                values = group[name][()][~away]
                del group[name]
                group[name] = values
        draw_terrain(self.folder, "synthetic", "", target, pixels=100, dpi=60)
        self.assertGreater(target.stat().st_size, 0)

    def test_folder_without_terrain_is_refused(self) -> None:
        for name in ("terrain.h5", "history.h5"):
            (self.folder / name).unlink()
        done = run_post("terrain", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("terrain.h5: has no terrain at the end of a run", done.stderr)
        self.assertIn("fix terrain/history", done.stderr)


if __name__ == "__main__":
    unittest.main()
