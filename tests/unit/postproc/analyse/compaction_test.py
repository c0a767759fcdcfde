# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress at depth against closed forms, and the report on ground that bears by Boussinesq."""

import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np
from scipy.integrate import simpson
from scipy.optimize import brentq

from furrow_post.analyse.compaction import read_compaction
from furrow_post.laws.half_space import ELASTIC, SOEHNE, below_ellipse, below_point_loads
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from support.command import run_post
from support.folder import FolderTest
from support.runs import rig, rigid_wheel, style, write_run

A, B, PRESSURE = 0.12, 0.08, 1e5  # [m], [m], [Pa] of the footprint
LOAD = np.pi * A * B * PRESSURE
DENSITY, GRAVITY, SPACING = 1500.0, 9.80665, 0.0125


class ClosedForms(unittest.TestCase):
    def test_circle_has_the_closed_form_on_its_axis(self) -> None:
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
        """The vertical stress of a plane adds up to the load, for any factor."""
        radius = 0.1 * np.sinh(np.linspace(0, 12, 600))
        for factor in (ELASTIC, *SOEHNE):
            stress = np.array(
                [below_point_loads(0.1, np.array([r]), np.zeros(1), np.ones(1), factor) for r in radius]
            )
            total = simpson(2 * np.pi * radius * stress, x=radius)
            self.assertAlmostEqual(total, 1, delta=1e-3)


class OtherPrograms(unittest.TestCase):
    def test_point_loads_give_the_stress_of_soilphysics(self) -> None:
        """The example of stressTraffic in [DeLima2021]: 4000 kg on a tyre of 1.8 m x 0.4 m, 200 kPa."""
        depth, factor = (0.05, 0.1, 0.3, 0.5, 0.7, 1.0), (4, 5, 5, 5, 5, 5)
        printed = np.array([275, 262, 154, 85, 51, 28])  # [kPa]
        x, y, load = contact_of_keller(39.24e3, 200.0, 1.8, 0.4)
        found = [1e-3 * below_point_loads(z, x, y, load, nu) for z, nu in zip(depth, factor)]
        np.testing.assert_allclose(found, printed, rtol=0.01)


class Measured(unittest.TestCase):
    """[Lamande2018]: largest stress [kPa] at 0.3, 0.6, 0.9 m, and its growth at 0.9 m [kPa/Mg]."""

    MEASURED = np.array([300.0, 100.0, 45.0, 6.6])
    PRESSURE = 225.0  # [kPa] the middle of its tyres
    LIGHT, HEAVY = 20.0, 70.0  # [kN] its wheel loads

    def formulas(self, factor: float) -> Floats:
        def stress(load: float, depth: float) -> float:
            radius = np.sqrt(load / self.PRESSURE / np.pi)
            return self.PRESSURE * float(below_ellipse(np.array([depth]), (radius, radius), factor)[0])

        growth = (stress(self.HEAVY, 0.9) - stress(self.LIGHT, 0.9)) / (self.HEAVY - self.LIGHT)
        return np.array([*(stress(self.HEAVY, z) for z in (0.3, 0.6, 0.9)), 9.81 * growth])

    def test_soehne_4_agrees_in_the_subsoil_and_not_in_the_topsoil(self) -> None:
        error = {factor: self.formulas(factor) / self.MEASURED - 1 for factor in (ELASTIC, *SOEHNE)}
        rms = {factor: float(np.sqrt(np.mean(found[1:] ** 2))) for factor, found in error.items()}
        self.assertEqual(min(rms, key=lambda factor: rms[factor]), 4.0)
        expected = {3.0: 0.27, 4.0: 0.09, 5.0: 0.16}  # as the page has them
        for factor, value in expected.items():
            self.assertAlmostEqual(rms[factor], value, delta=0.005)
            self.assertLess(error[factor][0], -0.3)


def contact_of_keller(
    load: float, pressure: float, diameter: float, width: float, cell: float = 0.01
) -> tuple[Floats, Floats, Floats]:
    """x, y [m] and load [N] of the cells of a tyre's contact by [Keller2005], at its recommended
    pressure [kPa].

    Largest stress 34.4 + 1.13 p + 0.72 P [kPa, kN], length 0.47 + 0.11 D^2, edge a superellipse of
    the exponent n = 2.1 (b D)^2 + 2. Along the travel 1 - (x/l(y))^a with the a that carries the
    load, across t exp(-delta t) from the edge, delta = 9.3 - 7.3 b.
    """
    largest = 1e3 * (34.4 + 1.13 * pressure + 0.72e-3 * load)
    length, exponent = 0.47 + 0.11 * diameter**2, 2.1 * (width * diameter) ** 2 + 2
    lines = [
        (np.arange(n := round(side / cell)) + 0.5) * side / n - side / 2 for side in (length, width)
    ]
    x, y = (axis.ravel() for axis in np.meshgrid(*lines))
    along = np.abs(x) / (length / 2 * (1 - np.abs(2 * y / width) ** exponent) ** (1 / exponent))
    inside, inwards = along < 1, width / 2 - np.abs(y)
    x, y, along, inwards = (of[inside] for of in (x, y, along, inwards))
    delta = 9.3 - 7.3 * width
    at = min(1 / delta, width / 2)
    across = inwards * np.exp(-delta * inwards) / (at * np.exp(-delta * at))
    area = length / len(lines[0]) * width / len(lines[1])

    def forces(power: float) -> Floats:
        found: Floats = largest * area * (1 - along**power) * across
        return found

    return x, y, forces(brentq(lambda power: forces(power).sum() - load, 0.1, 100.0))


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


class Report(FolderTest):
    def test_elastic_ground_gives_boussinesq(self) -> None:
        write_pressed(self.folder / "a")
        found = read_compaction(self.folder / "a")
        contact, layers = found.contact, {name: column.to_numpy() for name, column in found.layers.items()}
        self.assertAlmostEqual(contact.area / (np.pi * A * B), 1, delta=0.03)
        self.assertAlmostEqual(contact.semi_axes[0] / contact.semi_axes[1], A / B, delta=0.05 * A / B)
        self.assertAlmostEqual(contact.carried, 1, delta=0.03)
        deep = layers["depth"] > 0.05
        exact = PRESSURE * below_ellipse(layers["depth"][deep], (A, B), ELASTIC)
        np.testing.assert_allclose(layers["vertical_stress"][deep], exact, rtol=0.01)
        below_particles = layers["depth"][deep] - SPACING / 2
        by_surface = PRESSURE * below_ellipse(below_particles, (A, B), ELASTIC)
        np.testing.assert_allclose(layers["boussinesq_surface"][deep], by_surface, rtol=0.03)
        np.testing.assert_allclose(contact.ellipse(layers["distance"], ELASTIC)[deep], exact, rtol=0.03)
        self.assertTrue((np.abs(layers["place"][deep]) < SPACING).all())
        denser = layers["density"] / layers["density_before"] - 1
        np.testing.assert_allclose(denser, 0.1 * np.exp(-layers["depth"] / 0.2))

    def test_command_prints_the_result(self) -> None:
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

    def test_faults_are_refused(self) -> None:
        write_run(self.folder / "bare")
        with self.assertRaisesRegex(ResultsError, "no terrain at the end of a run"):
            read_compaction(self.folder / "bare")
        write_pressed(self.folder / "idle", loaded=False)
        with self.assertRaisesRegex(ResultsError, "carries 0 % of the load; allowed: 50 to 200 %"):
            read_compaction(self.folder / "idle")


if __name__ == "__main__":
    unittest.main()
