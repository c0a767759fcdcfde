# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of tyres: the motion of a tread as a whole, where it lifts, grooves and sidewalls, states of a test."""

import math
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

from furrow_post.errors import ResultsError
from furrow_post.tables import tyre_measures as tyre
from support.evaluation import run_in
from support.folder import FolderTest

AROUND, STEP, HALF_TREAD, ACROSS, INFLATION = 36, 0.0303, 0.0785, 3, 69e3


class ShiftTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.angle = np.tile(2 * np.pi * np.arange(AROUND) / AROUND, 2)
        across = np.repeat([-0.03, 0.03], AROUND)
        self.ring = np.stack([0.35 * np.sin(self.angle), across, -0.35 * np.cos(self.angle)], 1)
        self.axle = np.array([2.0, 0.0, 0.3])

    def test_only_the_first_harmonic_moves_the_centre(self) -> None:
        """Translation by (-1, 0, 4) mm and three radial waves of which none translates."""
        moved = self.ring + self.axle + [-1e-3, 0, 4e-3]
        radial = self.ring * [1, 0, 1] / 0.35
        for waves, size in ((0, 1e-3), (2, 5e-3), (3, 2e-3)):
            moved += size * np.cos(waves * self.angle)[:, None] * radial
        edge = self.ring + self.axle + [0, 0.07, 0]
        nodes = tyre.tread_nodes(np.vstack([moved, edge[AROUND:]]), self.axle)
        found = tyre.shift(nodes, self.axle, AROUND)
        self.assertAlmostEqual(found["forward"], -1.0, 6)
        self.assertAlmostEqual(found["upward"], 4.0, 6)

    def test_half_a_ring_is_refused(self) -> None:
        with self.assertRaisesRegex(ResultsError, "no rings of 36"):
            tyre.shift(self.ring[:50], self.axle, AROUND)

    def test_frequency_gives_the_static_shift(self) -> None:
        """A mass on a spring: omega^2 m = F/u; the mode along the axle is not taken."""
        load, mass = 6227, 6.7
        frequency = math.sqrt(load / (5e-3 * mass)) / (2 * math.pi)
        (self.folder / "241kPa_0N_modes.csv").write_text(
            "# modes\nmode,frequency_Hz,waves,radial,circumferential,axial\n"
            f"1,41.6,1,0.02,0.02,0.96\n2,{frequency},1,0.46,0.54,0.001\n"
        )
        run = run_in(self.folder)
        self.assertAlmostEqual(tyre.shift_by_mode(run, 241, load, mass)["by_mode"], 5.0, 9)


