# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of inputs/validation, from which errors of other runs follow; absent where only the package is installed."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Generic, TypeVar

from ..csv_table import read_rows
from ..errors import content_of
from ..programs import inputs_folder

Rows = Sequence[Mapping[str, str]]
Content = TypeVar("Content")


@dataclass(frozen=True)
class ValidationTable(Generic[Content]):
    """A table that a study writes. parse: content from its rows, which raises ValueError"""

    name: str
    parse: Callable[[Rows], Content]
    study: str = "validation"

    def stored(self) -> Content:
        """Content of the table; that of no rows where it is absent. @raises ResultsError"""
        inputs = inputs_folder()
        path = inputs / "validation" / self.name if inputs else None
        return self._read(path) if path and path.is_file() else self.parse([])

    @lru_cache(maxsize=None)
    def _read(self, path: Path) -> Content:
        with content_of(path, f"write it again with 'furrow-post study {self.study}'"):
            return self.parse(read_rows(path))
