# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of flow fields: displacement, density and stress of two runs and what differs."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage

from ..analyse.flow import FlowComparison
from ..arrays import Floats
from .style import CENTIMETRE, annotate_panel, panel_letters, save, use_style

ARROWS = 22  # along the picture
AMOUNT, SIGNED = "YlOrBr", "RdBu_r"


class Field(NamedTuple):
    """A scalar field of two runs, and how far they are apart as a share of its mean."""

    name: str
    unit: str
    first: Floats
    second: Floats
    difference: float


def draw_flow(result: FlowComparison, target: Path) -> None:
    """Two columns for the runs, on one scale each row, and a third for their difference."""
    use_style()
    rows = 3 if result.has_stress else 2
    figure, axes = plt.subplots(
        rows, 3, figsize=(13, 1.95 * rows), layout="constrained", sharex=True, sharey=True
    )
    letters = panel_letters()
    _displacement(figure, axes[0], result, letters)
    a, b = result.flows
    fields = [
        Field("density", r"kg/m$^3$", a.density, b.density, result.density_difference),
    ]
    if result.has_stress:
        first, second = (1e-3 * flow.vertical_stress for flow in result.flows)
        fields.append(Field("vertical stress", "kPa", first, second, result.stress_difference))
    for panels, field in zip(axes[1:], fields):
        _scalar(figure, panels, result, letters, field)
    for panel in axes[-1]:
        panel.set_xlabel("from the axle along the travel [cm]")
    for panel in axes[:, 0]:
        panel.set_ylabel("height [cm]")
    figure.suptitle(
        f"Ground in the wheel's plane since the start, kernel of {1e3 * result.width:.3g} mm",
        x=0.01,
        ha="left",
        fontsize=11,
        fontweight="bold",
    )
    save(figure, target)


def _displacement(
    figure: Figure, panels: Sequence[Axes], result: FlowComparison, letters: Iterator[str]
) -> None:
    a, b = result.flows
    lengths = [CENTIMETRE * flow.length for flow in result.flows]
    largest = max(float(np.nanmax(length)) for length in lengths)
    for panel, flow, length in zip(panels, result.flows, lengths):
        image = _image(panel, result, length, (0.0, largest), AMOUNT)
        _arrows(panel, result, flow.displacement)
        annotate_panel(panel, next(letters), f"displacement, {flow.label}")
    figure.colorbar(image, ax=panels[:2], label="cm", shrink=0.9, pad=0.01)
    apart = b.displacement - a.displacement
    length = CENTIMETRE * np.linalg.norm(apart, axis=2)
    image = _image(panels[2], result, length, (0.0, largest), AMOUNT)
    _arrows(panels[2], result, apart)
    figure.colorbar(image, ax=panels[2], label="cm", shrink=0.9, pad=0.01)
    share = f"{100 * result.displacement_difference:.0f} %"
    annotate_panel(panels[2], next(letters), f"{b.label} less {a.label}: {share}")


def _scalar(
    figure: Figure,
    panels: Sequence[Axes],
    result: FlowComparison,
    letters: Iterator[str],
    field: Field,
) -> None:
    a, b = result.flows
    low = min(float(np.nanmin(values)) for values in (field.first, field.second))
    high = max(float(np.nanmax(values)) for values in (field.first, field.second))
    for panel, flow, values in zip(panels, result.flows, (field.first, field.second)):
        image = _image(panel, result, values, (low, high), "viridis")
        annotate_panel(panel, next(letters), f"{field.name}, {flow.label}")
    figure.colorbar(image, ax=panels[:2], label=field.unit, shrink=0.9, pad=0.01)
    difference = field.second - field.first
    reach = float(np.nanmax(np.abs(difference)))
    image = _image(panels[2], result, difference, (-reach, reach), SIGNED)
    figure.colorbar(image, ax=panels[2], label=field.unit, shrink=0.9, pad=0.01)
    share = f"{100 * field.difference:.3g} %"
    annotate_panel(panels[2], next(letters), f"{b.label} less {a.label}: {share}")


def _image(
    axes: Axes, result: FlowComparison, field: Floats, limits: tuple[float, float], colours: str
) -> AxesImage:
    x, z = (CENTIMETRE * values for values in result.window)
    half = 0.5 * (x[1] - x[0])
    extent = (x[0] - half, x[-1] + half, z[0] - half, z[-1] + half)
    axes.set_facecolor("0.93")
    axes.axhline(0, color="0.5", lw=0.6)
    return axes.imshow(
        field,
        origin="lower",
        extent=extent,
        vmin=limits[0],
        vmax=limits[1],
        cmap=colours,
        aspect="equal",
        interpolation="nearest",
    )


def _arrows(axes: Axes, result: FlowComparison, displacement: Floats) -> None:
    """At their true length, from where the ground was to where it is."""
    every = max(1, len(result.window.x) // ARROWS)
    x, z = np.meshgrid(*(CENTIMETRE * values for values in result.window))
    u, w = (CENTIMETRE * displacement[:, :, k] for k in (0, 1))
    chosen = (slice(None, None, every), slice(None, None, every))
    axes.quiver(
        (x - u)[chosen],
        (z - w)[chosen],
        u[chosen],
        w[chosen],
        angles="xy",
        scale_units="xy",
        scale=1.0,
        width=0.0016,
        color="0.25",
    )
