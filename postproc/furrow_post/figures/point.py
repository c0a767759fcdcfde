# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of a results folder of furrow-point: point_figures.py <folder>. SI in the files, kPa and MPa in the figure."""

import sys
from pathlib import Path

import h5py
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

PATH, SURFACE, FIRST, MEASURED = "#c2410c", "#a9c3dd", "#7d97b3", "0.1"

# What a path shows: panel b as (x channel, x label, y channel, y label), panel c the same.
LABELS = {
    "axial_strain": "axial strain $\\varepsilon_1$ (logarithmic)", "eps_vol": "volume strain $-\\ln J$",
    "shear_strain": "shear $\\gamma$", "density": "density $\\rho$ [kg/m³]", "p": "pressure $p$", "q": "Mises stress $q$",
    "axial_stress": "axial stress $\\sigma_1$", "shear_stress": "shear stress $\\tau_{xz}$",
}
PANELS = {
    "hydrostatic": (("eps_vol", "p"), ("p", "density")),
    "confined": (("axial_strain", "axial_stress"), ("axial_stress", "density")),
    "triaxial": (("axial_strain", "q"), ("axial_strain", "eps_vol")),
    "simple_shear": (("shear_strain", "shear_stress"), ("shear_strain", "eps_vol")),
    "cyclic": (("axial_strain", "axial_stress"), ("axial_stress", "density")),
    "tension": (("axial_strain", "axial_stress"), ("axial_strain", "eps_vol")),
    "table": (("axial_strain", "axial_stress"), ("p", "density")),
}


def use_style():
    plt.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 10, "axes.titlelocation": "left",
        "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8, "legend.frameon": False,
        "figure.facecolor": "white", "lines.linewidth": 1.6,
    })


def attributes(item):
    return {name: value.decode() if isinstance(value, bytes) else value for name, value in item.attrs.items()}


def numbered(group):
    """The members 0, 1, 2, ... in their order."""
    return [group[str(number)] for number in range(len(group))]


def stress_unit(*arrays):
    """Divisor and name of the unit that suits the largest stress."""
    largest = max(float(np.max(np.abs(a))) if len(a) else 0.0 for a in arrays)
    for size, name in ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")):
        if largest >= size:
            return size, name
    return 1.0, "Pa"


def title(axes, letter, text):
    axes.set_title(f"$\\mathbf{{{letter}}}$  {text}", color="0.15")


def mark_ends(axes, x, y, segment):
    """A dot where a segment ends, an open one at the start."""
    ends = segment_ends(segment)
    if len(ends) <= 30:
        axes.plot(x[ends], y[ends], "o", color=PATH, ms=3.5, zorder=4, clip_on=False)
    axes.plot(x[0], y[0], "o", mfc="white", mec=PATH, ms=4.5, zorder=5, clip_on=False)


def segment_ends(segment):
    return np.append(np.flatnonzero(np.diff(segment)), len(segment) - 1)


def spans_decades(targets):
    """Three positive targets or more, over two decades or more."""
    positive = np.unique(targets[targets > 0])
    return len(positive) >= 3 and positive[-1] >= 100 * positive[0]


