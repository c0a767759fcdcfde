# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress at depth against closed forms, and the report on ground that bears by Boussinesq."""

import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np
from scipy.integrate import simpson

from furrow_post.analyse.compaction import read_compaction
from furrow_post.analyse.half_space import ELASTIC, SOEHNE, below_ellipse, below_point_loads
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from support.command import run_post
from support.runs import rig, rigid_wheel, style, write_run

A, B, PRESSURE = 0.12, 0.08, 1e5  # [m], [m], [Pa] of the footprint
LOAD = np.pi * A * B * PRESSURE
DENSITY, GRAVITY, SPACING = 1500.0, 9.80665, 0.0125


class ClosedForms(unittest.TestCase):
    def test_circle_has_the_solution_of_its_axis(self) -> None:
        z, a = np.array([0.01, 0.1, 0.5, 3.0]), 0.2
        for factor in (ELASTIC, *SOEHNE):
            expected = 1 - (z / np.sqrt(z**2 + a**2)) ** factor
            np.testing.assert_allclose(below_ellipse(z, (a, a), factor), expected, rtol=1e-12)

    def test_strip_is_the_limit_of_a_long_ellipse(self) -> None:
        """A strip of half-width b: (2/pi) (alpha + sin alpha cos alpha), tan alpha = b/z."""
        z, b = np.array([0.05, 0.1, 0.2]), 0.1
        alpha = np.arctan(b / z)
        strip = 2 / np.pi * (alpha + np.sin(alpha) * np.cos(alpha))
        ellipse = below_ellipse(z, (20 * b, b), ELASTIC)
        np.testing.assert_allclose(ellipse, strip, rtol=0.01)

    def test_point_loads_add_up_to_the_ellipse(self) -> None:
        x, y, load = footprint(2e-3)
        for factor in (ELASTIC, *SOEHNE):
            for z in (0.05, 0.2):
                expected = PRESSURE * below_ellipse(np.array([z]), (A, B), factor)[0]
                found = below_point_loads(z, x, y, load, factor)
                self.assertAlmostEqual(found / expected, 1, delta=2e-3)

    def test_point_load_is_in_equilibrium(self) -> None:
        """The vertical stress of a plane adds up to the load, whatever the factor."""
        radius = 0.1 * np.sinh(np.linspace(0, 12, 600))
        for factor in (ELASTIC, *SOEHNE):
            stress = np.array(
                [below_point_loads(0.1, np.array([r]), np.zeros(1), np.ones(1), factor) for r in radius]
            )
            total = simpson(2 * np.pi * radius * stress, x=radius)
            self.assertAlmostEqual(total, 1, delta=1e-3)


def footprint(cell: float) -> tuple[Floats, Floats, Floats]:
    """x, y [m] and load [N] of the cells of an ellipse under uniform pressure."""
    line = np.arange(-0.15 + 0.5 * cell, 0.15, cell)
    x, y = (axis.ravel() for axis in np.meshgrid(line, line))
    inside = (x / A) ** 2 + (y / B) ** 2 < 1
    return x[inside], y[inside], np.full(np.count_nonzero(inside), PRESSURE * cell**2)


