# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post picture: the rut in four views, drawn without a display."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize, TwoSlopeNorm

from . import render
from .style import CENTIMETRE, MILLIMETRE, annotate_panel, save, use_style

WHEEL = "#39424e"
COLOURS = LinearSegmentedColormap.from_list("sand", ["#e6d8b4", "#f0b55e", "#dd6a3c", "#a3264f", "#46125c"])  # at rest: sand


class Scene:
    """What all panels share: grains, displacement, wheel, bed level, the box in plan."""

    def __init__(self, results):
        self.results = results
        reference, final = results.grains("reference"), results.grains("final")
        self.x, self.radius = final.x, final.radius
        self.moved = np.linalg.norm(final.displacement_from(reference), axis=1)
        self.diameter = 2 * self.radius.mean()
        self.surface = results.surface()
        self.low = (reference.x - reference.radius[:, None]).min(axis=0)
        self.high = (reference.x + reference.radius[:, None]).max(axis=0)
        self.cell = 0.5 * self.diameter
        before = self._heights(reference.x, reference.radius)
        self.bed_level = reference.bed_level if np.isfinite(reference.bed_level) else np.nanmedian(before)
        self.heights = self._heights(self.x, self.radius) - self.bed_level
        self.range = Normalize(0, render.round_up(np.nanpercentile(self.moved, 99.5)))
        nodes = self.surface[1] if self.surface is not None else None
        self.wheel_low = nodes.min(axis=0) if nodes is not None else None
        self.wheel_high = nodes.max(axis=0) if nodes is not None else None

    def _heights(self, x, radius):
        return render.top_heights(x, radius, self.low[:2], self.high[:2], self.cell)

    @property
    def middle(self):
        """y of the lengthwise section: the wheel's middle plane, or the bed's."""
        if self.surface is None:
            return 0.5 * (self.low[1] + self.high[1])
        return 0.5 * (self.wheel_low[1] + self.wheel_high[1])

    @property
    def cross_section(self):
        """x of the cross section: where the rut is deepest on average, clear of the wheel."""
        rows = np.abs(self._cell_middles(1) - self.middle) < 0.25 * self._rut_width()
        here = np.where(rows[:, None] & np.isfinite(self.heights), self.heights, 0.0)
        count = (rows[:, None] & np.isfinite(self.heights)).sum(axis=0)
        profile = np.where(count > 0, here.sum(axis=0) / np.maximum(count, 1), np.nan)
        x = self._cell_middles(0)
        if self.surface is not None:
            clear = (x < self.wheel_low[0]) | (x > self.wheel_high[0])
            profile = np.where(clear, profile, np.nan)
        if not np.isfinite(profile).any():
            return 0.5 * (self.low[0] + self.high[0])
        width = max(int(4 * self.diameter / self.cell), 1)
        smooth = np.convolve(np.nan_to_num(profile), np.ones(width) / width, "same")
        smooth[~np.isfinite(profile)] = np.inf
        return x[np.argmin(smooth)]

    def _rut_width(self):
        return self.wheel_high[1] - self.wheel_low[1] if self.surface is not None else 0.2 * (self.high[1] - self.low[1])

    def _cell_middles(self, axis):
        return self.low[axis] + self.cell * (np.arange(self.heights.shape[1 - axis]) + 0.5)

    def colours(self, values):
        return COLOURS(self.range(np.nan_to_num(values)))

    def visible_from(self, view):
        """Grains that are not buried: near the surface, or near a side of the box that the view shows."""
        depth = 4 * self.diameter
        column = ((self.x[:, 0] - self.low[0]) / self.cell).astype(int).clip(0, self.heights.shape[1] - 1)
        row = ((self.x[:, 1] - self.low[1]) / self.cell).astype(int).clip(0, self.heights.shape[0] - 1)
        local = _lowest_around(np.nan_to_num(self.heights, nan=-np.inf), int(depth / self.cell))[row, column] + self.bed_level
        shown = self.x[:, 2] > local - depth
        for axis in (0, 1):
            outside = (self.x[:, axis] < self.low[axis]) | (self.x[:, axis] > self.high[axis])
            if view.towards[axis] < 0:
                shown |= (self.x[:, axis] < self.low[axis] + depth) | outside
            else:
                shown |= (self.x[:, axis] > self.high[axis] - depth) | outside
        return np.flatnonzero(shown)


def _lowest_around(image, reach):
    for axis in (0, 1):
        padded = np.concatenate([np.repeat(image.take([0], axis), reach, axis), image,
                                 np.repeat(image.take([-1], axis), reach, axis)], axis)
        n = image.shape[axis]
        image = np.minimum.reduce([padded.take(range(k, k + n), axis) for k in range(2 * reach + 1)])
    return image


