# SPDX-License-Identifier: GPL-2.0-or-later
"""Tables of measurements in SI units. furrow-point reads them, as it does for fits."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..arrays import Floats
from ..errors import ResultsError
from ..json_text import parse_json
from ..programs import find_program
from ..run.tools import Refused, answer

PROGRAM = "furrow-point"


@dataclass(frozen=True)
class Column:
    """Column of a table; unit: as its heading has it, empty without. NaN: an empty cell."""

    heading: str
    name: str
    unit: str
    values: Floats

    @property
    def key(self) -> str:
        """The name in lower case, letters and digits alone."""
        return "".join(c for c in self.name.lower() if c.isalnum())


def read_columns(path: Path) -> list[Column]:
    """Reads all columns of numbers. @raises ResultsError"""
    return _read(path, [])


def read_as(path: Path, units: Mapping[str, str]) -> list[Column]:
    """heading -> SI unit of its kind, "" for a ratio. @raises ResultsError for another or an unclear unit"""
    return _read(path, [f"{heading}={unit}" for heading, unit in units.items()])


def _read(path: Path, kinds: Sequence[str]) -> list[Column]:
    words = [word for kind in kinds for word in ("--as", kind)]
    try:
        text = answer([find_program(PROGRAM), "table", path, *words])
    except Refused as error:
        raise ResultsError(error.cause) from error
    return [
        Column(column["heading"], column["name"], column["unit"], np.array(column["values"], dtype=float))
        for column in parse_json(text)
    ]
