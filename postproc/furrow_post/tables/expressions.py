# SPDX-License-Identifier: GPL-2.0-or-later
"""Python expressions in a study.yaml, such as "round(1e3 * sinkage_m, 1)"."""

import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..uncertainty.statistics import block_mean, drift, rms
from ..errors import ResultsError
from ..study.values import NOT_ESTIMATED


def rounded(value: Any, digits: int | None = None) -> Any:
    """The decimal number nearest to a value; NaN stays NaN."""
    number = float(value)
    return number if math.isnan(number) else round(number, digits)


def number(cell: Any) -> float:
    """A cell of a column that may be empty or not estimated; NaN of such a cell."""
    return math.nan if cell in ("", NOT_ESTIMATED) else float(cell)


def whole(cell: Any) -> Any:
    """A cell of a column of whole numbers that may be empty."""
    return "" if math.isnan(number(cell)) else int(number(cell))


FUNCTIONS: Mapping[str, Any] = {
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "hypot", "sin", "cos", "tan", "radians", "degrees", "pi", "nan", "isnan")},
    "round": rounded, "number": number, "whole": whole, "mean": np.mean, "rms": rms, "block_mean": block_mean, "drift": drift, "np": np, "re": re,
}  # fmt: skip  # next to Python's own


def value_of(text: Any, names: Mapping[str, Any], where: str) -> Any:
    """The value of an expression; what is no text is a value already.

    @raises NameError for a name that is not known, ResultsError for any other fault
    """
    if not isinstance(text, str):
        return text
    try:
        return eval(text, {**FUNCTIONS, **names})  # a study may hold programs, too
    except NameError:
        raise
    except Exception as error:
        known = ", ".join(sorted(map(str, names)))
        raise ResultsError(f"{where}: '{text}' fails ({error}); known names are {known}") from error


def filled(arguments: Any, names: Mapping[str, Any], where: str) -> Any:
    """Arguments of a measure, in which a text that begins with "=" is an expression."""
    if isinstance(arguments, Mapping):
        return {key: filled(value, names, where) for key, value in arguments.items()}
    if isinstance(arguments, list):
        return [filled(value, names, where) for value in arguments]
    if isinstance(arguments, str) and arguments.startswith("="):
        return value_of(arguments[1:].strip(), names, where)
    return arguments
