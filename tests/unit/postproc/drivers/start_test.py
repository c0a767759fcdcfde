# SPDX-License-Identifier: GPL-2.0-or-later
"""Every driver under inputs starts: its help, and its list of runs without any run."""

import subprocess
import sys
import tempfile
import unittest

from furrow_post.cli.study_command import study_folders
from support.command import SOURCE, run_post

INPUTS = SOURCE / "inputs"
STUDIES = study_folders(SOURCE)
TOOLS = (
    INPUTS / "laboratory" / "run.py",
    INPUTS / "laboratory" / "calibrate.py",
    INPUTS / "laboratory" / "identify.py",
    INPUTS / "validation" / "snow_wheel" / "identify.py",
    INPUTS / "validation" / "grains" / "plate_layers.py",
    INPUTS / "validation" / "grains" / "track_density.py",
)


def start(*words: object) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True, timeout=120, cwd=SOURCE)


class DriversTest(unittest.TestCase):
    def test_drivers_exist_for_all_studies(self) -> None:
        self.assertEqual(len(STUDIES), 29)

    def test_help_is_printed(self) -> None:
        for driver in TOOLS:
            with self.subTest(driver=driver):
                done = start(driver, "--help")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("usage:", done.stdout.lower())

    def test_list_has_every_run_once(self) -> None:
        with tempfile.TemporaryDirectory() as results:
            for place in STUDIES:
                with self.subTest(place=place):
                    done = run_post("study", place, "--list", "--results", results, folder=SOURCE)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    names = [line.split()[1] for line in done.stdout.splitlines()]
                    self.assertGreaterEqual(len(names), 0 if place == INPUTS / "validation" else 4)  # tables alone
                    self.assertEqual(len(names), len(set(names)))
                    self.assertLessEqual({line.split()[0] for line in done.stdout.splitlines()}, {"missing"})

    def test_laboratory_lists_tests_and_grounds(self) -> None:
        done = start(INPUTS / "laboratory" / "run.py", "--list")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("oedometer", done.stdout)
        self.assertIn("sand_dry", done.stdout)


if __name__ == "__main__":
    unittest.main()
