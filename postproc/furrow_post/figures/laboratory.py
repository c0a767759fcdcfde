# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of furrow-post laboratory: one test kind, all its runs, measurements and continuum laws beside them."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

from .laboratory import cell_curve
from .results import ResultsError
from .style import annotate_panel, save, use_style

KPA = 1e-3


def _oedometer(tests, measured, points):
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for test in tests:
        strain, stress, density = cell_curve(test.curve())
        above = stress[:, 2] > 1.0
        panels[0].semilogy(density[above], stress[above, 2] * KPA, lw=1.3, label=f"grains: {test.label}")
        panels[1].plot(stress[above, 2] * KPA, stress[above, :2].mean(axis=1) * KPA, lw=1.3)
    for point in points:
        loaded = point.columns["axial_stress"] > 1.0
        panels[0].semilogy(point.columns["density"][loaded], point.columns["axial_stress"][loaded] * KPA, "--", lw=1.3, color="0.3",
                           label=f"continuum: {point.label}")
        panels[1].plot(point.columns["axial_stress"] * KPA, -point.columns["stress_xx"] * KPA, "--", lw=1.3, color="0.3")
    if measured:
        panels[0].semilogy(*np.array([(rho, sigma * KPA) for rho, sigma in measured]).T, "ko", ms=5, label="measured")
    panels[0].set(xlabel="density [kg/m³]", ylabel="axial stress [kPa]")
    largest = max(cell_curve(test.curve())[1][:, 2].max() for test in tests) * KPA
    panels[0].set_ylim(1e-3 * largest, 3 * largest)
    panels[1].set(xlabel="axial stress [kPa]", ylabel="lateral stress [kPa]", xlim=(0, 1.05 * largest), ylim=(0, 1.05 * largest))
    panels[0].legend(fontsize=8)
    annotate_panel(panels[0], "a", "confined compression")
    annotate_panel(panels[1], "b", "earth pressure at rest")
    return figure


def _triaxial(tests, measured, points):
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for test in tests:
        strain, stress, _ = cell_curve(test.curve())
        panels[0].plot(100 * strain[:, 2], (stress[:, 2] - stress[:, :2].mean(axis=1)) * KPA, lw=1.1, label=f"grains: {test.label}")
        panels[1].plot(100 * strain[:, 2], 100 * strain.sum(axis=1), lw=1.1)
    for point in points:
        c = point.columns
        start = int(np.argmax(c["segment"] > 0)) if c["segment"].max() > 0 else 0
        axial, volume = c["axial_strain"] - c["axial_strain"][start], c["eps_vol"] - c["eps_vol"][start]
        later = slice(start, None)
        panels[0].plot(100 * axial[later], c["q"][later] * KPA, "--", color="0.3", label=f"continuum: {point.label}")
        panels[1].plot(100 * axial[later], 100 * volume[later], "--", color="0.3")
    panels[0].set(xlabel="axial strain [%]", ylabel="axial minus lateral stress [kPa]")
    panels[1].set(xlabel="axial strain [%]", ylabel="volume strain [%], compression positive")
    panels[0].legend(fontsize=8)
    annotate_panel(panels[0], "a", "triaxial compression")
    annotate_panel(panels[1], "b", "volume")
    return figure


def _shear(tests, measured, points):
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for test in tests:
        rows = test.curve()
        panels[0].plot(rows[:, 8] * 1e3, rows[:, 9] * KPA, lw=1.1, label=f"grains: {test.label}")
        panels[1].plot(rows[:, 8] * 1e3, rows[:, 7], lw=1.1)
    panels[0].set(xlabel="displacement [mm]", ylabel="shear stress [kPa]")
    panels[1].set(xlabel="displacement [mm]", ylabel="density of the cell [kg/m³]")
    panels[0].legend(fontsize=8)
    annotate_panel(panels[0], "a", "direct shear")
    annotate_panel(panels[1], "b", "density")
    return figure


def _plate(tests, measured, points):
    figure, axes = plt.subplots(figsize=(6, 4.2), layout="constrained")
    for test in tests:
        rows = test.curve()
        axes.plot(rows[:, 1] * 1e3, rows[:, 3] * KPA, lw=1.1, label=f"{test.label}, {test.number('size') * 1e3:g} mm")
    axes.set(xlabel="sinkage [mm]", ylabel="mean pressure [kPa]", xlim=(0, None))
    axes.legend(fontsize=8)
    return figure


def _heap(tests, measured, points):
    figure, panels = plt.subplots(len(tests), 1, figsize=(8, 3.2 * len(tests)), layout="constrained", squeeze=False)
    for axes, test in zip(panels[:, 0], tests):
        deposit = test.grains("deposit")
        names = {q.name: q for q in test.evaluate()}
        if test.kind == "repose":
            across, q = deposit[:, 0], names["angle_of_repose"]
            text = f"angle of repose {q.value:.1f} ± {q.error:.1f}°"
        else:
            middle = np.average(deposit[:, :2], axis=0)
            distance = np.hypot(*(deposit[:, :2] - middle).T)
            across = np.copysign(distance, deposit[:, 0] - middle[0])
            q = names["runout_over_Lube"]
            text = f"a = {names['aspect'].value:.2f}, run-out {names['runout'].value:.2f}: {q.value:.2f} ± {q.error:.2f} of Lube et al. (2004)"
            expected = test.number("radius") * (1 + names["runout"].value / q.value)
            for side in (-1, 1):
                axes.axvline(side * expected * 100, color="C3", ls="--", lw=1)
        axes.scatter(100 * across, 100 * deposit[:, 2], s=5, c=deposit[:, 2], cmap="copper")
        axes.set(xlabel="cm", ylabel="cm", aspect="equal")
        axes.set_title(f"{test.label}: {text}", loc="left")
    return figure


FIGURES = {"oedometer": _oedometer, "triaxial": _triaxial, "shear": _shear, "plate": _plate, "repose": _heap, "collapse": _heap}


def draw(tests, measured, points, target):
    kinds = {test.kind for test in tests}
    if len(kinds) != 1:
        raise ResultsError(f"a figure needs tests of one kind, not {', '.join(sorted(kinds))}; name folders of one test")
    use_style()
    save(FIGURES[kinds.pop()](tests, measured, points), target)
