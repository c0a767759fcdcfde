# SPDX-License-Identifier: GPL-2.0-or-later
"""The figures of furrow-point: a path of a material point, and the fit of a law."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from ..arrays import Booleans, Floats, Integers
from ..errors import ResultsError
from ..read.hdf5 import opened
from ..read.results import decoded
from .style import head_figure, label_panels, save, use_style

PATH, SURFACE, FIRST, MEASURED = "#c2410c", "#a9c3dd", "#7d97b3", "0.1"
LINE_WIDTH = 1.6
PANELS_IN_A_ROW = 5  # of a fit

LABELS = {
    "axial_strain": "axial strain $\\varepsilon_1$ (logarithmic)",
    "eps_vol": "volume strain $-\\ln J$",
    "shear_strain": "shear $\\gamma$",
    "density": "density $\\rho$ [kg/m³]",
    "p": "pressure $p$ [Pa]",
    "q": "Mises stress $q$ [Pa]",
    "axial_stress": "axial stress $\\sigma_1$ [Pa]",
    "shear_stress": "shear stress $\\tau_{xz}$ [Pa]",
}
MAY_BE_LOGARITHMIC = ("p", "axial_stress")
# Panels of a path: channels (x, y) of panel b and of panel c
PANELS = {
    "hydrostatic": (("eps_vol", "p"), ("p", "density")),
    "confined": (("axial_strain", "axial_stress"), ("axial_stress", "density")),
    "triaxial": (("axial_strain", "q"), ("axial_strain", "eps_vol")),
    "simple_shear": (("shear_strain", "shear_stress"), ("shear_strain", "eps_vol")),
    "cyclic": (("axial_strain", "axial_stress"), ("axial_stress", "density")),
    "tension": (("axial_strain", "axial_stress"), ("axial_strain", "eps_vol")),
    "table": (("axial_strain", "axial_stress"), ("p", "density")),
}

Channels = dict[str, Floats]  # of point.h5, SI
YieldSurface = tuple[Floats, Floats]  # p, q [Pa]


def draw_point(folder: Path) -> list[Path]:
    """Draws the results folder of furrow-point run or fit, and returns the figure's path in a list.

    @raises ResultsError where it is none
    """
    use_style()
    if (folder / "point.h5").exists():
        return [draw_path(folder)]
    if (folder / "fit.h5").exists():
        return [draw_fit(folder)]
    raise ResultsError(f"{folder}: has neither point.h5 nor fit.h5; name the results folder of furrow-point")


def _attributes(item: Any) -> dict[str, Any]:
    """Attributes of an HDF5 object, texts decoded."""
    return {name: decoded(value) if isinstance(value, bytes) else value for name, value in item.attrs.items()}


def _numbered(group: Any) -> list[Any]:
    """The members 0, 1, 2, ... in their order."""
    return [group[str(number)] for number in range(len(group))]


def _stress_unit(*arrays: Floats) -> tuple[float, str]:
    """Divisor and name of the unit that suits the largest stress."""
    largest = max(float(np.max(np.abs(a))) if len(a) else 0.0 for a in arrays)
    for size, name in ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")):
        if largest >= size:
            return size, name
    return 1.0, "Pa"


def _in_suitable_unit(values: Sequence[Floats], label: str) -> tuple[list[Floats], str]:
    """Values and label "... [Pa]" in the unit that suits the largest value; other labels are unchanged."""
    if not label.endswith("[Pa]"):
        return list(values), label
    size, unit = _stress_unit(*values)
    return [v / size for v in values], label.replace("[Pa]", f"[{unit}]")


def _segment_ends(segment: Floats) -> Integers:
    """Rows at which the segments of a path end."""
    return np.append(np.flatnonzero(np.diff(segment)), len(segment) - 1)


def _mark_ends(axes: Axes, x: Floats, y: Floats, segment: Floats) -> None:
    """A dot where a segment ends, an open one at the start."""
    ends = _segment_ends(segment)
    if len(ends) <= 30:
        axes.plot(x[ends], y[ends], "o", color=PATH, ms=3.5, zorder=4, clip_on=False)
    axes.plot(x[0], y[0], "o", mfc="white", mec=PATH, ms=4.5, zorder=5, clip_on=False)


def _spans_decades(targets: Floats) -> bool:
    """Three positive targets or more, over two decades or more."""
    positive = np.unique(targets[targets > 0])
    return len(positive) >= 3 and bool(positive[-1] >= 100 * positive[0])


def draw_path(folder: Path) -> Path:
    """point.png: stress path with yield surfaces, stress and strain, volume."""
    with opened(folder / "point.h5") as file:
        point = {name: dataset[...] for name, dataset in file["point"].items()}
        head = _attributes(file["point"])
        surfaces = [(group["p"][...], group["q"][...]) for group in _numbered(file["yield_surface"])]
    stress_strain, volume = PANELS[head["path"]]
    sheared = np.ptp(point["shear_strain"]) > np.ptp(point["axial_strain"])
    if head["path"] == "table" and sheared:
        stress_strain = "shear_strain", "shear_stress"
    figure, axes = plt.subplots(1, 3, figsize=(10.2, 3.5), layout="constrained")
    _draw_invariants(axes[0], point, surfaces)
    _draw_pair(axes[1], point, *stress_strain)
    _draw_pair(axes[2], point, *volume)
    label_panels(axes, "stress path", "stress and strain", "volume")
    head_figure(figure, f"{head['title']}\n")
    path = head["path"].replace("_", " ")
    subtitle = f"{head['material']}  ·  law {head['law']}  ·  path {path}"
    figure.text(0.01, 0.925, subtitle, fontsize=8.5, color="0.35", va="top")
    target = folder / "point.png"
    save(figure, target)
    return target


def _draw_invariants(axes: Axes, point: Channels, surfaces: Sequence[YieldSurface]) -> None:
    p, q = point["p"], point["q"]
    size, unit = _stress_unit(p, q)
    last = len(surfaces) - 1
    for index, (surface_p, surface_q) in enumerate(surfaces):
        x, y = surface_p / size, surface_q / size
        if index == last:
            look = {"color": SURFACE, "lw": 4, "zorder": 1, "solid_capstyle": "butt"}
            axes.plot(x, y, label="yield surface at the end", **look)
        elif index == 0:
            look = {"color": FIRST, "ls": "--", "lw": 1.2, "zorder": 2}
            axes.plot(x, y, label="yield surface at the start", **look)
        elif len(surfaces) < 20:
            axes.plot(x, y, color=FIRST, ls="-", lw=0.6, zorder=2)
    axes.plot(p / size, q / size, color=PATH, label="path", lw=LINE_WIDTH, zorder=3)
    _mark_ends(axes, p / size, q / size, point["segment"])
    axes.axhline(0, color="0.6", lw=0.6, zorder=0)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.set(xlabel=f"pressure $p$ [{unit}]", ylabel=f"Mises stress $q$ [{unit}]")
    # Limits: the path, and of the surfaces what does not flatten it
    visible = [s for s in surfaces if s[0].max() < 3 * max(p.max(), 1e-30)]
    right = max([p.max()] + [s[0].max() for s in visible]) / size
    near = [s[0].min() for s in surfaces if s[0].min() > -0.6 * right * size]
    left = min([p.min()] + near) / size
    top = max([q.max()] + [s[1].max() for s in visible]) / size
    margin = 0.06 * max(right - left, 1e-12)
    axes.set_xlim(left - margin, right + margin)
    if top > 0:
        axes.set_ylim(-0.04 * top, 1.42 * top)
    axes.legend(loc="upper left", fontsize=8, handlelength=1.6)


def _draw_pair(axes: Axes, point: Channels, x_name: str, y_name: str) -> None:
    ((x,), x_label), ((y,), y_label) = (_in_suitable_unit([point[name]], LABELS[name]) for name in (x_name, y_name))
    ends = _segment_ends(point["segment"])
    kept: Booleans = np.ones(len(x), dtype=bool)
    for name, set_scale in ((x_name, axes.set_xscale), (y_name, axes.set_yscale)):
        targets = point[name][ends]
        if name in MAY_BE_LOGARITHMIC and _spans_decades(targets):
            set_scale("log")
            kept &= point[name] > 0.3 * targets[targets > 0].min()
    axes.plot(x[kept], y[kept], color=PATH, lw=LINE_WIDTH)
    if kept.all():
        _mark_ends(axes, x, y, point["segment"])
    else:
        axes.plot(x[ends], y[ends], "o", color=PATH, ms=3.5, zorder=4)
    if axes.get_yscale() == "linear":
        if y.min() <= 0 <= y.max():
            axes.axhline(0, color="0.6", lw=0.6, zorder=0)
        axes.ticklabel_format(axis="y", useOffset=False)
    if axes.get_xscale() == "linear":
        axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.set(xlabel=x_label, ylabel=y_label)


def draw_fit(folder: Path) -> Path:
    """fit.png: every measured curve with the law before and after, and the parameters."""
    with opened(folder / "fit.h5") as file:
        heading = _attributes(file["curves"])["title"]
        curves = [
            {name: dataset[...] for name, dataset in group.items()} | _attributes(group)
            for group in _numbered(file["curves"])
        ]
        parameters = {name: _attributes(group) for name, group in file["parameters"].items()}
    panels = len(curves) + 1
    columns = min(panels, PANELS_IN_A_ROW)
    rows = -(-panels // columns)
    size = (3.6 * columns + 0.6, 3.6 * rows)
    figure, grid = plt.subplots(rows, columns, figsize=size, layout="constrained", squeeze=False)
    for panel, curve in zip(grid.flat, curves):
        _draw_fitted_curve(panel, curve)
    _draw_parameters(grid.flat[panels - 1], parameters)
    label_panels(grid.flat, *(curve["name"] for curve in curves), "parameters")
    for unused in grid.flat[panels:]:
        unused.set_axis_off()
    head_figure(figure, heading)
    target = folder / "fit.png"
    save(figure, target)
    return target


def _draw_fitted_curve(axes: Axes, curve: dict[str, Any]) -> None:
    (x,), x_label = _in_suitable_unit([curve["driven"]], curve["driven_by"])
    measured, deviation = curve["measured"], curve["deviation"]
    error = measured * deviation if curve["relative"] else np.full_like(measured, deviation)
    series = [measured, curve["start"], curve["fitted"], error]
    (measured, start, fitted, error), y_label = _in_suitable_unit(series, curve["compared"])
    axes.plot(x, start, "--", color=FIRST, lw=1.2, label="start")
    axes.plot(x, fitted, color=PATH, lw=LINE_WIDTH, marker=".", ms=4, label="fitted")
    look = {"mfc": "white", "mec": MEASURED, "ms": 4.5, "label": "measured", "zorder": 5}
    if deviation > 0:
        look["label"] = "measured, one deviation"
        axes.errorbar(x, measured, yerr=error, fmt="o", ecolor="0.4", lw=0.8, **look)
    else:
        axes.plot(x, measured, "o", **look)
    if len(x) > 3 and x.min() > 0 and x.max() > 30 * x.min():
        axes.set_xscale("log")
    x_label, y_label = (label.replace("_", " ") for label in (x_label, y_label))
    axes.set(xlabel=x_label, ylabel=y_label.replace("m3", "m³"))
    axes.legend(fontsize=8)


def _parameter_text(parameter: dict[str, Any]) -> str:
    value, unit = parameter["value"], parameter["unit"]
    if unit == "Pa":
        size, unit = _stress_unit(np.array([value]))
        value = value / size
    return f"{value:.4g} {unit}".strip().replace(" degree", "°")


def _draw_parameters(axes: Axes, parameters: dict[str, dict[str, Any]]) -> None:
    """Standard deviations over the values, and the values."""
    names = list(parameters)[::-1]
    look = {"transform": axes.get_yaxis_transform(), "fontsize": 8, "va": "bottom"}
    for row, name in enumerate(names):
        parameter = parameters[name]
        value, deviation = parameter["value"], parameter["deviation"]
        share = deviation / abs(value) if value else np.inf
        if np.isfinite(share) and parameter["determined"]:
            axes.errorbar(0, row, xerr=100 * share, fmt="o", color=PATH, capsize=3, lw=1.4, ms=5)
        else:
            axes.axhspan(row - 0.28, row + 0.28, color="0.92", zorder=0)
            if np.isfinite(share):
                axes.plot(0, row, "o", mfc="white", mec="0.4", ms=5)
            text = "uncertainty unknown" if parameter["determined"] else "not determined"
            axes.text(0.5, row - 0.3, text, color="0.35", ha="center", **look)
        axes.text(1.0, row + 0.17, _parameter_text(parameter), color="0.2", ha="right", **look)
    axes.axvline(0, color="0.7", lw=0.8, zorder=0)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(-0.6, len(names) - 0.3)
    limit = max(abs(end) for end in axes.get_xlim())
    axes.set_xlim(-limit, limit)
    axes.set_xlabel("standard deviation [% of the value]")
    axes.spines["left"].set_visible(False)
