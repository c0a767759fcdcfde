# SPDX-License-Identifier: GPL-2.0-or-later
"""A film of a made run: as many frames as the run wrote, which differ; what it refuses."""

import os
import shutil
import subprocess
import unittest

import numpy as np

from furrow_post.figures.film import MovingPictures
from furrow_post.read.motion import read_motion
from support.command import run_post
from support.folder import FolderTest
from support.motion import FRAMES, write_moving_run, write_rolling_wheel
from support.runs import RADIUS

WIDTH, HEIGHT = 960, 540


def wheel_area(pictures: MovingPictures) -> float:
    """[m2] of what looks like a wheel."""
    picture = pictures.rgb(0.0)[120:].astype(int)
    red, blue = picture[:, :, 0], picture[:, :, 2]
    return float(np.count_nonzero((blue - red > 5) & (blue < 200)) * pictures.pixel**2)


class FilmTest(FolderTest):
    def setUp(self) -> None:
        super().setUp()
        self.run_folder = write_moving_run(self.folder / "run", "continuum")

    def test_film_has_the_frames_of_the_run(self) -> None:
        film = self.folder / "film.mp4"
        done = run_post("film", self.run_folder, film)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, f"{film} ({FRAMES} frames)\n")
        decoded = subprocess.run(
            ["ffmpeg", "-loglevel", "error", "-i", film, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
            stdout=subprocess.PIPE,
            check=True,
        ).stdout
        frames = np.frombuffer(decoded, np.uint8).reshape(-1, HEIGHT, WIDTH, 3).astype(int)
        self.assertEqual(len(frames), FRAMES)
        # The density grows from one end of the scale to the other: from sand to dark violet
        red, green, blue = (frames[:, 120:, :, k] for k in range(3))
        sand, violet = red - blue > 20, np.minimum(red, blue) - green > 20
        for colour, frame, other in ((sand, 0, -1), (violet, -1, 0)):
            self.assertGreater(colour[frame].mean(), 0.02)
            self.assertLess(colour[other].mean(), 0.005)

    def test_film_shows_every_wheel(self) -> None:
        alone = MovingPictures(read_motion(self.run_folder))
        write_rolling_wheel(self.run_folder / "rear", 3 * RADIUS)
        both = MovingPictures(read_motion(self.run_folder))
        areas = [wheel_area(pictures) for pictures in (alone, both)]
        self.assertAlmostEqual(areas[1] / areas[0], 2.0, delta=0.3)

    def test_faults_are_one_line(self) -> None:
        cases = (
            (["film", self.run_folder, "x.gif"], "x.gif: its name must end in .mp4"),
            (["film", self.run_folder, "none/x.mp4"], "there is no folder none; make it first"),
            (["film", self.folder], "has no results; name the results folder of a run"),
        )
        for words, said in cases:
            done = run_post(*words)
            self.assertEqual(done.returncode, 1, words)
            self.assertIn(said, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        shutil.rmtree(self.run_folder / "vtk")
        done = run_post("film", self.run_folder)
        self.assertIn("repeat the run with 'vtk N'", done.stderr)

    def test_missing_ffmpeg_is_reported(self) -> None:
        path = os.environ["PATH"]
        os.environ["PATH"] = str(self.folder)
        self.addCleanup(os.environ.__setitem__, "PATH", path)
        done = run_post("film", self.run_folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("ffmpeg is missing; install Debian's package", done.stderr)


if __name__ == "__main__":
    unittest.main()
