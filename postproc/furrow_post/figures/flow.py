# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of flow fields: displacement and density of two runs and what differs."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.image import AxesImage

from ..analyse.flow import FlowComparison
from ..arrays import Floats
from .style import CENTIMETRE, annotate_panel, panel_letters, save, use_style

ARROWS = 22  # along the picture
AMOUNT, SIGNED = "YlOrBr", "RdBu_r"


def draw_flow(result: FlowComparison, target: Path) -> None:
    """Two columns for the runs, on one scale each row, and a third for their difference."""
    use_style()
    a, b = result.flows
    figure, axes = plt.subplots(
        2, 3, figsize=(13, 3.9), layout="constrained", sharex=True, sharey=True
    )
    letters = panel_letters()

    lengths = [CENTIMETRE * flow.length for flow in result.flows]
    largest = max(float(np.nanmax(length)) for length in lengths)
    for panel, flow, length in zip(axes[0], result.flows, lengths):
        image = _image(panel, result, length, (0.0, largest), AMOUNT)
        _arrows(panel, result, flow.displacement)
        annotate_panel(panel, next(letters), f"displacement, {flow.label}")
    figure.colorbar(image, ax=axes[0, :2], label="cm", shrink=0.9, pad=0.01)
    apart = b.displacement - a.displacement
    length = CENTIMETRE * np.linalg.norm(apart, axis=2)
    image = _image(axes[0, 2], result, length, (0.0, largest), AMOUNT)
    _arrows(axes[0, 2], result, apart)
    figure.colorbar(image, ax=axes[0, 2], label="cm", shrink=0.9, pad=0.01)
    share = f"{100 * result.displacement_difference:.0f} %"
    annotate_panel(axes[0, 2], next(letters), f"{b.label} less {a.label}: {share}")

    low = min(float(np.nanmin(flow.density)) for flow in result.flows)
    high = max(float(np.nanmax(flow.density)) for flow in result.flows)
    for panel, flow in zip(axes[1], result.flows):
        image = _image(panel, result, flow.density, (low, high), "viridis")
        annotate_panel(panel, next(letters), f"density, {flow.label}")
    figure.colorbar(image, ax=axes[1, :2], label=r"kg/m$^3$", shrink=0.9, pad=0.01)
    difference = b.density - a.density
    reach = float(np.nanmax(np.abs(difference)))
    image = _image(axes[1, 2], result, difference, (-reach, reach), SIGNED)
    figure.colorbar(image, ax=axes[1, 2], label=r"kg/m$^3$", shrink=0.9, pad=0.01)
    share = f"{100 * result.density_difference:.1f} %"
    annotate_panel(axes[1, 2], next(letters), f"{b.label} less {a.label}: {share}")

    for panel in axes[1]:
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
