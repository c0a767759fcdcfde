# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of flow fields: displacement, density and stress of two runs and what differs."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from ..analyse.flow import FlowComparison
from ..arrays import Floats
from .style import CENTIMETRE, head_figure, label_panels, save, use_style

ARROWS = 22  # along the picture


class Image(NamedTuple):
    """A field on the window, the ends of its scale, its colours; displacement (rows, columns, 2) [m] for arrows."""

    values: Floats
    limits: tuple[float, float]
    colours: str
    displacement: Floats | None = None


class Row(NamedTuple):
    """Field of two runs, their difference, and this difference over the mean."""

    name: str
    unit: str
    runs: Sequence[Image]
    apart: Image
    share: str


def draw_flow(result: FlowComparison, target: Path) -> None:
    """Two columns for the runs, on one scale each row, and a third for their difference."""
    use_style()
    density = [flow.density for flow in result.flows]
    rows = [_displacement(result), _scalar("density", r"kg/m$^3$", density, result.density_difference)]
    if result.has_stress:
        stress = [1e-3 * flow.vertical_stress for flow in result.flows]
        rows.append(_scalar("vertical stress", "kPa", stress, result.stress_difference))
    size = (13, 1.95 * len(rows))
    figure, axes = plt.subplots(len(rows), 3, figsize=size, layout="constrained", sharex=True, sharey=True)
    first, second = (flow.label for flow in result.flows)
    titles: list[str] = []
    for panels, row in zip(axes, rows):
        for shown, images in ((panels[:2], row.runs), (panels[2:], [row.apart])):
            drawn = [_draw_image(panel, result, image) for panel, image in zip(shown, images)]
            figure.colorbar(drawn[-1], ax=shown, label=row.unit, shrink=0.9, pad=0.01)
        titles += [f"{row.name}, {first}", f"{row.name}, {second}", f"{second} less {first}: {row.share} %"]
    label_panels(axes.flat, *titles)
    for panel in axes[-1]:
        panel.set_xlabel("from the axle along the travel [cm]")
    for panel in axes[:, 0]:
        panel.set_ylabel("height [cm]")
    head_figure(figure, f"Ground in the wheel's plane since the start, kernel of {1e3 * result.width:.3g} mm")
    save(figure, target)


def _displacement(result: FlowComparison) -> Row:
    lengths = [CENTIMETRE * flow.length for flow in result.flows]
    limits = (0.0, max(float(np.nanmax(length)) for length in lengths))
    moved = [flow.displacement for flow in result.flows]
    apart = moved[1] - moved[0]
    *runs, difference = (
        Image(length, limits, "YlOrBr", arrows)
        for length, arrows in zip([*lengths, CENTIMETRE * np.linalg.norm(apart, axis=2)], [*moved, apart])
    )
    return Row("displacement", "cm", runs, difference, f"{100 * result.displacement_difference:.0f}")


def _scalar(name: str, unit: str, values: Sequence[Floats], difference: float) -> Row:
    limits = min(float(np.nanmin(field)) for field in values), max(float(np.nanmax(field)) for field in values)
    apart = values[1] - values[0]
    reach = float(np.nanmax(np.abs(apart)))
    runs = [Image(field, limits, "viridis") for field in values]
    return Row(name, unit, runs, Image(apart, (-reach, reach), "RdBu_r"), f"{100 * difference:.3g}")


def _draw_image(axes: Axes, result: FlowComparison, image: Image) -> plt.cm.ScalarMappable:
    x, z = (CENTIMETRE * values for values in result.window)
    half = 0.5 * (x[1] - x[0])
    axes.set_facecolor("0.93")
    axes.axhline(0, color="0.5", lw=0.6)
    drawn = axes.imshow(
        image.values,
        origin="lower",
        extent=(x[0] - half, x[-1] + half, z[0] - half, z[-1] + half),
        vmin=image.limits[0],
        vmax=image.limits[1],
        cmap=image.colours,
        aspect="equal",
        interpolation="nearest",
    )
    if image.displacement is not None:  # arrows of true length, from where the ground was to where it is
        every = max(1, len(x) // ARROWS)
        place = np.stack(np.meshgrid(x, z), axis=2)[::every, ::every]
        moved = CENTIMETRE * image.displacement[::every, ::every]
        look = {"angles": "xy", "scale_units": "xy", "scale": 1.0, "width": 0.0016, "color": "0.25"}
        axes.quiver(*np.moveaxis(place - moved, 2, 0), *np.moveaxis(moved, 2, 0), **look)
    return drawn
