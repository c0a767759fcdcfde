# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantities of one test, by its kind; an oedometer against a measured curve."""

from collections.abc import Callable

import numpy as np

from ..uncertainty.statistics import rms
from ..errors import ResultsError, content_of
from ..read.laboratory import KINDS, LaboratoryTest, cell_curve
from . import curve_tests, deposit
from .quantity import LaboratoryQuantity

EVALUATIONS: dict[str, Callable[[LaboratoryTest], list[LaboratoryQuantity]]] = {
    kind: getattr(deposit if kind in ("collapse", "repose") else curve_tests, kind) for kind in KINDS
}


def evaluate(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Quantities of one test. @raises ResultsError for a curve or deposit of another kind of test"""
    remedy = "was the run stopped, or too short? Make it again"
    with content_of(test.folder, remedy), np.errstate(all="ignore"):
        return EVALUATIONS[test.kind](test)


def values_of(test: LaboratoryTest) -> dict[str, float]:
    """Name -> value of what a test gives."""
    return {quantity.name: quantity.value for quantity in evaluate(test)}


Oedometer = list[tuple[float, float]]  # (density [kg/m3], axial stress [Pa]), rising


def reference_error(
    test: LaboratoryTest, reference: Oedometer, lowest: float = 5e4, highest: float = 1e6
) -> list[LaboratoryQuantity]:
    """rms ln-errors of stress at given density, and of density at given stress, from a measurement.

    Over [lowest, highest] Pa. @raises ResultsError where the test reaches fewer than two points
    """
    _, stress, density = cell_curve(test.curve())
    axial = np.maximum.accumulate(np.maximum(stress[:, 2], 1e-3))
    end = int(np.argmax(stress[:, 2])) + 1
    wanted = [(rho, sigma) for rho, sigma in reference if lowest <= sigma <= highest]
    measured = [
        (rho, sigma) for rho, sigma in wanted if sigma <= axial[end - 1] and rho <= density[end - 1]
    ]
    if len(measured) < 2:
        raise ResultsError(
            f"{test.folder}: ends at {axial[end - 1]:.3g} Pa and {density[end - 1]:.3g} kg/m3, "
            "before two points of the reference"
        )
    points = np.array(measured)
    of_stress = np.log(np.interp(points[:, 0], density[:end], axial[:end]) / points[:, 1])
    of_density = np.log(np.interp(points[:, 1], axial[:end], density[:end]) / points[:, 0])
    counted = f"of stress at the measured densities, {len(measured)} of {len(wanted)} points"
    return [
        LaboratoryQuantity("rms_ln_stress", rms(of_stress), 0.0, "", counted),
        LaboratoryQuantity(
            "rms_ln_density", rms(of_density), 0.0, "", "of density at the measured stresses"
        ),
    ]