def write_pressed(folder: Path, loaded: bool = True) -> None:
    """Half of a block of elastic ground with weight, under the footprint at x = 0."""
    soil = {"cell": 2 * SPACING, "gravity": GRAVITY, "surcharge": 0.0, "symmetry": True}
    wheel = rigid_wheel()
    wheel["options"]["pressure"] = [120e3]
    styles = [wheel, rig(LOAD), style("terrain", "terrain/continuum", "soil", **soil)]
    write_run(folder, LOAD, styles=styles)
    along = np.arange(-0.3 + SPACING / 2, 0.3, SPACING)
    across, down = np.arange(SPACING / 2, 0.15, SPACING), -np.arange(SPACING / 2, 0.3, SPACING)
    x = np.stack(np.meshgrid(along, across, down, indexing="ij"), axis=-1).reshape(-1, 3)
    stress = DENSITY * GRAVITY * x[:, 2]
    a, b, load = footprint(0.01)
    for s, t, force in zip(a, b, load) if loaded else ():
        squares = (x[:, 0] - s) ** 2 + (x[:, 1] - t) ** 2 + x[:, 2] ** 2
        stress += 3 * force * x[:, 2] ** 3 / (2 * np.pi * squares**2.5)
    top = x[:, 2] > -SPACING  # the uppermost particles have the pressure of the footprint
    inside = (x[:, 0] / A) ** 2 + (x[:, 1] / B) ** 2 < 1
    stress[top] = DENSITY * GRAVITY * x[top, 2] - PRESSURE * inside[top] * loaded
    one = np.ones(len(x))
    denser = 1 + 0.1 * np.exp(x[:, 2] / 0.2) * (x[:, 1] < 0.1)
    with h5py.File(folder / "terrain.h5", "w") as content:
        group = content.create_group("terrain")
        group["x"], group["initial_position"], group["vertical_stress"] = x, x, stress
        group["density"] = DENSITY * denser
        group["volume"], group["pressure"] = SPACING**3 / denser, -stress / 3
        group["mises"] = one
    box = np.array([[-0.3, 0, 0], [0.3, 0, 0], [0, 0.1, 0], [0, 0, 0.6]])
    with h5py.File(folder / "history.h5", "a") as content:
        content["surface/x"] = box
        content["surface/triangles"] = np.array([[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]])
        content["history/x"][:] = 0.0  # pressed only


class Report(unittest.TestCase):
    def setUp(self) -> None:
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.folder = Path(place.name)

    def test_elastic_ground_gives_boussinesq(self) -> None:
        write_pressed(self.folder / "a")
        found = read_compaction(self.folder / "a")
        contact = found.contact
        self.assertAlmostEqual(contact.area / (np.pi * A * B), 1, delta=0.03)
        self.assertAlmostEqual(contact.semi_axes[0] / contact.semi_axes[1], A / B, delta=0.05 * A / B)
        self.assertAlmostEqual(contact.carried, 1, delta=0.03)
        deep = found.depth > 0.05
        exact = PRESSURE * below_ellipse(found.depth[deep], (A, B), ELASTIC)
        np.testing.assert_allclose(found.stress[deep], exact, rtol=0.01)
        below_particles = found.depth[deep] - SPACING / 2
        by_surface = PRESSURE * below_ellipse(below_particles, (A, B), ELASTIC)
        np.testing.assert_allclose(found.of_surface[deep], by_surface, rtol=0.03)
        np.testing.assert_allclose(contact.ellipse(found.distance, ELASTIC)[deep], exact, rtol=0.03)
        self.assertTrue((np.abs(found.place[deep]) < SPACING).all())
        denser = found.density / found.density_before - 1
        np.testing.assert_allclose(denser, 0.1 * np.exp(-found.depth / 0.2))

    def test_as_a_command(self) -> None:
        write_pressed(self.folder / "a")
        done = run_post("compaction", f"soft={self.folder / 'a'}")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("soft: 3.02 kN, 120 kPa", done.stdout)
        file = self.folder / "compaction/compaction.csv"
        self.assertEqual({row["run"] for row in read_rows(file)}, {"soft"})
        (first, *_) = read_rows(file)
        self.assertAlmostEqual(float(first["load_N"]) / LOAD, 1, delta=1e-3)
        pixels = matplotlib.image.imread(self.folder / "compaction/compaction.png")[:, :, :3]
        self.assertGreater(len(np.unique((pixels * 15).astype(int).reshape(-1, 3), axis=0)), 30)

    def test_refusals(self) -> None:
        write_run(self.folder / "bare")
        with self.assertRaisesRegex(ResultsError, "no terrain at the end of a run"):
            read_compaction(self.folder / "bare")
        write_pressed(self.folder / "idle", loaded=False)
        with self.assertRaisesRegex(ResultsError, "carries 0 % of the load; allowed: 50 to 200 %"):
            read_compaction(self.folder / "idle")


if __name__ == "__main__":
    unittest.main()
