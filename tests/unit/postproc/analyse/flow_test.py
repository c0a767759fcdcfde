# SPDX-License-Identifier: GPL-2.0-or-later
"""Flow fields of ground that moves and bears in closed form: kernel, floor, differences,
refusals."""

import unittest
from collections.abc import Callable, Sequence
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

from furrow_post.analyse.flow import FlowComparison, compare_flows
from furrow_post.arrays import Floats
from furrow_post.csv_table import read_rows
from furrow_post.errors import ResultsError
from furrow_post.read.wheel_run import read_wheel_run
from support.command import run_post
from support.folder import FolderTest
from support.runs import rig, rigid_wheel, style, write_grains, write_run

CELL, DEPTH, DENSITY = 0.02, 0.2, 200.0  # [m], [m], [kg/m3]

Move = Callable[[Floats], Floats]  # (n, 3) -> (n, 3) [m]


def lattice(edges: Sequence[tuple[float, float]], spacing: float) -> Floats:
    """(n, 3) points in the middle of cubes that fill a box [m]."""
    axes = [np.arange(low + spacing / 2, high, spacing) for low, high in edges]
    points: Floats = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return points


def write_moved(
    folder: Path, move: Move, density: float = DENSITY, stress: float = DENSITY * 9.81
) -> None:
    """A layer of terrain that has moved; its particles fill the same places in the end.

    stress: [Pa/m] compression for each metre of depth
    """
    soil = {"length": 4, "width": 0.8, "depth": DEPTH, "surface": 0, "cell": CELL, "symmetry": "no"}
    styles = [rigid_wheel(), rig(), style("terrain", "terrain/continuum", "soil", **soil)]
    write_run(folder, styles=styles)
    edges = ((0.2, 2.4), (-0.06, 0.06), (-DEPTH, 0.0))
    x = lattice(edges, CELL / 2)
    one = np.ones(len(x))
    with h5py.File(folder / "terrain.h5", "w") as content:
        content["terrain/x"], content["terrain/initial_position"] = x, x - move(x)
        content["terrain/density"], content["terrain/volume"] = density * one, CELL**3 / 8 * one
        content["terrain/vertical_stress"] = stress * x[:, 2]
        content["terrain/compaction"] = 0 * one


def write_columns(folder: Path, virial: bool = True) -> None:
    """Grains in straight columns at rest on a floor at z = 0, as heavy as the layer above.

    The k-th from the top is pressed from above by k weights m g and from below by k + 1: its
    vertical stress times volume is -(k + 1/2) m g CELL.
    """
    weight = 9.81 * DENSITY * CELL**3
    write_run(folder, styles=[rigid_wheel(), rig(datum=DEPTH)])
    edges = ((0.2, 2.4), (-0.06, 0.06), (0.0, DEPTH))
    x = lattice(edges, CELL)
    above = (DEPTH - x[:, 2]) / CELL - 0.5
    load = np.zeros_like(x)
    load[:, 2] = -(above + 0.5) * weight * CELL
    with h5py.File(folder / "history.h5", "a") as content:
        for when in ("reference", "final"):
            group = content.create_group(f"grains/{when}")
            write_grains(group, x, np.full(len(x), CELL / 2), DEPTH)
        if virial:
            content["grains/final/virial"] = load


def shear(x: Floats) -> Floats:
    """Along the travel, in proportion to the height above the floor."""
    moved = np.zeros_like(x)
    moved[:, 0] = 0.1 * (x[:, 2] + DEPTH)
    return moved


