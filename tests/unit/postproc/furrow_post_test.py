# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post on a results folder made here: figures with something on them, the same numbers as furrow-resistance, clear errors."""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

from synthetic import write_rut

FURROW_POST = Path(os.environ["FURROW_SOURCE"]) / "postproc" / "furrow-post"


def write_history(path, rows=4000):
    """Settle, accelerate, cruise with noise about known means: sinkage 20 mm, resistance coefficient 0.2."""
    random = np.random.default_rng(3)
    time = np.arange(rows) * 1e-3
    phase = np.where(time < 0.5, 0.0, np.where(time < 0.8, 1.0, 2.0))
    noise = lambda size: size * random.normal(size=rows)
    vertical = 100 + noise(2.0)
    columns = {"time": ("s", time), "phase": ("", phase), "x": ("m", np.maximum(time - 0.65, 0)), "sinkage": ("m", 0.02 + noise(2e-4)),
               "force_x": ("N", -20 + noise(1.0)), "force_y": ("N", noise(0.5)), "force_z": ("N", vertical),
               "drawbar_pull": ("N", -20 + noise(1.0)), "drive_torque": ("N m", 3 + noise(0.1)), "slip": ("", 0.1 + noise(0.002))}
    with h5py.File(path, "w") as content:
        run = content.create_group("run")
        for name, value in (("title", "synthetic"), ("version", "test"), ("script", "none"), ("started", "2026-01-01T00:00:00Z")):
            run.attrs[name] = np.bytes_(value)
        run["effective_input"] = np.bytes_("none")
        run.attrs["ranks"] = 1
        group = content.create_group("history", track_order=True)
        for name, (unit, values) in columns.items():
            group[name] = values
            group[name].attrs["unit"], group[name].attrs["meaning"] = np.bytes_(unit or " "), np.bytes_(name)


SUMMARY = {"window": {"start": 0.9, "end": 3.9}, "steady": False, "quantities": {
    "sinkage": {"mean": 0.02, "standard_error": 1.6e-4, "unit": "m", "steady": False},
    "resistance_coefficient": {"mean": 0.2, "standard_error": 0.004, "unit": "", "steady": True},
    "drive_torque": {"mean": 0.0, "standard_error": 0.0, "unit": "N m", "steady": True},
    "slip": {"mean": None, "standard_error": None, "unit": "", "steady": False}}}


class FurrowPost(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        write_history(cls.folder / "history.h5")
        write_rut(cls.folder / "history.h5", diameter=0.016)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_post(self, *words):
        return subprocess.run([str(FURROW_POST), *map(str, words)], capture_output=True, text=True, timeout=240)

    def check_picture(self, path, least_colours):
        pixels = matplotlib.image.imread(path)[:, :, :3]
        self.assertGreater(min(pixels.shape[:2]), 900)
        colours = np.unique((pixels * 15).astype(int).reshape(-1, 3), axis=0)
        self.assertGreater(len(colours), least_colours)
        self.assertGreater((pixels.min(axis=2) < 0.9).mean(), 0.01)  # not blank

    def test_plot(self):
        done = self.run_post("plot", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_picture(self.folder / "histories.png", 20)

    def test_picture(self):
        done = self.run_post("picture", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_picture(self.folder / "rut.png", 200)

    def test_resistance_is_that_of_the_program_and_of_the_signal(self):
        done = self.run_post("resistance", "--csv", self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        names, values = (line.split(",") for line in done.stdout.strip().splitlines())
        row = dict(zip(names, values))
        for name, mean in (("sinkage", 0.02), ("resistance_coefficient", 0.2), ("slip", 0.1), ("drive_torque", 3.0)):
            error = float(row[name + "_error"])
            self.assertGreater(error, 0.0)
            self.assertLess(abs(float(row[name]) - mean), 4 * error, name)
        self.assertEqual(row["steady"], "1")

    def copy(self, name):
        folder = self.folder / name
        folder.mkdir()
        shutil.copy(self.folder / "history.h5", folder)
        return folder

    def test_plot_marks_the_means_of_the_summary(self):
        folder = self.copy("summarised")
        words = ("plot", folder, "--format", "svg")
        self.assertEqual(self.run_post(*words).returncode, 0)
        self.assertNotIn("not steady", (folder / "histories.svg").read_text())
        (folder / "summary.json").write_text(json.dumps(SUMMARY))
        done = self.run_post(*words)
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = (folder / "histories.svg").read_text()
        self.assertIn("sinkage 20.00 ± 0.16 mm, resistance coefficient 0.200 ± 0.004, not all steady, see summary.txt", drawn)
        self.assertIn("mean 20.00 ± 0.16 (not steady)", drawn)

    def test_faulty_parts(self):
        folder = self.copy("faulty")
        with h5py.File(folder / "history.h5", "a") as content:
            del content["history/slip"]
            del content["surface"]
        done = self.run_post("plot", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("has no channel slip; plot needs the history of a wheel on a rig", done.stderr)
        self.assertEqual(self.run_post("picture", folder).returncode, 0)  # without a wheel
        self.check_picture(folder / "rut.png", 200)
        (folder / "summary.json").write_text("{")
        done = self.run_post("picture", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("summary.json: cannot be read", done.stderr)

    def test_errors(self):
        missing = self.run_post("plot", self.folder / "nowhere")
        self.assertEqual(missing.returncode, 1)
        self.assertIn("no such file; name the results folder", missing.stderr)
        (self.folder / "text").mkdir(exist_ok=True)
        (self.folder / "text" / "history.h5").write_text("not HDF5")
        wrong = self.run_post("picture", self.folder / "text")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("is not a results file of Furrow", wrong.stderr)
        (self.folder / "bare").mkdir(exist_ok=True)
        write_history(self.folder / "bare" / "history.h5", rows=100)
        bare = self.run_post("picture", self.folder / "bare")
        self.assertEqual(bare.returncode, 1)
        self.assertIn("has no /grains/reference", bare.stderr)
        short = self.run_post("resistance", self.folder / "bare")
        self.assertEqual(short.returncode, 1)
        unknown = self.run_post("paint", self.folder)
        self.assertEqual(unknown.returncode, 2)


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parent))
    unittest.main()
