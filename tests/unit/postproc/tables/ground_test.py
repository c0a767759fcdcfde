# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of the continuum: places of greatest stress and zones of flow of made-up ground."""

import unittest
from typing import Any

import h5py
import numpy as np

from furrow_post.tables.ground_measures import flow_zones, mean_of_instants, stress_layers
from support.evaluation import run_in
from support.folder import FolderTest
from support.rut import wheel

ZONES: dict[str, Any] = {"near": 0.3, "depths": (0.019, 0.094), "greatest": 20, "under": (0.08, 0.03), "beside": (0.10, 0.20)}

SPACING, DEPTH, AXLE, AHEAD = 0.0125, 0.25, 0.5, 0.05  # [m]


class ZonesTest(FolderTest):
    """Compression is greatest 5 cm ahead; what is ahead of the axle moves forward, the rest back
    at a third of the speed."""

    def setUp(self) -> None:
        super().setUp()
        axes = [np.arange(0.5 * SPACING, length, SPACING) for length in (1.0, 0.25, DEPTH)]
        x = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
        ones = np.ones(len(x))
        size = np.exp(-(((x[:, 0] - AXLE - AHEAD) / 0.1) ** 2) - (x[:, 1] / 0.1) ** 2)
        with h5py.File(self.folder / "terrain.h5", "w") as content:
            content["run/styles"] = np.bytes_(b"[]")
            group = content.create_group("terrain")
            group["x"] = group["initial_position"] = x
            group["density"], group["volume"] = 1500 * ones, SPACING**3 * ones
            group["mises"] = size
            group["principal_stress"] = np.stack([2e3 * ones, 0 * ones, -1e5 * size], axis=1)
            group["tension_axis"] = np.tile([0.0, 1.0, 0.0], (len(x), 1))
            group["compression_axis"] = np.tile([0.0, 0.0, 1.0], (len(x), 1))
            ahead = x[:, 0] > AXLE
            group["v"] = np.stack([np.where(ahead, 0.6, -0.2), 0 * ones, 0 * ones], axis=1)
        triangles, surface = wheel(0.3, 0.2, [AXLE, 0.0, DEPTH + 0.28])
        with h5py.File(self.folder / "history.h5", "w") as content:
            content["surface/triangles"], content["surface/x"] = triangles, surface

    def test_zones_of_stress_are_located(self) -> None:
        for row in stress_layers(self.folder, **ZONES):
            self.assertAlmostEqual(float(str(row["compression_ahead_mm"])), 50, delta=7)
            self.assertAlmostEqual(float(str(row["largest_beside_kPa"])), 2.0)
            # straight aside at the surface, across the way to the contact below it
            away = float(str(row["away_beside"]))
            depth = 1e-3 * float(str(row["depth_mm"]))
            self.assertAlmostEqual(away, 0.15 / np.hypot(0.15, depth), delta=0.12)

    def test_zones_of_flow_are_located(self) -> None:
        run = run_in(self.folder)
        row = flow_zones(run, 2.0, 0.3, 0.02, 0.05)
        self.assertAlmostEqual(float(str(row["forward_share"])), 0.75, 2)
        self.assertAlmostEqual(float(str(row["forward_at_mm"])), 150, delta=2)
        self.assertAlmostEqual(float(str(row["backward_at_mm"])), -150, delta=2)
        still = flow_zones(run, 100.0, 0.3, 0.02, 0.05)
        self.assertNotIn("backward_at_mm", still)


class InstantsTest(unittest.TestCase):
    def test_mean_has_the_standard_error_of_its_instants(self) -> None:
        instants: list[list[dict[str, object]]] = [
            [{"depth_mm": depth, "shear_ahead_mm": depth + n} for depth in (47, 84)] for n in (0, 1, 2, 3)
        ]
        first, second = mean_of_instants(instants, "away")
        self.assertEqual((first["depth_mm"], second["depth_mm"]), (47, 84))
        self.assertEqual((first["shear_ahead_mm"], second["shear_ahead_mm"]), (48.5, 85.5))
        # half of the standard deviation, which is the square root of 5/3
        self.assertEqual(first["shear_ahead_mm_error"], 0.65)


if __name__ == "__main__":
    unittest.main()
