# SPDX-License-Identifier: GPL-2.0-or-later
"""Types of command line arguments: numbers in a range, texts that are not empty."""

import math
import unicodedata
from collections.abc import Callable
from pathlib import Path


class WrongText(ValueError):
    """A text that a type does not take; the message states why."""


def number(text: str) -> float:
    """A finite number."""
    try:
        value = float(text)
    except ValueError:
        raise WrongText(f"'{text}' is not a number") from None
    if not math.isfinite(value):
        raise WrongText(f"'{text}' is not a finite number")
    return value


def positive(text: str) -> float:
    """A number above 0."""
    value = number(text)
    if value <= 0:
        raise WrongText(f"{text} is not above 0")
    return value


def between(low: float, high: float) -> Callable[[str], float]:
    """A number in [low, high]."""

    def value_of(text: str) -> float:
        value = number(text)
        if not low <= value <= high:
            raise WrongText(f"{text} does not lie between {low:g} and {high:g}")
        return value

    return value_of


def at_least(low: int) -> Callable[[str], int]:
    """A whole number from low on."""

    def value_of(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise WrongText(f"'{text}' is not a whole number") from None
        if value < low:
            raise WrongText(f"{text} is below {low}")
        return value

    return value_of


def series(usual: int) -> Callable[[str], tuple[float, ...]]:
    """Numbers of FIRST:LAST:COUNT, of FIRST:LAST, which are so many, or of NUMBER,NUMBER,..."""

    def values_of(text: str) -> tuple[float, ...]:
        ends = text.split(":")
        if len(ends) == 1:
            return tuple(map(number, text.split(",")))
        if len(ends) > 3:
            raise WrongText(f"'{text}' is not FIRST:LAST:COUNT, e.g. 100:250:4")
        first, last = map(number, ends[:2])
        count = at_least(2)(ends[2]) if len(ends) == 3 else usual
        return tuple(first + k * (last - first) / (count - 1) for k in range(count))

    return values_of


def fraction(text: str) -> float:
    """0.1 of "10%" or "0.1", between 0 and 1."""
    value = number(text[:-1]) / 100 if text.endswith("%") else number(text)
    if not 0 < value < 1:
        raise WrongText(f"'{text}' does not lie between 0 and 100 %")
    return value


def assignment(text: str) -> tuple[str, float]:
    """("load", 600.0) of "load=600"."""
    name, equals, value = text.partition("=")
    if not name.strip() or not equals:
        raise WrongText(f"'{text}' is not NAME=NUMBER, e.g. load=600")
    return name.strip(), number(value)


INFLATION = (10.0, 2000.0)  # [kPa] the lowest of tyres for soft ground is 20, 2000 is that of tyre files


def inflation(text: str) -> float:
    """A pressure of tyres [kPa]."""
    pressure, (low, high) = number(text), INFLATION
    if not low <= pressure <= high:
        raise WrongText(
            f"{text} kPa is no pressure of a tyre, which is {low:g} to {high:g} kPa; give kPa: bar times 100, "
            "psi times 6.895, Pa over 1000"
        )
    return pressure


UNITS_OF_TIME = {"min": 60.0, "h": 3600.0, "s": 1.0}


def seconds(text: str) -> float:
    """7200 of "2h", "120min", "7200s" or "7200"."""
    for unit, length in UNITS_OF_TIME.items():
        if text.endswith(unit):
            return length * positive(text.removesuffix(unit).strip())
    return positive(text)


def is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def words(text: str) -> str:
    """A text that is not empty."""
    if not text.strip():
        raise WrongText("is empty")
    return text


def path(text: str) -> Path:
    """A path that is not empty."""
    return Path(words(text))


def has_control_characters(text: str) -> bool:
    """Line breaks included: no name of a file or value needs them."""
    return any(unicodedata.category(letter) in ("Cc", "Zl", "Zp") for letter in text)
