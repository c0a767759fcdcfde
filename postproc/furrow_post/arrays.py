# SPDX-License-Identifier: GPL-2.0-or-later
"""Names of the array types that annotations use."""

from typing import TypeVar

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Booleans = npt.NDArray[np.bool_]

Array = TypeVar("Array", Floats, Integers)


def read_only(values: Array) -> Array:
    """The same array, which refuses to be written to; what is no array stays as it is."""
    if isinstance(values, np.ndarray):
        values.flags.writeable = False
    return values
