# SPDX-License-Identifier: GPL-2.0-or-later
"""The figure of laboratory tests: all runs of one kind, measurements and continuum laws."""

from collections.abc import Callable
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..errors import ResultsError
from ..laboratory.evaluation import evaluate
from ..laboratory.report import LaboratoryReport
from ..read.laboratory import cell_curve
from .style import CENTIMETRE, KILOPASCAL, MILLIMETRE, label_panels, save, use_style

VOLUME_STRAIN = "volume strain [%], compression positive"


def draw_laboratory(report: LaboratoryReport, target: Path) -> None:
    """@raises ResultsError for tests of several kinds"""
    kinds = {test.kind for test in report.tests}
    if len(kinds) != 1:
        several = ", ".join(sorted(kinds))
        raise ResultsError(f"a figure needs tests of one kind, not {several}; name folders of one test")
    use_style()
    figure = FIGURES[kinds.pop()](report)
    for axes in figure.axes:
        if axes.get_legend_handles_labels()[0]:
            axes.legend(fontsize=8)
    save(figure, target)


def _pair(titles: tuple[str, str], x: str, y: tuple[str, str]) -> tuple[Figure, Axes, Axes]:
    """Two panels with these labels of their axes."""
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")
    for axes, y_label in zip(panels, y):
        axes.set(xlabel=x, ylabel=y_label)
    label_panels(panels, *titles)
    return figure, panels[0], panels[1]


def _draw_oedometers(report: LaboratoryReport) -> Figure:
    titles = "confined compression", "earth pressure at rest"
    labels = "axial stress [kPa]", "lateral stress [kPa]"
    figure, left, right = _pair(titles, "axial stress [kPa]", labels)
    largest = 0.0
    for test in report.tests:
        _, stress, density = cell_curve(test.curve())
        axial, lateral = KILOPASCAL * stress[:, 2], KILOPASCAL * stress[:, :2].mean(axis=1)
        above = stress[:, 2] > 1.0
        left.semilogy(density[above], axial[above], lw=1.3, label=f"grains: {test.label}")
        right.plot(axial[above], lateral[above], lw=1.3)
        largest = max(largest, float(axial.max()))
    for point in report.points:
        axial = KILOPASCAL * point.columns["axial_stress"]
        lateral = -KILOPASCAL * point.columns["stress_xx"]
        loaded = point.columns["axial_stress"] > 1.0
        look = {"ls": "--", "lw": 1.3, "color": "0.3"}
        label = f"continuum: {point.label}"
        left.semilogy(point.columns["density"][loaded], axial[loaded], label=label, **look)
        right.plot(axial, lateral, **look)
    if report.measured:
        density, stress = np.array(report.measured).T
        left.semilogy(density, KILOPASCAL * stress, "ko", ms=5, label="measured")
    left.set(xlabel="density [kg/m³]", ylim=(1e-3 * largest, 3 * largest))
    room = (0, 1.05 * largest)
    right.set(xlim=room, ylim=room)
    return figure


def _draw_triaxial(report: LaboratoryReport) -> Figure:
    titles = "triaxial compression", "volume"
    labels = "axial minus lateral stress [kPa]", VOLUME_STRAIN
    figure, left, right = _pair(titles, "axial strain [%]", labels)
    for test in report.tests:
        strain, stress, _ = cell_curve(test.curve())
        axial = 100 * strain[:, 2]
        deviator = KILOPASCAL * (stress[:, 2] - stress[:, :2].mean(axis=1))
        left.plot(axial, deviator, lw=1.1, label=f"grains: {test.label}")
        right.plot(axial, 100 * strain.sum(axis=1), lw=1.1)
    for point in report.points:
        columns = point.columns
        segment = columns["segment"]
        start = int(np.argmax(segment > 0)) if segment.max() > 0 else 0
        axial = 100 * (columns["axial_strain"] - columns["axial_strain"][start])[start:]
        volume = 100 * (columns["eps_vol"] - columns["eps_vol"][start])[start:]
        look = {"ls": "--", "color": "0.3"}
        q = KILOPASCAL * columns["q"][start:]
        left.plot(axial, q, label=f"continuum: {point.label}", **look)
        right.plot(axial, volume, **look)
    return figure


