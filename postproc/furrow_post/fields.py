# SPDX-License-Identifier: GPL-2.0-or-later
"""Named arrays of a file."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .arrays import Floats
from .errors import ResultsError


class Fields(dict[str, Floats]):
    """Name -> array of a file; asking for one that the file has not is an error that names both."""

    def __init__(self, file: Path, arrays: Mapping[str, Floats], remedy: str) -> None:
        super().__init__(arrays)
        self.file, self.remedy = file, remedy

    def __missing__(self, name: str) -> Floats:
        raise ResultsError(f"{self.file}: has no '{name}'; {self.remedy}")

    def require_rows(self) -> int:
        """Their common number of rows. @raises ResultsError where they differ"""
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
