# SPDX-License-Identifier: GPL-2.0-or-later
"""Names of the array types that annotations use."""

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Booleans = npt.NDArray[np.bool_]
