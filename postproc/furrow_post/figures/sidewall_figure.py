# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of furrow-sidewall: section, forces, and the table against the solution."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from ..arrays import Floats
from ..read.hdf5 import opened
from ..read.results import decoded
from .style import MILLIMETRE, head_figure, label_panels, save, use_style

SOLVED, LOOKED_UP, AXIAL = "#c2410c", "0.15", "#3b6ea5"
KILONEWTON = 1e-3  # per newton
LINE_WIDTH = 1.6

Curve = dict[str, Floats]  # moved; r, a [m]; F_r, F_a, F_r_table, F_a_table [N/m]


class Profile(NamedTuple):
    """The sidewall at a deflection of the tread's edge: axial A, radius R of its points [m]."""

    deflection: float
    axial: Floats
    radius: Floats


def draw_sidewall(folder: Path) -> list[Path]:
    """Draws sidewall.h5 of a results folder, and returns the figure's path in a list."""
    use_style()
    with opened(folder / "sidewall.h5") as file:
        curves: dict[str, Curve] = {
            name: {key: data[...] for key, data in file[name].items()}
            for name in ("deflection", "lateral")
        }
        groups = [file["profiles"][str(k)] for k in range(len(file["profiles"]))]
        profiles = [Profile(float(group.attrs["deflection"]), group["A"][...], group["R"][...]) for group in groups]
        heading, pressure = decoded(file.attrs["title"]), float(file.attrs["pressure"])
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.0), layout="constrained")
    _draw_section(axes[0][0], profiles)
    _draw_forces(axes[0][1], curves["deflection"], "deflection [mm]")
    _draw_forces(axes[1][0], curves["lateral"], "axial motion, outwards [mm]")
    _draw_errors(axes[1][1], curves)
    label_panels(
        axes.flat,
        "section at deflections of the tread edge",
        "tread edge pressed towards the rim",
        "tread edge moved sideways",
        "table against solution",
    )
    head_figure(figure, f"{heading} at {pressure / 1e3:.4g} kPa")
    target = folder / "sidewall.png"
    save(figure, target)
    return [target]


def _draw_section(axes: Axes, profiles: Sequence[Profile]) -> None:
    shades = plt.get_cmap("YlOrBr")(np.linspace(0.85, 0.3, len(profiles)))
    for profile, shade in zip(profiles, shades):
        axial, radius = MILLIMETRE * profile.axial, MILLIMETRE * profile.radius
        marker = "." if profile.deflection == 0 else None
        for side in (-1, 1):
            axes.plot(side * axial, radius, color=shade, lw=LINE_WIDTH, marker=marker, ms=4)
        tread = {"color": shade, "lw": 2.8, "solid_capstyle": "butt"}
        axes.plot([-axial[-1], axial[-1]], [radius[-1]] * 2, **tread)
        if profile.deflection in (profiles[0].deflection, profiles[-1].deflection):
            text = f"{MILLIMETRE * profile.deflection:.0f} mm"
            look = {"ha": "center", "va": "bottom", "fontsize": 8, "color": "0.3"}
            axes.text(0, radius[-1] + 2, text, **look)
    first = profiles[0]
    for side in (-1, 1):
        rim = (side * MILLIMETRE * first.axial[0], MILLIMETRE * first.radius[0])
        axes.plot(*rim, "s", color="0.3", ms=5, zorder=5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="axial $A$ [mm]", ylabel="radius $R$ [mm]")


def _draw_forces(axes: Axes, curve: Curve, x_label: str) -> None:
    """Forces of the sidewall on the tread over the motion of the tread's edge."""
    moved = MILLIMETRE * curve["moved"]
    step = max(1, len(moved) // 20)
    for name, colour, kind in (("F_r", SOLVED, "radial"), ("F_a", AXIAL, "axial")):
        solved, table = KILONEWTON * curve[name], KILONEWTON * curve[f"{name}_table"]
        axes.plot(moved, solved, color=colour, lw=LINE_WIDTH, label=f"{kind}, solved")
        label = "looked up" if kind == "axial" else None
        axes.plot(moved[::step], table[::step], "o", mfc="none", mec=LOOKED_UP, mew=0.8, ms=4, label=label, zorder=4)
    axes.axhline(0, color="0.7", lw=0.6, zorder=0)
    axes.axvline(0, color="0.7", lw=0.6, zorder=0)
    # The chain is nearly straight where its ends are farthest apart: forces there rule no limit
    squares = curve["r"] ** 2 + curve["a"] ** 2
    bent = squares < 0.97 * np.max(squares)
    inner = KILONEWTON * np.concatenate([curve["F_r"][bent], curve["F_a"][bent]])
    axes.set_ylim(inner.min() - 0.15 * np.ptp(inner), inner.max() + 0.35 * np.ptp(inner))
    axes.set(xlabel=x_label, ylabel="force on the tread [kN/m]")
    axes.legend(fontsize=8, loc="upper center", ncols=3, columnspacing=1, handlelength=1.4)


def _draw_errors(axes: Axes, curves: dict[str, Curve]) -> None:
    for name, label, colour in (("deflection", "deflection", SOLVED), ("lateral", "axial motion", AXIAL)):
        curve = curves[name]
        error = np.hypot(curve["F_a_table"] - curve["F_a"], curve["F_r_table"] - curve["F_r"])
        relative = np.maximum(error / np.hypot(curve["F_a"], curve["F_r"]), 1e-16)
        moved = MILLIMETRE * curve["moved"]
        axes.semilogy(moved, relative, color=colour, lw=LINE_WIDTH, label=label)
    axes.set(xlabel="motion of the tread edge [mm]", ylabel="difference over force")
    axes.legend(fontsize=8)
