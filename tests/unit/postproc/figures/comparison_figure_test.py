# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures with more panels than anybody has drawn yet, and with nothing to show."""

import itertools
import unittest
from pathlib import Path

import h5py
import numpy as np

from furrow_post.analyse.comparison import compare
from furrow_post.figures.comparison_figure import draw_comparison
from furrow_post.figures.cost_figure import draw_cost
from furrow_post.figures.style import panel_letters
from furrow_post.read.wheel_run import read_wheel_run
from support.folder import FolderTest
from support.runs import rig, rigid_wheel, style, write_run
from support.tables import row


def write_wheel_on_terrain(folder: Path) -> None:
    """On a flat layer of terrain of 0.2 m, cells of 5 cm."""
    soil = {"cell": 0.05, "length": 2.0, "width": 1.0, "depth": 0.2, "symmetry": False}
    styles = [rigid_wheel(), rig(), style("terrain", "terrain/continuum", "soil", **soil)]
    write_run(folder, styles=styles)
    edges = (np.arange(-1.0, 1.2, 0.05), np.arange(-0.5, 0.5, 0.05), np.arange(-0.2, 0.0, 0.05))
    x = np.stack(np.meshgrid(*edges, indexing="ij"), axis=-1).reshape(-1, 3)
    one = np.ones(len(x))
    with h5py.File(folder / "terrain.h5", "w") as content:
        content["run/styles"] = np.bytes_(b"[]")
        for name, values in (
            ("x", x),
            ("initial_position", x),
            ("density", 200 * one),
            ("volume", 0.05**3 * one),
            ("compaction", 0 * one),
        ):
            content[f"terrain/{name}"] = values


class ComparisonFigureTest(FolderTest):
    def test_five_grounds_have_panels(self) -> None:
        runs = []
        for name in "abcde":
            write_wheel_on_terrain(self.folder / name)
            runs.append(read_wheel_run(self.folder / name))
        self.assertAlmostEqual(runs[0].number("density"), 200)
        target = self.folder / "compare.png"
        draw_comparison(compare(runs), target)
        self.assertGreater(target.stat().st_size, 50000)

    def test_panel_letters_continue_after_z(self) -> None:
        letters = list(itertools.islice(panel_letters(), 30))
        self.assertEqual(letters[:2] + letters[25:28], ["a", "b", "z", "aa", "ab"])
        self.assertEqual(len(set(letters)), 30)


class CostFigureTest(FolderTest):
    def test_table_without_a_known_error_is_drawn(self) -> None:
        target = self.folder / "cost.png"
        draw_cost([row("a", "grains", 0.04, 0.1, 0.2, 1.0)], target)
        self.assertGreater(target.stat().st_size, 10000)


if __name__ == "__main__":
    unittest.main()
