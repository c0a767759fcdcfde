# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post on one run: figures with something on them, the numbers of furrow-resistance, clear
errors."""

import json
import shutil
import unittest
from pathlib import Path
from typing import Any

import h5py
import matplotlib.image
import numpy as np

from support.command import run_post
from support.folder import SharedFolderTest
from support.runs import write_noisy_history
from support.rut import write_rut

SUMMARY: dict[str, Any] = {
    "window": {"start": 0.9, "end": 3.9},
    "steady": False,
    "quantities": {
        "hub_drop": {"mean": 0.02, "standard_error": 1.6e-4, "unit": "m", "steady": False},
        "resistance_coefficient": {
            "mean": 0.2,
            "standard_error": 0.004,
            "unit": "",
            "steady": True,
        },
        "drive_torque": {"mean": 0.0, "standard_error": 0.0, "unit": "N m", "steady": True},
        "slip": {"mean": None, "standard_error": None, "unit": "", "steady": False},
    },
}


class SingleRunTest(SharedFolderTest):
    @classmethod
    def setUpClass(cls) -> None:
        super().setUpClass()
        write_noisy_history(cls.folder / "history.h5")
        write_rut(cls.folder / "history.h5", diameter=0.016)

    def expect_picture(self, path: Path, least_colours: int) -> None:
        pixels = matplotlib.image.imread(path)[:, :, :3]
        self.assertGreater(min(pixels.shape[:2]), 900)
        colours = np.unique((pixels * 15).astype(int) @ (1, 16, 256))
        self.assertGreater(len(colours), least_colours)
        self.assertGreater((pixels.min(axis=2) < 0.9).mean(), 0.01)  # not blank

    def test_plot_writes_a_figure(self) -> None:
        done = run_post("plot", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_picture(self.folder / "histories.png", 20)

    def test_plot_has_the_position_of_the_axle_as_abscissa(self) -> None:
        file = self.folder / "place.svg"
        done = run_post("plot", self.folder, "--against", "x", "-o", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("x of the axle [m]", file.read_text())
        self.assertNotIn("time [s]", file.read_text())

    def test_picture_is_written(self) -> None:
        done = run_post("picture", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.expect_picture(self.folder / "rut.png", 200)

    def test_resistance_equals_that_of_program_and_signal(self) -> None:
        done = run_post("resistance", "--csv", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        names, values = (line.split(",") for line in done.stdout.strip().splitlines())
        row = dict(zip(names, values))
        for name, mean in (
            ("hub_drop", 0.02),
            ("resistance_coefficient", 0.2),
            ("slip", 0.1),
            ("drive_torque", 3.0),
        ):
            error = float(row[f"{name}_error"])
            self.assertGreater(error, 0.0)
            self.assertLess(abs(float(row[name]) - mean), 4 * error, name)
        self.assertEqual(row["steady"], "1")

    def copy(self, name: str) -> Path:
        folder = self.folder / name
        folder.mkdir()
        shutil.copy(self.folder / "history.h5", folder)
        return folder

    def test_plot_shows_the_means_of_the_summary(self) -> None:
        folder = self.copy("summarised")
        command = ("plot", folder, "--format", "svg")
        self.assertEqual(run_post(*command).returncode, 0)
        self.assertNotIn("not steady", (folder / "histories.svg").read_text())
        (folder / "summary.json").write_text(json.dumps(SUMMARY))
        done = run_post(*command)
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = (folder / "histories.svg").read_text()
        self.assertIn("hub drop 20.00 ± 0.16 mm, resistance coefficient 0.200 ± 0.004 (over time only)", drawn)
        self.assertIn("mean 20.0 ± 0.2", drawn)
        self.assertIn("(over time only, not steady)", drawn)

    def test_titles_mark_imposed_values(self) -> None:
        folder = self.copy("imposed")
        slip = {"mean": 0.1, "standard_error": 2.6e-17, "unit": "", "steady": True, "imposed": True}
        quantities = {**SUMMARY["quantities"], "slip": slip}
        (folder / "summary.json").write_text(json.dumps({**SUMMARY, "quantities": quantities}))
        self.assertEqual(run_post("plot", folder, "--format", "svg").returncode, 0)
        drawn = (folder / "histories.svg").read_text()
        self.assertIn("slip 10 % imposed", drawn)
        self.assertIn("(imposed)", drawn)

    def test_faulty_parts_are_refused(self) -> None:
        folder = self.copy("faulty")
        with h5py.File(folder / "history.h5", "a") as content:
            del content["history/slip"]
            del content["surface"]
        done = run_post("plot", folder)
        self.assertEqual(done.returncode, 1)
        message = "has no channel slip; plot needs the history of a wheel on a rig"
        self.assertIn(message, done.stderr)
        self.assertEqual(run_post("picture", folder).returncode, 0)  # without a wheel
        self.expect_picture(folder / "rut.png", 200)
        (folder / "summary.json").write_text("{")
        done = run_post("picture", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("summary.json: cannot be read", done.stderr)

    def test_errors_are_one_line(self) -> None:
        missing = run_post("plot", self.folder / "nowhere")
        self.assertEqual(missing.returncode, 1)
        self.assertIn("no such file; name the results folder", missing.stderr)
        (self.folder / "text").mkdir(exist_ok=True)
        (self.folder / "text" / "history.h5").write_text("not HDF5")
        wrong = run_post("picture", self.folder / "text")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("is not a results file of Furrow", wrong.stderr)
        (self.folder / "bare").mkdir(exist_ok=True)
        write_noisy_history(self.folder / "bare" / "history.h5", rows=100)
        bare = run_post("picture", self.folder / "bare")
        self.assertEqual(bare.returncode, 1)
        self.assertIn("has no /grains/reference", bare.stderr)
        short = run_post("resistance", self.folder / "bare")
        self.assertEqual(short.returncode, 1)
        unknown = run_post("paint", self.folder)
        self.assertEqual(unknown.returncode, 2)

    def test_help_names_the_subcommands(self) -> None:
        done = run_post("--help")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("resistance", "picture", "terrain", "compare", "budget", "sidewall"):
            self.assertIn(name, done.stdout)


if __name__ == "__main__":
    unittest.main()
