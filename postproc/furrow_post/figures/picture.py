# SPDX-License-Identifier: GPL-2.0-or-later
"""The rut in a bed of grains in four views."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.colors import Normalize, TwoSlopeNorm

from ..errors import ResultsError
from ..read.results import Results
from .bed_scene import BedScene
from .render import OBLIQUE, cut, shaded_picture
from .style import (CENTIMETRE, MILLIMETRE, WHEEL_COLOUR, add_scale, label_panels, round_up, save, use_style)

WIDTH = 11.0  # of the figure [inch]
HEAD = 0.95  # height of the title [inch]


def draw_picture(results: Results, numbers: str, target: Path, pixels: int = 1000) -> None:
    """Draws the picture of a run.

    numbers: a line of results for the title, or ""; pixels: width of the oblique view. @raises
    ResultsError when the run kept no grains
    """
    use_style()
    if not all(len(results.grains(when).id) for when in ("reference", "final")):
        raise ResultsError(f"{results.file}: lists no grains; there is nothing to draw")
    scene = BedScene(results)
    cross = scene.cross_section
    figure = plt.figure(layout="constrained")
    panels = figure.subplot_mosaic("aa;bb;cd", width_ratios=[1, 1.6])
    oblique, lengthwise, across, above = panels.values()
    _draw_oblique(oblique, scene, pixels)
    if scene.followed:
        scale = Normalize(0, MILLIMETRE * scene.range.vmax)
        add_scale(oblique, scale, "displacement of grains [mm]", extend="max", fraction=0.03, pad=0.01, shrink=0.8)
    _draw_section(lengthwise, scene, 1, scene.middle)
    _draw_section(across, scene, 0, cross)
    _draw_height_map(above, scene, cross)

    # Heights of the panels [inch] from the shape of the bed, so that little paper stays empty
    wanted = (
        0.9 * WIDTH * _aspect(oblique) + 0.3,
        0.95 * WIDTH * _aspect(lengthwise) + 0.7,
        max(0.34 * WIDTH * _aspect(across), 0.48 * WIDTH * _aspect(above)) + 0.7,
    )
    tall = np.minimum(wanted, 9.0)
    height = HEAD + tall.sum()
    figure.set_size_inches(WIDTH, height)
    oblique.get_gridspec().set_height_ratios(tall)
    wheel = ", dashed: wheel" if scene.surface is not None else ""
    renewed = "" if scene.followed else "; the bed was renewed, displacements are not known"
    label_panels(
        panels.values(),
        f"from behind{renewed}",
        f"lengthwise, y = {CENTIMETRE * scene.middle + 0.0:.1f} cm; dashed: bed level before",
        f"across, x = {CENTIMETRE * cross:.1f} cm",
        f"from above, pits between grains filled; dotted: sections{wheel}",
    )
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


def _draw_oblique(axes: Axes, scene: BedScene, pixels: int) -> None:
    """The whole bed from behind and beside the wheel."""
    shown = scene.visible_from(OBLIQUE)
    width = np.abs(OBLIQUE.right) @ (scene.high - scene.low)
    colours = scene.colours(scene.moved[shown])[:, :3]
    picture, extent = shaded_picture(
        scene.x[shown], scene.radius[shown], colours, scene.surface, OBLIQUE, width / pixels
    )
    axes.imshow(picture, extent=[CENTIMETRE * e for e in extent], interpolation="antialiased")
    axes.set_axis_off()
    axes.set_aspect("equal")
    _draw_scale_bar(axes, scene)


def _draw_scale_bar(axes: Axes, scene: BedScene) -> None:
    """A length along the travel direction on the ground beside the bed, with an arrow."""
    bed_length = scene.high[0] - scene.low[0]
    length = round_up(0.2 * bed_length)
    start = np.array([scene.low[0], scene.low[1] - 0.06 * bed_length, scene.low[2]])
    ends = CENTIMETRE * OBLIQUE.project(np.array([start, start + [length, 0, 0]]))[:, :2]
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


def _draw_section(axes: Axes, scene: BedScene, axis: int, position: float) -> None:
    """Grains less than a diameter from the plane x[axis] = position [m], the wheel cut by the plane itself."""
    along = 1 - axis
    distance = np.abs(scene.x[:, axis] - position)
    inside = np.flatnonzero(distance < scene.diameter)
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
    axes.set(aspect="equal", xlabel=f"{'xy'[along]} [cm]", ylabel="z [cm]")


def _draw_height_map(axes: Axes, scene: BedScene, cross: float) -> None:
    """Height of the ground over the bed level, from above. cross: x of the cross section [m]"""
    values = MILLIMETRE * scene.smooth_heights()
    low, high = np.nanpercentile(values, [0.5, 99.5])
    # the eye reads depth and heap on one scale when both sides have the same unit length
    limit = max(-low, high, MILLIMETRE * scene.diameter)
    left, bottom = scene.low[:2]
    rows, columns = values.shape
    extent = CENTIMETRE * np.array([left, left + scene.cell * columns, bottom, bottom + scene.cell * rows])
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
    axes.set(xlabel="x [cm]", ylabel="y [cm]", xlim=extent[:2], ylim=extent[2:])
    bar = axes.figure.colorbar(image, ax=axes, extend="both", fraction=0.05, pad=0.02, shrink=0.9)
    bar.set_label("height over bed level [mm]")
