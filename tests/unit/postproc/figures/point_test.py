# SPDX-License-Identifier: GPL-2.0-or-later
"""Figures of fits: what is drawn has the unit of its axis."""

import unittest
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from furrow_post.figures.point_figure import _draw_fitted_curve

MEASURED = np.array([10e3, 20e3, 40e3])  # [Pa]


class FittedCurveTest(unittest.TestCase):
    def drawn(self, **deviation: float) -> tuple[Any, str]:
        """Half lengths of the error bars, and the label of their axis."""
        curve = {
            "driven": np.array([0.01, 0.02, 0.03]),
            "driven_by": "eps_axial",
            "compared": "stress_axial [Pa]",
            **{name: MEASURED for name in ("measured", "start", "fitted")},
            **deviation,
        }
        figure, axes = plt.subplots()
        self.addCleanup(plt.close, figure)
        _draw_fitted_curve(axes, curve)
        (bars,) = axes.containers
        _, _, (lines,) = bars.lines
        ends = np.array([[low[1], high[1]] for low, high in lines.get_segments()])
        return 0.5 * (ends[:, 1] - ends[:, 0]), axes.get_ylabel()

    def test_error_bars_have_the_unit_of_the_axis(self) -> None:
        bars, label = self.drawn(deviation=3e3, relative=0.0)
        self.assertEqual(label, "stress axial [kPa]")
        np.testing.assert_allclose(bars, 3.0)

    def test_relative_error_bars_grow_with_the_value(self) -> None:
        bars, _ = self.drawn(deviation=0.1, relative=1.0)
        np.testing.assert_allclose(bars, [1.0, 2.0, 4.0])


if __name__ == "__main__":
    unittest.main()