class FlowTest(FolderTest):
    def of(self, a: Move, b: Move, density: float = DENSITY) -> FlowComparison:
        write_moved(self.folder / "a", a)
        write_moved(self.folder / "b", b, density)
        return compare_flows([read_wheel_run(self.folder / name) for name in "ab"], 0.02)

    def test_known_field_is_recovered(self) -> None:
        result = self.of(shear, shear)
        flow = result.flows[0]
        x, z = np.meshgrid(*result.window)
        inner = (z < -0.06) & (np.abs(x) < 0.3)
        np.testing.assert_allclose(flow.density[inner], DENSITY, rtol=0.01)
        inner &= z > -DEPTH + 0.06  # the kernel is whole, the mean of a line is the line
        exact = 0.1 * (z[inner] + DEPTH)
        np.testing.assert_allclose(flow.displacement[inner][:, 0], exact, atol=2e-4)
        np.testing.assert_allclose(flow.displacement[inner][:, 1], 0, atol=1e-12)
        self.assertTrue(np.isnan(flow.density[z > 0.03]).all())
        self.assertEqual(result.displacement_difference, 0.0)
        self.assertEqual(result.density_difference, 0.0)

    def test_differences_have_their_known_values(self) -> None:
        self.assertAlmostEqual(self.of(shear, lambda x: -shear(x)).displacement_difference, 2.0)
        half = self.of(shear, lambda x: 0.5 * shear(x))
        self.assertAlmostEqual(half.displacement_difference, 0.5 / 0.75)
        denser = self.of(shear, shear, 1.1 * DENSITY)
        self.assertAlmostEqual(denser.density_difference, 0.1 / 1.05)

    def test_stress_of_ground_at_rest_is_its_weight(self) -> None:
        """Closed form rho g h, of particles that have it and of grains by their contacts' forces."""
        write_moved(self.folder / "a", shear)
        write_columns(self.folder / "b")
        runs = [read_wheel_run(self.folder / name) for name in "ab"]
        result = compare_flows(runs, 0.02)
        x, z = np.meshgrid(*result.window)
        inner = (z < -0.06) & (z > -DEPTH + 0.06) & (np.abs(x) < 0.3)
        for flow in result.flows:
            ratio = flow.vertical_stress[inner] / (DENSITY * 9.81 * -z[inner])
            np.testing.assert_allclose(ratio, 1, atol=0.02)
        self.assertLess(result.stress_difference, 0.02)

    def test_doubled_stress_has_its_known_difference(self) -> None:
        write_moved(self.folder / "a", shear)
        write_moved(self.folder / "b", shear, stress=2 * DENSITY * 9.81)
        runs = [read_wheel_run(self.folder / name) for name in "ab"]
        self.assertAlmostEqual(compare_flows(runs, 0.02).stress_difference, 2 / 3)

    def test_grains_without_stress_are_reported(self) -> None:
        write_moved(self.folder / "a", shear)
        write_columns(self.folder / "b", virial=False)
        done = run_post("flow", self.folder / "a", self.folder / "b")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("vertical stress  is not known", done.stdout)
        with h5py.File(self.folder / "flow/flow.h5") as content:
            self.assertNotIn("vertical_stress", content["first"])

    def test_command_prints_the_result(self) -> None:
        write_moved(self.folder / "a", shear)
        write_moved(self.folder / "b", lambda x: 0.5 * shear(x))
        done = run_post("flow", self.folder / "a", self.folder / "b")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("differs by 67 % of its mean", done.stdout)
        (row,) = read_rows(self.folder / "flow/flow.csv")
        self.assertAlmostEqual(float(row["displacement_difference"]), 2 / 3, places=4)
        with h5py.File(self.folder / "flow/flow.h5") as content:
            self.assertEqual(content["second/displacement"].shape[2], 2)
        pixels = matplotlib.image.imread(self.folder / "flow/flow.png")[:, :, :3]
        self.assertGreater(len(np.unique((pixels * 15).astype(int).reshape(-1, 3), axis=0)), 50)

    def test_faults_are_refused(self) -> None:
        write_moved(self.folder / "a", shear)
        run = read_wheel_run(self.folder / "a")
        with self.assertRaisesRegex(ResultsError, "is 1 mm; allowed: at least 10 mm"):
            compare_flows([run, run], 1e-3)
        write_run(self.folder / "bare")
        with self.assertRaisesRegex(ResultsError, "has no terrain"):
            compare_flows([run, read_wheel_run(self.folder / "bare")])


if __name__ == "__main__":
    unittest.main()
