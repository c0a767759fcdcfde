# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/tyre_shift: the motion of a tread as a whole, told from that of its nodes."""

import math
import tempfile
import unittest
from pathlib import Path

import numpy as np

from furrow_post.errors import ResultsError
from support.evaluation import evaluation

run = evaluation("tyre_shift")


class ShiftTest(unittest.TestCase):
    def setUp(self) -> None:
        angle = 2 * np.pi * np.arange(run.AROUND) / run.AROUND
        self.angle = np.tile(angle, 2)
        across = np.repeat([-0.03, 0.03], run.AROUND)
        self.ring = np.stack([0.35 * np.sin(self.angle), across, -0.35 * np.cos(self.angle)], 1)
        self.axle = np.array([2.0, 0.0, 0.3])

    def test_waves_other_than_one_do_not_move_the_whole(self) -> None:
        """Translation by (-1, 0, 4) mm and three radial waves of which none translates."""
        moved = self.ring + self.axle + [-1e-3, 0, 4e-3]
        radial = self.ring * [1, 0, 1] / 0.35
        for waves, size in ((0, 1e-3), (2, 5e-3), (3, 2e-3)):
            moved += size * np.cos(waves * self.angle)[:, None] * radial
        edge = self.ring + self.axle + [0, 0.07, 0]
        nodes = run.outside(np.vstack([moved, edge[run.AROUND :]]), self.axle)
        forward, upward = run.shift(nodes, self.axle)
        self.assertAlmostEqual(forward, -1.0, 6)
        self.assertAlmostEqual(upward, 4.0, 6)

    def test_half_a_ring_is_refused(self) -> None:
        with self.assertRaisesRegex(ResultsError, "no rings of 36"):
            run.shift(self.ring[:50], self.axle)

    def test_frequency_gives_the_static_shift(self) -> None:
        """A mass on a spring: omega^2 m = F/u; the mode along the axle is not taken."""
        frequency = math.sqrt(run.LOAD / (5e-3 * run.TREAD_MASS)) / (2 * math.pi)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "241kPa_0N_modes.csv"
            file.write_text(
                "# modes\nmode,frequency_Hz,waves,radial,circumferential,axial\n"
                f"1,41.6,1,0.02,0.02,0.96\n2,{frequency},1,0.46,0.54,0.001\n",
                encoding="utf-8",
            )
            self.assertAlmostEqual(run.shift_by_mode(Path(folder)), 5.0, 9)
            self.assertEqual(run.modes(Path(folder)), {"tilting": 41.6, run.SHAKING: frequency})


if __name__ == "__main__":
    unittest.main()
