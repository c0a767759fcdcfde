# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of a results folder of furrow-sidewall: sidewall_figures.py <folder>. SI in files, mm and kN in the figure."""

import sys
from pathlib import Path

import h5py
import matplotlib.pyplot as plt
import numpy as np

SOLVED, LOOKED_UP, AXIAL = "#c2410c", "0.15", "#3b6ea5"


def use_style():
    plt.rcParams.update({
        "font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 10, "axes.titlelocation": "left",
        "axes.spines.top": False, "axes.spines.right": False, "axes.linewidth": 0.8, "legend.frameon": False,
        "figure.facecolor": "white", "lines.linewidth": 1.6,
    })


def title(axes, letter, text):
    axes.set_title(f"$\\mathbf{{{letter}}}$  {text}", color="0.15")


def draw_section(axes, profiles):
    shades = plt.get_cmap("YlOrBr")(np.linspace(0.85, 0.3, len(profiles)))
    for (deflection, A, R), shade in zip(profiles, shades):
        for side in (-1, 1):
            axes.plot(side * A * 1e3, R * 1e3, color=shade, marker="." if deflection == 0 else None, ms=4)
        axes.plot([-A[-1] * 1e3, A[-1] * 1e3], [R[-1] * 1e3] * 2, color=shade, lw=2.8, solid_capstyle="butt")
        if deflection in (profiles[0][0], profiles[-1][0]):
            axes.text(0, R[-1] * 1e3 + 2, f"{deflection * 1e3:.0f} mm", ha="center", va="bottom", fontsize=8, color="0.3")
    _, A, R = profiles[0]
    for side in (-1, 1):
        axes.plot(side * A[0] * 1e3, R[0] * 1e3, "s", color="0.3", ms=5, zorder=5)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="axial $A$ [mm]", ylabel="radius $R$ [mm]")
    title(axes, "a", "section at deflections of the tread edge")


def draw_forces(axes, letter, curve, scale, label, text):
    x = curve["moved"] * scale
    step = max(1, len(x) // 20)
    for name, color, kind in (("F_r", SOLVED, "radial"), ("F_a", AXIAL, "axial")):
        axes.plot(x, curve[name] / 1e3, color=color, label=f"{kind}, solved")
        axes.plot(x[::step], curve[name + "_table"][::step] / 1e3, "o", mfc="none", mec=LOOKED_UP, mew=0.8, ms=4,
                  label="looked up" if kind == "axial" else None, zorder=4)
    axes.axhline(0, color="0.7", lw=0.6, zorder=0)
    axes.axvline(0, color="0.7", lw=0.6, zorder=0)
    inner = np.concatenate([curve["F_r"], curve["F_a"]])[np.tile(curve["r"] ** 2 + curve["a"] ** 2
                                                                 < 0.97 * np.max(curve["r"] ** 2 + curve["a"] ** 2), 2)] / 1e3
    axes.set_ylim(inner.min() - 0.15 * np.ptp(inner), inner.max() + 0.35 * np.ptp(inner))
    axes.set(xlabel=label, ylabel="force on the tread [kN/m]")
    axes.legend(fontsize=8, loc="upper center", ncols=3, columnspacing=1, handlelength=1.4)
    title(axes, letter, text)


def draw_errors(axes, curves):
    for (name, label, scale), color in zip((("deflection", "deflection", 1), ("lateral", "axial motion", 1)), (SOLVED, AXIAL)):
        curve = curves[name]
        error = np.hypot(curve["F_a_table"] - curve["F_a"], curve["F_r_table"] - curve["F_r"])
        force = np.hypot(curve["F_a"], curve["F_r"])
        axes.semilogy(curve["moved"] * 1e3, np.maximum(error / force, 1e-16), color=color, label=label)
    axes.set(xlabel="motion of the tread edge [mm]", ylabel="difference over force")
    axes.legend(fontsize=8)
    title(axes, "d", "table against solution")


def main():
    folder = Path(sys.argv[1])
    use_style()
    with h5py.File(folder / "sidewall.h5") as file:
        curves = {name: {key: data[...] for key, data in file[name].items()} for name in ("deflection", "lateral", "rotation")}
        profiles = [(group.attrs["deflection"], group["A"][...], group["R"][...])
                    for group in (file["profiles"][str(n)] for n in range(len(file["profiles"])))]
        heading, pressure = file.attrs["title"], file.attrs["pressure"]
    heading = heading.decode() if isinstance(heading, bytes) else heading
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 7.0), layout="constrained")
    draw_section(axes[0][0], profiles)
    draw_forces(axes[0][1], "b", curves["deflection"], 1e3, "deflection [mm]", "tread edge pressed towards the rim")
    draw_forces(axes[1][0], "c", curves["lateral"], 1e3, "axial motion, outwards [mm]", "tread edge moved sideways")
    draw_errors(axes[1][1], curves)
    figure.suptitle(f"{heading} at {pressure / 1e3:.4g} kPa", x=0.01, ha="left", fontsize=11, fontweight="bold")
    figure.savefig(folder / "sidewall.png", dpi=150)
    print(f"  figure        {folder / 'sidewall.png'}")


if __name__ == "__main__":
    main()
