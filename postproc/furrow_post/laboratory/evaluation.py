# SPDX-License-Identifier: GPL-2.0-or-later
"""Quantities of one test, by its kind."""

from collections.abc import Callable

import numpy as np

from ..errors import content_of
from ..read.laboratory import LaboratoryTest
from .cell import extension, oedometer, plane_strain, tension, triaxial, unconfined
from .deposit import collapse, repose
from .plate import plate
from .quantity import LaboratoryQuantity
from .shear import shear

EVALUATIONS: dict[str, Callable[[LaboratoryTest], list[LaboratoryQuantity]]] = {
    "oedometer": oedometer,
    "triaxial": triaxial,
    "extension": extension,
    "plane_strain": plane_strain,
    "unconfined": unconfined,
    "tension": tension,
    "shear": shear,
    "collapse": collapse,
    "repose": repose,
    "plate": plate,
}


def evaluate(test: LaboratoryTest) -> list[LaboratoryQuantity]:
    """Quantities of one test. @raises ResultsError where its curve or deposit is no such test's"""
    remedy = "was the run stopped, or too short? Make it again"
    with content_of(test.folder, remedy), np.errstate(all="ignore"):
        return EVALUATIONS[test.kind](test)


def values_of(test: LaboratoryTest) -> dict[str, float]:
    """Name -> value of what a test gives."""
    return {quantity.name: quantity.value for quantity in evaluate(test)}
