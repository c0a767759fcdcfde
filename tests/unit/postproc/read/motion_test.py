# SPDX-License-Identifier: GPL-2.0-or-later
"""Frames of a run: what VTK wrote is what is read; frames that are damaged or not there."""

import unittest

import h5py
import numpy as np

from furrow_post.errors import ResultsError
from furrow_post.read.motion import read_motion
from furrow_post.read.vtk import read_frames, read_vtp
from support.folder import FolderTest
from support.motion import (
    FRAMES,
    INTERVAL,
    ground,
    settlement,
    wheel,
    write_moving_run,
    write_rolling_wheel,
    write_vtp,
)
from support.runs import write_run


class MotionTest(FolderTest):
    def test_vtk_file_has_points_triangles_and_fields(self) -> None:
        random = np.random.default_rng(5)
        for count in (1, 7, 9000):  # the last in several blocks of zlib
            with self.subTest(count=count):
                x = random.normal(size=(count, 3))
                triangles = random.integers(0, count, (2 * count, 3))
                number, force = np.arange(count), random.normal(size=(count, 3))
                write_vtp(self.folder / "a.vtp", x, triangles, id=number, force=force)
                found = read_vtp(self.folder / "a.vtp")
                np.testing.assert_array_equal(found.x, x)
                np.testing.assert_array_equal(found.triangles, triangles)
                np.testing.assert_array_equal(found.fields["id"], number)
                np.testing.assert_array_equal(found.fields["force"], force)

    def test_frames_equal_those_of_the_run(self) -> None:
        for kind in ("grains", "continuum"):
            motion = read_motion(write_moving_run(self.folder / kind, kind))
            np.testing.assert_allclose(motion.times, INTERVAL * np.arange(FRAMES))
            (cloud,) = motion.clouds
            self.assertEqual(cloud.kind, kind)
            self.assertEqual(cloud.mirrored, kind == "continuum")
            for time in motion.times:
                points, moved = cloud.at(time), settlement(ground(), time)
                np.testing.assert_allclose(points.x, ground() + moved)
                np.testing.assert_allclose(
                    points.fields["displacement"], np.linalg.norm(moved, axis=1)
                )
                (body,) = motion.bodies
                np.testing.assert_allclose(body.at(time).x, wheel(time)[0])
            # between two frames: the earlier one
            np.testing.assert_array_equal(cloud.at(0.19).x, cloud.at(0.1).x)

    def test_wheels_of_one_run_roll_together(self) -> None:
        run = write_moving_run(self.folder / "run")
        write_rolling_wheel(run / "rear", 1.5)
        other = run / "of_another_run"
        write_rolling_wheel(other, 3.0)
        with h5py.File(other / "history.h5", "a") as content:
            del content["run/effective_input"]
            content["run/effective_input"] = "another"
        motion = read_motion(run)
        self.assertEqual(len(motion.bodies), 2)
        for time in motion.times:
            for body, behind in zip(motion.bodies, (0.0, 1.5)):
                np.testing.assert_allclose(body.at(time).x, wheel(time)[0] - [behind, 0, 0])

    def test_run_without_frames_shows_its_end(self) -> None:
        write_run(self.folder / "still")
        with self.assertRaisesRegex(ResultsError, "has nothing to look at; .*'vtk N'"):
            read_motion(self.folder / "still")
        with self.assertRaisesRegex(ResultsError, "has no results; name the results folder"):
            read_motion(self.folder)
        self.assertIsNone(read_frames(self.folder / "wheel.pvd"))

    def test_damaged_frames_are_named(self) -> None:
        motion = read_motion(write_moving_run(self.folder / "run"))
        frame = self.folder / "run" / "vtk" / "grains_0.vtp"
        whole = frame.read_bytes()
        spot = whole.index(b"_", whole.index(b"<AppendedData")) + 40  # in the first array
        cases = {
            "cut short": whole[: 2 * len(whole) // 3],
            "no head": whole[200:],
            "a byte changed": whole[:spot] + bytes([whole[spot] ^ 255]) + whole[spot + 1 :],
            "empty": b"",
            "one field shorter": whole.replace(b'Name="radius"', b'Name="radios"'),
        }
        for what, content in cases.items():
            with self.subTest(what):
                frame.write_bytes(content)
                with self.assertRaisesRegex(ResultsError, r"grains_0\.vtp: .*; repeat the run"):
                    motion.clouds[0].at(0.0)
        (self.folder / "run" / "vtk" / "grains.pvd").write_text("<VTKFile>")
        with self.assertRaisesRegex(ResultsError, r"grains\.pvd: is damaged"):
            read_motion(self.folder / "run")


if __name__ == "__main__":
    unittest.main()