def _median_around(image):
    """Median of the 3 x 3 cells about each cell that have a value: fills the pits between single grains; NaN where none has."""
    padded = np.pad(image, 1, constant_values=np.nan)
    rows, columns = image.shape
    around = np.sort([padded[i:i + rows, j:j + columns] for i in range(3) for j in range(3)], axis=0)  # NaN last
    count = np.isfinite(around).sum(axis=0)
    low, high = np.maximum(count - 1, 0) // 2, count // 2
    pick = lambda place: np.take_along_axis(around, np.minimum(place, 8)[None], 0)[0]
    return 0.5 * (pick(low) + pick(high))


def _oblique(axes, scene, pixels):
    """The whole bed from behind and beside the wheel."""
    view = render.View.of_angles(-112.0, 30.0)
    shown = scene.visible_from(view)
    width = np.abs(view.right) @ (scene.high - scene.low)
    picture, extent = render.shaded_picture(scene.x[shown], scene.radius[shown], scene.colours(scene.moved[shown])[:, :3],
                                            scene.surface, view, width / pixels)
    axes.imshow(picture, extent=[CENTIMETRE * e for e in extent], interpolation="antialiased")
    axes.set_axis_off()
    axes.set_aspect("equal")
    _scale_bar(axes, scene, view)


def _scale_bar(axes, scene, view):
    """A length along the travel direction on the ground beside the bed, with an arrow."""
    length = render.round_up(0.2 * (scene.high[0] - scene.low[0]))
    start = np.array([scene.low[0], scene.low[1] - 0.06 * (scene.high[0] - scene.low[0]), scene.low[2]])
    ends = CENTIMETRE * view.project(np.array([start, start + [length, 0, 0]]))[:, :2]
    axes.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": "-|>", "color": "0.2", "lw": 1.4}, annotation_clip=False)
    middle = ends.mean(axis=0)
    angle = np.degrees(np.arctan2(*(ends[1] - ends[0])[::-1]))
    away = (6 * np.sin(np.radians(angle)), -6 * np.cos(np.radians(angle)))  # points, below the arrow
    axes.annotate(f"{CENTIMETRE * length:g} cm along travel", middle, away, textcoords="offset points", rotation=angle,
                  rotation_mode="anchor", ha="center", va="top", color="0.2", fontsize=8, annotation_clip=False)
    axes.update_datalim(ends)


def _section(axes, scene, axis, position, thickness=2.0):
    """Grains within a slab of some diameters about the plane x[axis] = position, the wheel cut by the plane itself."""
    along = 1 - axis
    inside = np.flatnonzero(np.abs(scene.x[:, axis] - position) < 0.5 * thickness * scene.diameter)
    inside = inside[np.argsort(-scene.x[inside, axis])] if axis == 1 else inside[np.argsort(scene.x[inside, axis])[::-1]]
    size = 2 * CENTIMETRE * scene.radius[inside]
    colours = scene.colours(scene.moved[inside])
    axes.add_collection(EllipseCollection(size, size, np.zeros_like(size), units="xy", facecolors=colours, linewidths=0.25,
                                          edgecolors=colours * [0.55, 0.55, 0.55, 1.0],
                                          offsets=CENTIMETRE * scene.x[inside][:, [along, 2]], offset_transform=axes.transData))
    axes.axhline(CENTIMETRE * scene.bed_level, color="0.15", lw=0.9, ls=(0, (6, 4)), zorder=3)
    if scene.surface is not None:
        axes.add_collection(LineCollection(CENTIMETRE * cut(scene.surface, axis, position)[:, :, [along, 2]], colors=WHEEL, lw=1.8,
                                           capstyle="round", zorder=4))
    axes.set_xlim(CENTIMETRE * scene.low[along], CENTIMETRE * scene.high[along])
    top = max(scene.x[inside, 2].max() + scene.diameter, scene.bed_level + 2 * scene.diameter) if len(inside) else scene.high[2]
    if scene.surface is not None and scene.wheel_low[axis] < position < scene.wheel_high[axis]:
        top = max(top, min(scene.wheel_high[2], scene.bed_level + 0.45 * (scene.wheel_high[2] - scene.wheel_low[2])))
    axes.set_ylim(CENTIMETRE * scene.low[2], CENTIMETRE * top)
    axes.set_aspect("equal")
    axes.set_xlabel(f"{'xy'[along]} [cm]")
    axes.set_ylabel("z [cm]")


def cut(surface, axis, position):
    """Segments (k, 2, 3) in which triangles cross the plane x[axis] = position."""
    triangles, x = surface
    corners = x[triangles]
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


