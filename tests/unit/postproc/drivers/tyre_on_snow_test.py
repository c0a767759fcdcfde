# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/tyre_on_snow: where a tread lifts, and how its pressure alternates."""

import unittest

import h5py
import numpy as np

from furrow_post.errors import ResultsError
from support.evaluation import evaluation
from support.folder import FolderTest

run = evaluation("tyre_on_snow")


class UnevennessTest(unittest.TestCase):
    def test_alternation_of_known_lines(self) -> None:
        for what, line, expected in (
            ("even", [7e4] * 9, 0.0),
            ("straight", list(np.linspace(5e4, 9e4, 9)), 0.0),
            ("2 p and nothing in turn", [14e4, 0.0] * 4 + [14e4], 2.0 / (10 / 9)),
        ):
            with self.subTest(what):
                self.assertAlmostEqual(run.unevenness([np.array(line)])[1], expected)

    def test_places_that_bear_nothing_are_counted_over_all_lines(self) -> None:
        lines = [np.array([7e4, 0.0, 7e4, 7e4, 7e4]), np.array([7e4, 7e4, 0.0, 0.0, 7e4])]
        self.assertAlmostEqual(run.unevenness(lines)[0], 0.3)


class LinesTest(FolderTest):
    def test_a_node_that_does_not_touch_bears_nothing(self) -> None:
        """Two lines; the second node of the second one is not in the file."""
        step, across = run.NODE_STEP, run.HALF_TREAD / run.ACROSS_HALF
        rows = [(k * step, 0.0, 1e4 * (k + 1)) for k in range(3)]
        rows += [(k * step, across, 5e4) for k in (-1, 1)]
        file = self.folder / f"{run.LOW_PRESSURE}kPa_{run.LOAD}N_pressure.csv"
        text = "".join(f"{x},{y},{p},0.0004\n" for x, y, p in rows)
        file.write_text("x_m,y_m,pressure_Pa,area_m2\n" + text, encoding="utf-8")
        first, second = run.lines_of_plane(self.folder)
        np.testing.assert_allclose(first, [1e4, 2e4, 3e4])
        np.testing.assert_allclose(second, [5e4, 0.0, 5e4])

    def test_a_finer_line_gives_lines_of_the_same_step(self) -> None:
        step = run.NODE_STEP / 2
        rows = [(k * step, 0.0, 1e4 * (k + 1)) for k in range(6)]
        file = self.folder / f"{run.LOW_PRESSURE}kPa_{run.LOAD}N_pressure.csv"
        text = "".join(f"{x},{y},{p},0.0001\n" for x, y, p in rows)
        file.write_text("x_m,y_m,pressure_Pa,area_m2\n" + text, encoding="utf-8")
        even, odd = run.lines_of_plane(self.folder, 2)
        np.testing.assert_allclose(even, [1e4, 3e4, 5e4])
        np.testing.assert_allclose(odd, [2e4, 4e4, 6e4])

    def write_snow(self, pressure: float) -> None:
        """Two layers; the upper one bears the pressure within 20 cm, and none elsewhere."""
        axes = np.arange(-0.4, 0.4, 0.0125), (0.006, 0.05, 0.1), (0.18, 0.19)
        initial = np.stack([axis.ravel() for axis in np.meshgrid(*axes)], axis=1)
        x, y, z = initial.T
        bears = (np.abs(x) < 0.1) & (z > 0.185) & (y < run.HALF_TREAD)
        with h5py.File(self.folder / "terrain.h5", "w") as file:
            file["terrain/x"] = initial - [0.0, 0.0, 0.1]
            file["terrain/initial_position"] = initial
            file["terrain/vertical_stress"] = np.where(bears, -pressure, 0.0)

    def test_snow_is_read_in_its_uppermost_layer_at_the_tread_s_steps(self) -> None:
        self.write_snow(8e4)
        lines = run.lines_of_snow(self.folder)
        self.assertEqual(len(lines), 2)
        for line in lines:
            np.testing.assert_allclose(line, [8e4] * len(line))
            self.assertEqual(len(line), round(0.2 / run.NODE_STEP))

    def test_no_contact_is_an_error(self) -> None:
        self.write_snow(0.0)
        with self.assertRaisesRegex(ResultsError, "does not touch the snow"):
            run.lines_of_snow(self.folder)


if __name__ == "__main__":
    unittest.main()
