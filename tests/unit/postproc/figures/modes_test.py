# SPDX-License-Identifier: GPL-2.0-or-later
"""Natural modes of a tyre as a user gets them: table, shapes and figure tell the same."""

import os
import subprocess
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

from furrow_post.csv_table import read_columns
from furrow_post.figures.modes_figure import read_modes
from support.command import SOURCE, run_post
from support.folder import FolderTest

FURROW_TYRE = Path(os.environ["FURROW_BUILD"]) / "bin" / "furrow-tyre"
COUNT = 5


class ModesTest(FolderTest):
    def test_modes_write_table_shapes_and_figure(self) -> None:
        tyre = SOURCE / "inputs/tyres/p235_75r15.yaml"
        options = f"--mesh 4 36 --pressure 20 --modes {COUNT} --folder".split()
        done = subprocess.run(
            [str(FURROW_TYRE), str(tyre), *options, str(self.folder)],
            capture_output=True,
            text=True,
            timeout=240,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        table = read_columns(self.folder / "20kPa_0N_modes.csv")
        state = read_modes(self.folder / "20kPa_0N_modes.h5")
        self.assertIn("at 20 kPa, free", state.heading)
        self.assertEqual(state.x.shape, (36 * 5, 3))
        self.assertEqual(len(state.triangles), 36 * 4 * 2)
        np.testing.assert_allclose([mode.frequency for mode in state.modes], table["frequency_Hz"])
        self.assertEqual([mode.waves for mode in state.modes], list(table["waves"]))
        self.assertEqual(
            [mode.direction for mode in state.modes],
            ["circumferential", "axial", "axial", "axial", "circumferential"],
        )
        for mode in state.modes:
            self.assertAlmostEqual(np.abs(mode.shape).max(), 1.0)
        fields = (self.folder / "20kPa_0N_modes.vtp").read_bytes()
        self.assertIn(f'"mode 01, {table["frequency_Hz"][0]:.1f} Hz"'.encode(), fields)
        pixels = matplotlib.image.imread(self.folder / "20kPa_0N_modes.png")[:, :, :3]
        self.assertGreater((pixels.min(axis=2) < 0.9).mean(), 0.05)  # not blank
        self.assertGreater(len(np.unique((pixels * 15).astype(int).reshape(-1, 3), axis=0)), 50)

    def test_modes_that_cannot_be_drawn_are_refused(self) -> None:
        done = run_post("modes", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("has no natural modes (*_modes.h5); make them by", done.stderr)
        (self.folder / "a_modes.h5").write_text("nothing")
        done = run_post("modes", self.folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("a_modes.h5", done.stderr)
        self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