def draw_invariants(axes, point, surfaces):
    p, q = point["p"], point["q"]
    size, unit = stress_unit(p, q)
    for index, (surface_p, surface_q) in enumerate(surfaces):
        last = index == len(surfaces) - 1
        label = "yield surface at the end" if last else "yield surface at the start" if index == 0 else None
        if last:
            axes.plot(surface_p / size, surface_q / size, color=SURFACE, lw=4, label=label, zorder=1, solid_capstyle="butt")
        elif index == 0 or len(surfaces) < 20:
            line, width = ("--", 1.2) if index == 0 else ("-", 0.6)
            axes.plot(surface_p / size, surface_q / size, color=FIRST, ls=line, lw=width, label=label, zorder=2)
    axes.plot(p / size, q / size, color=PATH, label="path", zorder=3)
    mark_ends(axes, p / size, q / size, point["segment"])
    axes.axhline(0, color="0.6", lw=0.6, zorder=0)
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.set(xlabel=f"pressure $p$ [{unit}]", ylabel=f"Mises stress $q$ [{unit}]")
    visible = [s for s in surfaces if s[0].max() < 3 * max(p.max(), 1e-30)] if surfaces else []
    right = max([p.max()] + [s[0].max() for s in visible]) / size
    left = min([p.min()] + [s[0].min() for s in surfaces if s[0].min() > -0.6 * right * size], default=p.min()) / size
    top = max([q.max()] + [s[1].max() for s in visible]) / size
    span = max(right - left, 1e-12)
    axes.set_xlim(left - 0.06 * span, right + 0.06 * span)
    if top > 0:
        axes.set_ylim(-0.04 * top, 1.42 * top)
    axes.legend(loc="upper left", fontsize=8, handlelength=1.6)
    title(axes, "a", "stress path")


def draw_pair(axes, letter, point, x_name, y_name, text):
    values, labels = {}, {}
    for name in (x_name, y_name):
        value, label = point[name], LABELS[name]
        if name in ("p", "q", "axial_stress", "shear_stress"):
            size, unit = stress_unit(value)
            value, label = value / size, f"{label} [{unit}]"
        values[name], labels[name] = value, label
    x, y = values[x_name], values[y_name]
    ends = segment_ends(point["segment"])
    kept = np.ones(len(x), dtype=bool)
    for name, scale in ((x_name, axes.set_xscale), (y_name, axes.set_yscale)):
        if name in ("p", "axial_stress") and spans_decades(point[name][ends]):
            scale("log")
            targets = point[name][ends]
            kept &= point[name] > 0.3 * targets[targets > 0].min()
    axes.plot(x[kept], y[kept], color=PATH)
    if kept.all():
        mark_ends(axes, x, y, point["segment"])
    else:
        axes.plot(x[ends], y[ends], "o", color=PATH, ms=3.5, zorder=4)
    if axes.get_yscale() == "linear":
        if y.min() <= 0 <= y.max():
            axes.axhline(0, color="0.6", lw=0.6, zorder=0)
        axes.ticklabel_format(axis="y", useOffset=False)
    if axes.get_xscale() == "linear":
        axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.set(xlabel=labels[x_name], ylabel=labels[y_name])
    title(axes, letter, text)


def draw_run(folder):
    with h5py.File(folder / "point.h5") as file:
        point = {name: dataset[...] for name, dataset in file["point"].items()}
        head = attributes(file["point"])
        surfaces = [(group["p"][...], group["q"][...]) for group in numbered(file["yield_surface"])]
    (b_x, b_y), (c_x, c_y) = PANELS[head["path"]]
    if head["path"] == "table" and np.ptp(point["shear_strain"]) > np.ptp(point["axial_strain"]):
        b_x, b_y = "shear_strain", "shear_stress"
    figure, axes = plt.subplots(1, 3, figsize=(10.2, 3.5), layout="constrained")
    draw_invariants(axes[0], point, surfaces)
    draw_pair(axes[1], "b", point, b_x, b_y, "stress and strain")
    draw_pair(axes[2], "c", point, c_x, c_y, "volume")
    figure.suptitle(f"{head['title']}\n", x=0.01, ha="left", fontsize=11, fontweight="bold")
    subtitle = f"{head['material']}  ·  law {head['law']}  ·  path {head['path'].replace('_', ' ')}"
    figure.text(0.01, 0.925, subtitle, fontsize=8.5, color="0.35", va="top")
    figure.savefig(folder / "point.png", dpi=150)
    return folder / "point.png"