def _height_map(figure, axes, scene, cross):
    """Height of the ground over the bed level, from above."""
    values = MILLIMETRE * _median_around(scene.heights)
    low, high = np.nanpercentile(values, [0.5, 99.5])
    # the eye reads depth and heap on one scale when both sides have the same unit length
    limit = max(-low, high, MILLIMETRE * scene.diameter)
    norm = TwoSlopeNorm(0.0, -limit, limit)
    extent = CENTIMETRE * np.array([scene.low[0], scene.low[0] + scene.cell * values.shape[1],
                                    scene.low[1], scene.low[1] + scene.cell * values.shape[0]])
    image = axes.imshow(values, origin="lower", extent=extent, cmap="RdBu_r", norm=norm, interpolation="nearest")
    axes.axhline(CENTIMETRE * scene.middle, color="0.15", lw=0.8, ls=":")
    axes.axvline(CENTIMETRE * cross, color="0.15", lw=0.8, ls=":")
    if scene.surface is not None:
        low_corner, high_corner = CENTIMETRE * scene.wheel_low[:2], CENTIMETRE * scene.wheel_high[:2]
        axes.add_patch(plt.Rectangle(low_corner, *(high_corner - low_corner), fill=False, ec=WHEEL, lw=1.2, ls="--"))
    axes.set_xlabel("x [cm]")
    axes.set_ylabel("y [cm]")
    axes.set_xlim(extent[:2])
    axes.set_ylim(extent[2:])
    bar = figure.colorbar(image, ax=axes, extend="both", fraction=0.05, pad=0.02, shrink=0.9)
    bar.set_label("height over bed level [mm]")


def draw(results, numbers, target, pixels=1500):
    """Draws the picture of a run.

    results: Results; numbers: a line of results for the title, or ""; target: path, its ending says the format;
    pixels: width of the oblique view. @raises ResultsError when the run kept no grains
    """
    use_style()
    scene = Scene(results)
    cross = scene.cross_section
    length, breadth = (scene.high - scene.low)[:2]

    # Heights of the panels from the shape of the bed, so that little paper stays empty.
    wide = 11.0
    figure = plt.figure(layout="constrained")
    grid = figure.add_gridspec(3, 2, height_ratios=[1, 1, 1], width_ratios=[1, 1.6])
    oblique, lengthwise = figure.add_subplot(grid[0, :]), figure.add_subplot(grid[1, :])
    across, above = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])

    _oblique(oblique, scene, pixels)
    bar = figure.colorbar(ScalarMappable(Normalize(0, MILLIMETRE * scene.range.vmax), COLOURS), ax=oblique, extend="max",
                          fraction=0.03, pad=0.01, shrink=0.8)
    bar.set_label("displacement of grains [mm]")
    _section(lengthwise, scene, 1, scene.middle)
    _section(across, scene, 0, cross)
    _height_map(figure, above, scene, cross)
    tall = [min(height, 9.0) for height in (
        0.9 * wide * _aspect(oblique) + 0.3, 0.95 * wide * _aspect(lengthwise) + 0.7,
        max(0.34 * wide * _aspect(across), 0.48 * wide * _aspect(above)) + 0.7)]  # inches
    head = 0.95  # inches for the title
    height = head + sum(tall)
    figure.set_size_inches(wide, height)
    grid.set_height_ratios(tall)

    annotate_panel(oblique, "a", "from behind")
    annotate_panel(lengthwise, "b", f"lengthwise, y = {CENTIMETRE * scene.middle + 0.0:.1f} cm; dashed: bed level before")
    annotate_panel(across, "c", f"across, x = {CENTIMETRE * cross:.1f} cm")
    annotate_panel(above, "d", "from above, pits between grains filled; dotted: sections" + (", dashed: wheel" if scene.surface is not None else ""))

    bed = f"{len(scene.x):,}".replace(",", "\u2009") + f" grains, mean diameter {MILLIMETRE * scene.diameter:.3g} mm, " \
          f"bed {CENTIMETRE * length:.0f} × {CENTIMETRE * breadth:.0f} cm"
    lines = ((0.12, results.title, {"fontsize": 15, "fontweight": "bold"}), (0.45, bed, {"color": "0.35"}), (0.67, numbers, {}))
    for inches, text, look in lines:
        figure.text(0.5, 1 - inches / height, text, **{"ha": "center", "va": "top", "fontsize": 10, **look})
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - head / height))
    save(figure, target)


def _aspect(axes):
    """Height over width of what axes with equal scales show."""
    (left, right), (bottom, top) = axes.get_xlim(), axes.get_ylim()
    return abs((top - bottom) / (right - left))