def _draw_true_triaxial(report: LaboratoryReport) -> Figure:
    """Extension and plane strain: all three stresses."""
    titles = report.tests[0].kind.replace("_", " "), "volume"
    labels = "stress along x (dotted), y (dashed), z [kPa]", VOLUME_STRAIN
    figure, left, right = _pair(titles, "driven strain [%]", labels)
    for number, test in enumerate(report.tests):
        strain, stress, _ = cell_curve(test.curve())
        driven = 100 * strain[:, 0 if test.kind == "extension" else 2]
        for axis, style in enumerate((":", "--", "-")):
            label = f"grains: {test.label}" if axis == 2 else None
            look = {"ls": style, "lw": 1.1, "color": f"C{number}"}
            left.plot(driven, KILOPASCAL * stress[:, axis], label=label, **look)
        right.plot(driven, 100 * strain.sum(axis=1), lw=1.1)
    return figure


def _draw_free_sides(report: LaboratoryReport) -> Figure:
    """Compression and tension of cells without lateral stress."""
    labels = "axial stress [kPa]", "lateral strain, against the axial [%]"
    figure, left, right = _pair(("free sides", "lateral strain"), "axial strain [%]", labels)
    for test in report.tests:
        strain, stress, _ = cell_curve(test.curve())
        sign = -1 if test.kind == "tension" else 1
        axial = 100 * sign * strain[:, 2]
        left.plot(axial, KILOPASCAL * sign * stress[:, 2], lw=1.1, label=f"grains: {test.label}")
        right.plot(axial, -100 * sign * strain[:, :2].mean(axis=1), lw=1.1)
    return figure


def _draw_shear(report: LaboratoryReport) -> Figure:
    labels = "shear stress [kPa]", "density of the cell [kg/m³]"
    figure, left, right = _pair(("direct shear", "density"), "displacement [mm]", labels)
    for test in report.tests:
        rows = test.curve()
        travel = MILLIMETRE * rows[:, 8]
        left.plot(travel, KILOPASCAL * rows[:, 9], lw=1.1, label=f"grains: {test.label}")
        right.plot(travel, rows[:, 7], lw=1.1)
    return figure


def _draw_plates(report: LaboratoryReport) -> Figure:
    figure, axes = plt.subplots(figsize=(6, 4.2), layout="constrained")
    for test in report.tests:
        rows = test.curve()
        label = f"{test.label}, {MILLIMETRE * test.number('size'):g} mm"
        axes.plot(MILLIMETRE * rows[:, 1], KILOPASCAL * rows[:, 3], lw=1.1, label=label)
    axes.set(xlabel="sinkage [mm]", ylabel="mean pressure [kPa]", xlim=(0, None))
    return figure


def _draw_heaps(report: LaboratoryReport) -> Figure:
    rows = len(report.tests)
    figure, panels = plt.subplots(rows, 1, figsize=(8, 3.2 * rows), layout="constrained", squeeze=False)
    for axes, test in zip(panels[:, 0], report.tests):
        deposit = test.grains("deposit")
        found = {quantity.name: quantity for quantity in evaluate(test)}
        if test.kind == "repose":
            across, angle = deposit[:, 0], found["angle_of_repose"]
            finding = f"angle of repose {angle.value:.1f} ± {angle.error:.1f}°"
        else:
            middle = np.average(deposit[:, :2], axis=0)
            distance = np.hypot(*(deposit[:, :2] - middle).T)
            across = np.copysign(distance, deposit[:, 0] - middle[0])
            runout, ratio = found["runout"], found["runout_over_Lube"]
            finding = (
                f"a = {found['aspect'].value:.2f}, run-out {runout.value:.2f}: "
                f"{ratio.value:.2f} ± {ratio.error:.2f} of Lube et al. (2004)"
            )
            expected = test.number("radius") * (1 + runout.value / ratio.value)
            for side in (-1, 1):
                axes.axvline(side * CENTIMETRE * expected, color="C3", ls="--", lw=1)
        height = deposit[:, 2]
        axes.scatter(CENTIMETRE * across, CENTIMETRE * height, s=5, c=height, cmap="copper")
        axes.set(xlabel="cm", ylabel="cm", aspect="equal")
        axes.set_title(f"{test.label}: {finding}", loc="left")
    return figure


FIGURES: dict[str, Callable[[LaboratoryReport], Figure]] = {
    "oedometer": _draw_oedometers,
    "triaxial": _draw_triaxial,
    "extension": _draw_true_triaxial,
    "plane_strain": _draw_true_triaxial,
    "unconfined": _draw_free_sides,
    "tension": _draw_free_sides,
    "shear": _draw_shear,
    "plate": _draw_plates,
    "repose": _draw_heaps,
    "collapse": _draw_heaps,
}
