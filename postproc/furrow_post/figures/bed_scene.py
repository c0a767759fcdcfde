# SPDX-License-Identifier: GPL-2.0-or-later
"""A bed of grains that a wheel has rolled over: grains, how far each has moved, heights, the rut."""

import warnings

import numpy as np
from matplotlib.colors import Normalize
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import minimum_filter

from ..arrays import Floats, Integers
from ..read.results import Results
from .canvas import View, top_heights
from .style import GROUND_COLOURS, round_up


class BedScene:
    """Data that all panels share: grains, displacement, wheel, bed level, the box in plan.

    x (n, 3), radius, moved (n) [m]; low, high: corners (3) of the bed before [m]; heights: of the
    ground over the bed level on a grid in plan with cells of cell [m], row 0 at the lowest y.
    """

    def __init__(self, results: Results) -> None:
        """@raises ResultsError when the run kept no grains"""
        reference, final = results.grains("reference"), results.grains("final")
        self.x, self.radius = final.x, final.radius
        self.moved: Floats = np.linalg.norm(final.displacement_from(reference), axis=1)
        self.diameter = float(2 * self.radius.mean())
        self.low, self.high = reference.corners
        surface = results.surface()
        self.surface = None if surface is None else reference.image_of(surface)
        self.cell = 0.5 * self.diameter
        if np.isfinite(reference.bed_level):
            self.bed_level = reference.bed_level
        else:
            self.bed_level = float(np.nanmedian(self._heights(reference.x, reference.radius)))
        self.heights = self._heights(self.x, self.radius) - self.bed_level
        # a bed that was renewed completely has no known displacement
        self.followed = bool(np.isfinite(self.moved).any())
        largest = float(np.nanpercentile(self.moved, 99.5)) if self.followed else 1.0
        self.range = Normalize(0, round_up(largest))
        if self.surface is not None:
            self.wheel_low: Floats = self.surface.x.min(axis=0)
            self.wheel_high: Floats = self.surface.x.max(axis=0)

    def _heights(self, x: Floats, radius: Floats) -> Floats:
        return top_heights(x, radius, self.low[:2], self.high[:2], self.cell)

    @property
    def middle(self) -> float:
        """y of the lengthwise section: the wheel's middle plane, or the bed's [m]."""
        if self.surface is None:
            return float(0.5 * (self.low[1] + self.high[1]))
        return float(0.5 * (self.wheel_low[1] + self.wheel_high[1]))

    @property
    def cross_section(self) -> float:
        """x of the cross section: where the rut is deepest on average, clear of the wheel [m]."""
        rows = np.abs(self._cell_middles(1) - self.middle) < 0.25 * self._rut_width()
        with warnings.catch_warnings(action="ignore"):  # columns without a height
            profile = np.nanmean(self.heights[rows], axis=0)
        x = self._cell_middles(0)
        if self.surface is not None:
            clear = (x < self.wheel_low[0]) | (x > self.wheel_high[0])
            profile = np.where(clear, profile, np.nan)
        if not np.isfinite(profile).any():
            return float(0.5 * (self.low[0] + self.high[0]))
        width = max(int(4 * self.diameter / self.cell), 1)
        smooth = np.convolve(np.nan_to_num(profile), np.ones(width) / width, "same")
        smooth[~np.isfinite(profile)] = np.inf
        return float(x[np.argmin(smooth)])

    def _rut_width(self) -> float:
        if self.surface is not None:
            return float(self.wheel_high[1] - self.wheel_low[1])
        return float(0.2 * (self.high[1] - self.low[1]))

    def _cell_middles(self, axis: int) -> Floats:
        middles: Floats = self.low[axis] + self.cell * (np.arange(self.heights.shape[1 - axis]) + 0.5)
        return middles

    def smooth_heights(self) -> Floats:
        """Heights with the pits between single grains filled: medians of 3 x 3 cells, of those that have a value."""
        padded = np.pad(self.heights, 1, constant_values=np.nan)
        around = sliding_window_view(padded, (3, 3)).reshape(*self.heights.shape, 9)
        with warnings.catch_warnings(action="ignore"):  # columns without a value
            median: Floats = np.nanmedian(around, axis=2)
        return median

    def colours(self, values: Floats) -> Floats:
        """(n, 4) RGBA of displacements (n) [m]."""
        colours: Floats = GROUND_COLOURS(self.range(np.nan_to_num(values)))
        return colours

    def visible_from(self, view: View) -> Integers:
        """Grains that are not buried: near the surface, or near a side of the box in view."""
        depth = 4 * self.diameter
        rows, columns = self.heights.shape
        column = ((self.x[:, 0] - self.low[0]) / self.cell).astype(int).clip(0, columns - 1)
        row = ((self.x[:, 1] - self.low[1]) / self.cell).astype(int).clip(0, rows - 1)
        heights = np.nan_to_num(self.heights, nan=-np.inf)
        lowest = minimum_filter(heights, 2 * int(depth / self.cell) + 1, mode="nearest")
        shown = self.x[:, 2] > lowest[row, column] + self.bed_level - depth
        for axis in (0, 1):
            x, low, high = self.x[:, axis], self.low[axis], self.high[axis]
            outside = (x < low) | (x > high)
            near = x < low + depth if view.towards[axis] < 0 else x > high - depth
            shown |= near | outside
        return np.flatnonzero(shown)