def draw_fit(folder):
    with h5py.File(folder / "fit.h5") as file:
        heading = attributes(file["curves"])["title"]
        curves = [{name: dataset[...] for name, dataset in group.items()} | attributes(group)
                  for group in numbered(file["curves"])]
        parameters = {name: attributes(group) for name, group in file["parameters"].items()}
    panels = len(curves) + 1
    figure, axes = plt.subplots(1, panels, figsize=(3.6 * panels + 0.6, 3.6), layout="constrained", squeeze=False)
    for number, (panel, curve) in enumerate(zip(axes[0], curves)):
        draw_curve(panel, "abcdefgh"[number], curve)
    draw_parameters(axes[0][-1], "abcdefgh"[len(curves)], parameters)
    figure.suptitle(heading, x=0.01, ha="left", fontsize=11, fontweight="bold")
    figure.savefig(folder / "fit.png", dpi=150)
    return folder / "fit.png"


def with_unit_scaled(values, label):
    if label.endswith("[Pa]"):
        size, unit = stress_unit(*values)
        return [v / size for v in values], label.replace("[Pa]", f"[{unit}]")
    return values, label


def draw_curve(axes, letter, curve):
    (x,), x_label = with_unit_scaled([curve["driven"]], curve["driven_by"])
    (measured, start, fitted), y_label = with_unit_scaled([curve[name] for name in ("measured", "start", "fitted")],
                                                          curve["compared"])
    axes.plot(x, start, "--", color=FIRST, lw=1.2, label="start")
    axes.plot(x, fitted, color=PATH, marker=".", ms=4, label="fitted")
    deviation = curve["deviation"]
    if deviation > 0:
        error = measured * deviation if curve["relative"] else np.full_like(measured, deviation)
        axes.errorbar(x, measured, yerr=error, fmt="o", mfc="white", mec=MEASURED, ecolor="0.4", ms=4.5, lw=0.8,
                      label="measured", zorder=5)
    else:
        axes.plot(x, measured, "o", mfc="white", mec=MEASURED, ms=4.5, label="measured", zorder=5)
    if len(x) > 3 and x.min() > 0 and x.max() > 30 * x.min():
        axes.set_xscale("log")
    axes.set(xlabel=x_label.replace("_", " "), ylabel=y_label.replace("_", " ").replace("m3", "m³"))
    axes.legend(fontsize=8)
    title(axes, letter, curve["name"])


def value_text(parameter):
    value, unit = parameter["value"], parameter["unit"]
    if unit == "Pa":
        size, unit = stress_unit(np.array([value]))
        value /= size
    return f"{value:.4g} {unit}".strip().replace(" degree", "°")


def draw_parameters(axes, letter, parameters):
    names = list(parameters)[::-1]
    for row, name in enumerate(names):
        p = parameters[name]
        share = p["deviation"] / abs(p["value"]) if p["value"] else np.inf
        if np.isfinite(share) and p["determined"]:
            axes.errorbar(0, row, xerr=100 * share, fmt="o", color=PATH, capsize=3, lw=1.4, ms=5)
        else:
            axes.axhspan(row - 0.28, row + 0.28, color="0.92", zorder=0)
            if np.isfinite(share):
                axes.plot(0, row, "o", mfc="white", mec="0.4", ms=5)
            axes.text(0.5, row - 0.3, "uncertainty unknown" if p["determined"] else "not determined",
                      transform=axes.get_yaxis_transform(), fontsize=8, color="0.35", ha="center", va="bottom")
        axes.text(1.0, row + 0.17, value_text(p), transform=axes.get_yaxis_transform(), fontsize=8, color="0.2", ha="right",
                  va="bottom")
    axes.axvline(0, color="0.7", lw=0.8, zorder=0)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(axis="y", length=0)
    axes.set_ylim(-0.6, len(names) - 0.3)
    limit = max(abs(v) for v in axes.get_xlim())
    axes.set_xlim(-limit, limit)
    axes.set_xlabel("standard deviation [% of the value]")
    axes.spines["left"].set_visible(False)
    title(axes, letter, "parameters")


def main():
    folder = Path(sys.argv[1])
    use_style()
    drawn = draw_run(folder) if (folder / "point.h5").exists() else draw_fit(folder)
    print(f"  figure        {drawn}")


if __name__ == "__main__":
    main()
