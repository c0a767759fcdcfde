# SPDX-License-Identifier: GPL-2.0-or-later
"""The rut in a bed of grains in four views."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import Normalize, TwoSlopeNorm
from matplotlib.figure import Figure

from ..arrays import Floats, Integers
from ..errors import ResultsError
from ..read.results import Results, Surface
from . import render
from .style import (
    CENTIMETRE,
    GROUND_COLOURS,
    MILLIMETRE,
    WHEEL_COLOUR,
    annotate_panel,
    save,
    use_style,
)

WIDTH = 11.0  # of the figure [inch]
HEAD = 0.95  # of its title [inch]


class Scene:
    """What all panels share: grains, displacement, wheel, bed level, the box in plan.

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
        # none is known in a bed that was renewed as a whole
        self.followed = bool(np.isfinite(self.moved).any())
        largest = float(np.nanpercentile(self.moved, 99.5)) if self.followed else 1.0
        self.range = Normalize(0, render.round_up(largest))
        if self.surface is not None:
            self.wheel_low: Floats = self.surface.x.min(axis=0)
            self.wheel_high: Floats = self.surface.x.max(axis=0)

    def _heights(self, x: Floats, radius: Floats) -> Floats:
        return render.top_heights(x, radius, self.low[:2], self.high[:2], self.cell)

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
        counted = rows[:, None] & np.isfinite(self.heights)
        total = np.where(counted, self.heights, 0.0).sum(axis=0)
        count = counted.sum(axis=0)
        profile = np.where(count > 0, total / np.maximum(count, 1), np.nan)
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
        middles: Floats = self.low[axis] + self.cell * (
            np.arange(self.heights.shape[1 - axis]) + 0.5
        )
        return middles

    def colours(self, values: Floats) -> Floats:
        """(n, 4) RGBA of displacements (n) [m]."""
        colours: Floats = GROUND_COLOURS(self.range(np.nan_to_num(values)))
        return colours

    def visible_from(self, view: render.View) -> Integers:
        """Grains that are not buried: near the surface, or near a side of the box in view."""
        depth = 4 * self.diameter
        rows, columns = self.heights.shape
        column = ((self.x[:, 0] - self.low[0]) / self.cell).astype(int).clip(0, columns - 1)
        row = ((self.x[:, 1] - self.low[1]) / self.cell).astype(int).clip(0, rows - 1)
        heights = np.nan_to_num(self.heights, nan=-np.inf)
        lowest = _lowest_around(heights, int(depth / self.cell))
        shown = self.x[:, 2] > lowest[row, column] + self.bed_level - depth
        for axis in (0, 1):
            x, low, high = self.x[:, axis], self.low[axis], self.high[axis]
            outside = (x < low) | (x > high)
            near = x < low + depth if view.towards[axis] < 0 else x > high - depth
            shown |= near | outside
        return np.flatnonzero(shown)


def draw_picture(results: Results, numbers: str, target: Path, pixels: int = 1500) -> None:
    """Draws the picture of a run.

    numbers: a line of results for the title, or ""; pixels: width of the oblique view. @raises
    ResultsError when the run kept no grains
    """
    use_style()
    if not all(len(results.grains(when).id) for when in ("reference", "final")):
        raise ResultsError(f"{results.file}: lists no grains; there is nothing to draw")
    scene = Scene(results)
    cross = scene.cross_section
    figure = plt.figure(layout="constrained")
    grid = figure.add_gridspec(3, 2, height_ratios=[1, 1, 1], width_ratios=[1, 1.6])
    oblique, lengthwise = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :])
    across, above = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])

    _draw_oblique(oblique, scene, pixels)
    if scene.followed:
        scale = ScalarMappable(Normalize(0, MILLIMETRE * scene.range.vmax), GROUND_COLOURS)
        bar = figure.colorbar(scale, ax=oblique, extend="max", fraction=0.03, pad=0.01, shrink=0.8)
        bar.set_label("displacement of grains [mm]")
    _draw_section(lengthwise, scene, 1, scene.middle)
    _draw_section(across, scene, 0, cross)
    _draw_height_map(figure, above, scene, cross)

    # Heights of the panels [inch] from the shape of the bed, so that little paper stays empty
    bottom_row = max(0.34 * WIDTH * _aspect(across), 0.48 * WIDTH * _aspect(above)) + 0.7
    tall = [
        min(height, 9.0)
        for height in (
            0.9 * WIDTH * _aspect(oblique) + 0.3,
            0.95 * WIDTH * _aspect(lengthwise) + 0.7,
            bottom_row,
        )
    ]
    height = HEAD + sum(tall)
    figure.set_size_inches(WIDTH, height)
    grid.set_height_ratios(tall)

    along_title = f"lengthwise, y = {CENTIMETRE * scene.middle + 0.0:.1f} cm"
    wheel = ", dashed: wheel" if scene.surface is not None else ""
    renewed = "" if scene.followed else "; the bed was renewed, displacements are not known"
    annotate_panel(oblique, "a", f"from behind{renewed}")
    annotate_panel(lengthwise, "b", f"{along_title}; dashed: bed level before")
    annotate_panel(across, "c", f"across, x = {CENTIMETRE * cross:.1f} cm")
    annotate_panel(above, "d", f"from above, pits between grains filled; dotted: sections{wheel}")

    length, breadth = CENTIMETRE * (scene.high - scene.low)[:2]
    count = f"{len(scene.x):,}".replace(",", "\u2009")
    size = f"mean diameter {MILLIMETRE * scene.diameter:.3g} mm"
    bed = f"{count} grains, {size}, bed {length:.0f} × {breadth:.0f} cm"
    for inches, line, look in (
        (0.12, results.title, {"fontsize": 15, "fontweight": "bold"}),
        (0.45, bed, {"fontsize": 10, "color": "0.35"}),
        (0.67, numbers, {"fontsize": 10}),
    ):
        figure.text(0.5, 1 - inches / height, line, ha="center", va="top", **look)
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - HEAD / height))
    save(figure, target)


