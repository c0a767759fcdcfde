# SPDX-License-Identifier: GPL-2.0-or-later
"""Names of the array types that annotations use; contents of a file by name: arrays, units."""

import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from .errors import ResultsError

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Booleans = npt.NDArray[np.bool_]

Array = TypeVar("Array", Floats, Integers)
Value = TypeVar("Value")


def read_only(values: Array) -> Array:
    """Array protected against writing; other values are returned unchanged."""
    if isinstance(values, np.ndarray):
        values.flags.writeable = False
    return values


class Named(dict[str, Value]):
    """Name -> value of a file; asking for a name that the file has not is an error that lists all."""

    def __init__(self, file: Path, values: Mapping[str, Value], remedy: str) -> None:
        super().__init__(values)
        self.file, self.remedy = file, remedy

    def __missing__(self, name: str) -> Value:
        near = difflib.get_close_matches(str(name), self, n=3)
        remedy = f"did you mean {' or '.join(near)}?" if near else self.remedy
        there = f"; it has {', '.join(self)}" if self else ""
        raise ResultsError(f"{self.file}: has no '{name}'{there}; {remedy}")


class Fields(Named[Floats]):
    """Arrays of a file, protected against writing."""

    def __init__(self, file: Path, arrays: Mapping[str, Floats], remedy: str) -> None:
        super().__init__(file, {name: read_only(values) for name, values in arrays.items()}, remedy)

    def require_rows(self) -> int:
        """Common number of rows of the arrays. @raises ResultsError where they differ"""
        lengths = {len(values) for values in self.values()}
        if len(lengths) > 1:
            raise ResultsError(
                f"{self.file}: its arrays have {min(lengths)} to {max(lengths)} rows; {self.remedy}"
            )
        return lengths.pop() if lengths else 0

    def require_finite(self, *names: str) -> None:
        """@raises ResultsError where one of these is not an array of finite numbers"""
        for name in names:
            values = self[name]
            if values.dtype.kind not in "fiu" or not np.isfinite(values).all():
                raise ResultsError(
                    f"{self.file}: '{name}' has a value that is no finite number; {self.remedy}"
                )