class LiftTest(FolderTest):
    def test_lift_of_known_lines_alternates(self) -> None:
        for what, line, expected in (
            ("even", [7e4] * 9, 0.0),
            ("straight", list(np.linspace(5e4, 9e4, 9)), 0.0),
            ("2 p and nothing in turn", [14e4, 0.0] * 4 + [14e4], 2.0 / (10 / 9)),
        ):
            with self.subTest(what):
                self.assertAlmostEqual(tyre.unevenness([np.array(line)], INFLATION)["alternation"], expected)

    def test_unloaded_places_are_counted_over_all_lines(self) -> None:
        lines = [np.array([7e4, 0.0, 7e4, 7e4, 7e4]), np.array([7e4, 7e4, 0.0, 0.0, 7e4])]
        self.assertAlmostEqual(tyre.unevenness(lines, INFLATION)["lifted"], 0.3)

    def nodes(self, rows: list[tuple[float, float, float]]) -> dict[str, np.ndarray]:  # type: ignore[type-arg]
        return dict(zip(("x", "y", "p"), np.array(rows).T))

    def test_node_without_contact_has_no_load(self) -> None:
        """Two lines; the second node of the second one is not in the file."""
        rows = [(k * STEP, 0.0, 1e4 * (k + 1)) for k in range(3)]
        rows += [(k * STEP, HALF_TREAD / ACROSS, 5e4) for k in (-1, 1)]
        first, second = tyre.lines_of_plane(self.nodes(rows), STEP, HALF_TREAD, ACROSS)
        np.testing.assert_allclose(first, [1e4, 2e4, 3e4])
        np.testing.assert_allclose(second, [5e4, 0.0, 5e4])

    def test_finer_line_gives_lines_of_the_same_step(self) -> None:
        rows = [(k * STEP / 2, 0.0, 1e4 * (k + 1)) for k in range(6)]
        even, odd = tyre.lines_of_plane(self.nodes(rows), STEP, HALF_TREAD, ACROSS, 2)
        np.testing.assert_allclose(even, [1e4, 3e4, 5e4])
        np.testing.assert_allclose(odd, [2e4, 4e4, 6e4])

    def test_ground_is_read_in_its_top_layer_at_the_steps_of_the_tread(self) -> None:
        """Two layers; the upper one bears 80 kPa within 20 cm, and none elsewhere."""
        axes = np.arange(-0.4, 0.4, 0.0125), (0.006, 0.05, 0.1), (0.18, 0.19)
        initial = np.stack([axis.ravel() for axis in np.meshgrid(*axes)], axis=1)
        x, y, z = initial.T
        bears = (np.abs(x) < 0.1) & (z > 0.185) & (y < HALF_TREAD)
        with h5py.File(self.folder / "terrain.h5", "w") as file:
            file["terrain/x"] = initial - [0.0, 0.0, 0.1]
            file["terrain/initial_position"] = initial
            file["terrain/vertical_stress"] = np.where(bears, -8e4, 0.0)
        lines = tyre.lines_of_ground(self.folder, INFLATION, STEP, HALF_TREAD)
        self.assertEqual(len(lines), 2)
        for line in lines:
            np.testing.assert_allclose(line, [8e4] * len(line))
            self.assertEqual(len(line), round(0.2 / STEP))
        with h5py.File(self.folder / "terrain.h5", "a") as file:
            file["terrain/vertical_stress"][:] = 0.0
        with self.assertRaisesRegex(ResultsError, "does not touch the snow"):
            tyre.lines_of_ground(self.folder, INFLATION, STEP, HALF_TREAD)


class SectionTest(unittest.TestCase):
    """A section with one groove, from the mid-plane outwards: y, z [m]."""

    UNLOADED = [(0.0, -0.37), (0.0115, -0.37), (0.0117, -0.365), (0.0279, -0.365), (0.0281, -0.37)]

    def test_sidewall_begins_beside_the_tread(self) -> None:
        points = [(0.0, -0.37), (0.075, -0.368), (0.1, -0.3), (0.09, -0.31), (0.082, -0.2)]
        with mock.patch.object(tyre, "below_axle", return_value=points):
            (row,) = tyre.sidewalls(run_in(Path()), [241], 6227, 0.08)
        self.assertEqual(row["loaded_width"], 0.1)
        self.assertAlmostEqual(row["loaded_height"], 0.07)
        self.assertAlmostEqual(row["inflated_bead"], 0.17)

    def test_inclination_of_a_wall_is_the_shift_of_its_top(self) -> None:
        inner, outer = tyre.walls(self.UNLOADED, (4e-3, 6.5e-3), 2.5e-3)
        self.assertEqual((inner, outer), ((2, 1), (3, 4)))  # foot, top
        self.assertAlmostEqual(tyre.wall_lean(self.UNLOADED, inner), -math.degrees(math.atan2(2, 50)))
        leaning = list(self.UNLOADED)
        leaning[4] = (0.0279 + 0.005, -0.37)
        self.assertAlmostEqual(tyre.wall_lean(leaning, outer), 45.0)


class StatesTest(FolderTest):
    def test_loaded_states_are_matched_by_pressure(self) -> None:
        (self.folder / "measured.csv").write_text("pressure_kPa,area_cm2\n103,500\n138,400\n")
        (self.folder / "screen.txt").write_text("pressure_kPa,load_N,area\n103,0,0\n103.2,6227,450\n179,6227,300\n")
        run = run_in(self.folder)
        (row,) = tyre.tyre_at_measured(run, str(self.folder / "measured.csv"))
        self.assertEqual((row["area"], row["measured"].area_cm2), (450.0, 500))
        self.assertEqual(tyre.tyre_at_measured(run, str(self.folder / "measured.csv"), 4000), [])


if __name__ == "__main__":
    unittest.main()