def _aspect(axes: Axes) -> float:
    """Height over width of what axes with equal scales show."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    return float(abs((top - bottom) / (right - left)))


def _lowest_around(image: Floats, reach: int) -> Floats:
    """Least value within reach cells along both axes, the edge repeated."""
    for axis in (0, 1):
        first = np.repeat(image.take([0], axis), reach, axis)
        last = np.repeat(image.take([-1], axis), reach, axis)
        padded = np.concatenate([first, image, last], axis)
        size = image.shape[axis]
        shifted = [padded.take(range(k, k + size), axis) for k in range(2 * reach + 1)]
        image = np.minimum.reduce(shifted)
    return image


def _median_around(image: Floats) -> Floats:
    """Median of the 3 x 3 cells about each cell that have a value; NaN where none has.

    Fills the pits between single grains.
    """
    padded = np.pad(image, 1, constant_values=np.nan)
    rows, columns = image.shape
    shifted = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
    around = np.sort(shifted, axis=0)  # NaN last
    count = np.isfinite(around).sum(axis=0)
    low, high = (
        np.take_along_axis(around, np.minimum(place, 8)[None], 0)[0]
        for place in (np.maximum(count - 1, 0) // 2, count // 2)
    )
    median: Floats = 0.5 * (low + high)
    return median


def _draw_oblique(axes: Axes, scene: Scene, pixels: int) -> None:
    """The whole bed from behind and beside the wheel."""
    view = render.View.of_angles(-112.0, 30.0)
    shown = scene.visible_from(view)
    width = np.abs(view.right) @ (scene.high - scene.low)
    colours = scene.colours(scene.moved[shown])[:, :3]
    picture, extent = render.shaded_picture(
        scene.x[shown], scene.radius[shown], colours, scene.surface, view, width / pixels
    )
    axes.imshow(picture, extent=[CENTIMETRE * e for e in extent], interpolation="antialiased")
    axes.set_axis_off()
    axes.set_aspect("equal")
    _draw_scale_bar(axes, scene, view)


def _draw_scale_bar(axes: Axes, scene: Scene, view: render.View) -> None:
    """A length along the travel direction on the ground beside the bed, with an arrow."""
    bed_length = scene.high[0] - scene.low[0]
    length = render.round_up(0.2 * bed_length)
    start = np.array([scene.low[0], scene.low[1] - 0.06 * bed_length, scene.low[2]])
    ends = CENTIMETRE * view.project(np.array([start, start + [length, 0, 0]]))[:, :2]
    arrow = {"arrowstyle": "-|>", "color": "0.2", "lw": 1.4}
    axes.annotate("", ends[1], ends[0], arrowprops=arrow, annotation_clip=False)
    angle = np.degrees(np.arctan2(*(ends[1] - ends[0])[::-1]))
    below = (6 * np.sin(np.radians(angle)), -6 * np.cos(np.radians(angle)))  # the arrow [points]
    axes.annotate(
        f"{CENTIMETRE * length:g} cm along travel",
        ends.mean(axis=0),
        below,
        textcoords="offset points",
        rotation=angle,
        rotation_mode="anchor",
        ha="center",
        va="top",
        color="0.2",
        fontsize=8,
        annotation_clip=False,
    )
    axes.update_datalim(ends)


def _draw_section(
    axes: Axes, scene: Scene, axis: int, position: float, thickness: float = 2.0
) -> None:
    """Grains near the plane x[axis] = position, the wheel cut by the plane itself.

    position [m]; thickness of the slab in diameters
    """
    along = 1 - axis
    distance = np.abs(scene.x[:, axis] - position)
    inside = np.flatnonzero(distance < 0.5 * thickness * scene.diameter)
    inside = inside[np.argsort(-scene.x[inside, axis])]  # the nearest is drawn last
    size = 2 * CENTIMETRE * scene.radius[inside]
    colours = scene.colours(scene.moved[inside])
    axes.add_collection(
        EllipseCollection(
            size,
            size,
            np.zeros_like(size),
            units="xy",
            facecolors=colours,
            linewidths=0.25,
            edgecolors=colours * [0.55, 0.55, 0.55, 1.0],
            offsets=CENTIMETRE * scene.x[inside][:, [along, 2]],
            offset_transform=axes.transData,
        )
    )
    axes.axhline(CENTIMETRE * scene.bed_level, color="0.15", lw=0.9, ls=(0, (6, 4)), zorder=3)
    if scene.surface is not None:
        outline = CENTIMETRE * cut(scene.surface, axis, position)[:, :, [along, 2]]
        lines = LineCollection(outline, colors=WHEEL_COLOUR, lw=1.8, capstyle="round", zorder=4)
        axes.add_collection(lines)
    axes.set_xlim(CENTIMETRE * scene.low[along], CENTIMETRE * scene.high[along])
    top = float(scene.high[2])
    if len(inside):
        highest = scene.x[inside, 2].max() + scene.diameter
        top = float(max(highest, scene.bed_level + 2 * scene.diameter))
    if scene.surface is not None and scene.wheel_low[axis] < position < scene.wheel_high[axis]:
        part = scene.bed_level + 0.45 * (scene.wheel_high[2] - scene.wheel_low[2])
        top = float(max(top, min(scene.wheel_high[2], part)))
    axes.set_ylim(CENTIMETRE * scene.low[2], CENTIMETRE * top)
    axes.set_aspect("equal")
    axes.set_xlabel(f"{'xy'[along]} [cm]")
    axes.set_ylabel("z [cm]")


def cut(surface: Surface, axis: int, position: float) -> Floats:
    """Segments (k, 2, 3) in which triangles cross the plane x[axis] = position [m]."""
    corners = surface.x[surface.triangles]
    side = corners[:, :, axis] - position
    crossed = np.flatnonzero((side.min(axis=1) < 0) & (side.max(axis=1) >= 0))
    segments = np.empty((len(crossed), 2, 3))
    for i, t in enumerate(crossed):
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            if (side[t, a] < 0) != (side[t, b] < 0):
                share = side[t, a] / (side[t, a] - side[t, b])
                ends.append(corners[t, a] + share * (corners[t, b] - corners[t, a]))
        segments[i] = ends
    return segments


def _draw_height_map(figure: Figure, axes: Axes, scene: Scene, cross: float) -> None:
    """Height of the ground over the bed level, from above. cross: x of the cross section [m]"""
    values = MILLIMETRE * _median_around(scene.heights)
    low, high = np.nanpercentile(values, [0.5, 99.5])
    # the eye reads depth and heap on one scale when both sides have the same unit length
    limit = max(-low, high, MILLIMETRE * scene.diameter)
    left, bottom = scene.low[:2]
    rows, columns = values.shape
    extent = CENTIMETRE * np.array(
        [left, left + scene.cell * columns, bottom, bottom + scene.cell * rows]
    )
    image = axes.imshow(
        values,
        origin="lower",
        extent=extent,
        cmap="RdBu_r",
        norm=TwoSlopeNorm(0.0, -limit, limit),
        interpolation="nearest",
    )
    axes.axhline(CENTIMETRE * scene.middle, color="0.15", lw=0.8, ls=":")
    axes.axvline(CENTIMETRE * cross, color="0.15", lw=0.8, ls=":")
    if scene.surface is not None:
        corner = CENTIMETRE * scene.wheel_low[:2]
        size = CENTIMETRE * (scene.wheel_high - scene.wheel_low)[:2]
        outline = plt.Rectangle(corner, *size, fill=False, ec=WHEEL_COLOUR, lw=1.2, ls="--")
        axes.add_patch(outline)
    axes.set_xlabel("x [cm]")
    axes.set_ylabel("y [cm]")
    axes.set_xlim(extent[:2])
    axes.set_ylim(extent[2:])
    bar = figure.colorbar(image, ax=axes, extend="both", fraction=0.05, pad=0.02, shrink=0.9)
    bar.set_label("height over bed level [mm]")
