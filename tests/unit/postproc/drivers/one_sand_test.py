# SPDX-License-Identifier: GPL-2.0-or-later
"""inputs/validation/one_sand: verdicts, labels, the column that collapses."""

import math
import unittest
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy as np
import pandas

from furrow_post.study.values import DEFINITION, load_yaml
from furrow_post.read.terrain import Terrain
from furrow_post.tables.ground_measures import deposit
from furrow_post.tables.engine import Engine, Tables
from support.evaluation import VALIDATION, evaluation

study = evaluation("one_sand")


class MatrixTest(unittest.TestCase):
    def test_error_above_the_goal_gives_no_verdict(self) -> None:
        self.assertEqual(study.verdict(0.05, 0.02, 0.1), "met")
        self.assertEqual(study.verdict(0.05, 0.2, 0.1), "inconclusive")
        self.assertEqual(study.verdict(-0.2, 0.06, 0.1), "inconclusive")
        self.assertEqual(study.verdict(-0.23, 0.06, 0.1), "missed")
        self.assertEqual(study.verdict(math.nan, math.nan, 0.1), "")

    def test_rows_have_label_error_and_verdict_of_each_law(self) -> None:
        folder = VALIDATION / "one_sand"
        engine = Engine(folder, load_yaml(folder / DEFINITION), study)
        tables = Tables(engine)
        test = {"test": "extension", "at": "medium, 20 kPa", "quantity": "sin phi at peak"}
        plate = {"test": "plate", "at": "60 mm at 10 mm", "quantity": "pressure"}
        rows = [("norsand", 0, 0.54), ("cap", 0, 0.5), ("grains", 0, 0.49), ("grains", 0, 0.51)]
        cells = [("norsand", 0.01, 1000.0), ("norsand", 0.015, 1200.0), ("cap", 0.01, 800.0)]
        tables["values"] = pandas.DataFrame(
            [{**plate, "source": s, "size": size, "value": v} for s, size, v in (*cells, ("grains", 0, 1000.0))]
            + [{**test, "source": s, "size": size, "value": v} for s, size, v in rows]
        )
        tables["cone_of_grains"] = pandas.DataFrame(study.cone_of_card(None))
        row, other = engine.derived("results.csv", tables).to_dict("records")
        labels = row["test"], row["norsand_label"], row["cap_label"]
        self.assertEqual(labels, ("extension", "known", "fitted"))
        self.assertEqual((row["norsand"], row["norsand_error"], row["grains_error"]), ("0.54", "0", "0.01"))
        self.assertEqual((row["norsand_off"], row["norsand_verdict"], row["cap_verdict"]), (0.08, "met", "met"))
        self.assertEqual((other["norsand_error"], other["cap_error"], other["grains"]), ("2e+02", "0", "1000"))

    def test_heightmap_is_a_cylinder_in_the_middle(self) -> None:
        lines = study.heightmap(0.42, 0.08).splitlines()
        heights = np.array([[float(cell) for cell in line.split()] for line in lines[5:]])
        self.assertEqual(heights.shape, (85, 85))
        self.assertEqual(lines[2], "xllcenter -0.21")
        np.testing.assert_array_equal(heights, heights[::-1, ::-1])
        # a circle of 16 steps, counted in squares
        self.assertAlmostEqual(heights.sum() / 0.08 / (math.pi * 16**2), 1.0, delta=0.02)

    def test_deposit_ends_at_its_thin_edge(self) -> None:
        """A cone of 0.08 m height and 0.16 m radius on a layer: 5 mm thick at 0.15 m."""
        step = 0.002
        places = np.arange(-0.2, 0.2, step) + step / 2
        x, y = (part.ravel() for part in np.meshgrid(places, places))
        thickness = 0.03 + np.maximum(0.08 - np.hypot(x, y) / 2, 0.0)
        terrain = SimpleNamespace(x=np.column_stack([x, y, thickness]), volume=thickness * step**2)
        with mock.patch.object(Terrain, "read", return_value=terrain):
            run: Any = SimpleNamespace(folder=None)
            found = deposit(run, radius=0.08, layer=0.03, reach=0.21, ring=0.01, thin=0.005)
        self.assertAlmostEqual(found["runout"], 0.15 - 0.08, delta=0.0024)
        self.assertAlmostEqual(found["top"], 0.08 - 0.02 / 3, delta=0.0008)
        self.assertAlmostEqual(found["slope"], math.degrees(math.atan(0.5)), delta=0.3)


if __name__ == "__main__":
    unittest.main()
