# SPDX-License-Identifier: GPL-2.0-or-later
"""The styles of a run with their effective values, as the writer put them into /run/styles.

The dataset is JSON, an array in the order of the script: {"id", "group", "style", "kind",
"options"}; the page coupling/output/fix_wheel_history.md has the kinds. Options are lists of
numbers, booleans or texts, with defaults filled in.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..errors import ResultsError
from ..json_text import parse_json

Option = float | int | bool | str


@dataclass(frozen=True)
class Style:
    """One fix or command of the script."""

    id: str
    style: str  # e.g. "terrain/continuum"
    kind: str  # e.g. "terrain": what it is, whatever its style
    options: dict[str, list[Option]]  # keyword -> its values, SI units and degrees

    def has(self, keyword: str) -> bool:
        return keyword in self.options

    def values(self, keyword: str) -> list[Option]:
        """All values of a keyword. @raises ResultsError where the style has none"""
        if keyword not in self.options:
            raise ResultsError(
                f"{self.style} '{self.id}': the results have no value of '{keyword}'"
            )
        return self.options[keyword]

    def number(self, keyword: str, default: float | None = None) -> float:
        """The only value of a keyword. @raises ResultsError for a text, or without a default"""
        if default is not None and keyword not in self.options:
            return default
        value = self.values(keyword)[0]
        if isinstance(value, str):
            raise ResultsError(f"{self.style} '{self.id}': '{keyword}' is '{value}', not a number")
        return float(value)

    def text(self, keyword: str) -> str:
        return str(self.values(keyword)[0])

    def flag(self, keyword: str) -> bool:
        """Value of a yes/no keyword; no where it is not there."""
        return self.options.get(keyword, [False])[0] is True


def _style_of(entry: dict[str, Any]) -> Style:
    """@raises KeyError, TypeError, ValueError where the entry is no style"""
    identity, style, kind = names = [entry[key] for key in ("id", "style", "kind")]
    options = dict(entry["options"])
    for keyword, values in options.items():
        if not isinstance(values, list) or not values:
            raise ValueError(f"'{keyword}' of {style} has no values")
    if not all(isinstance(name, str) for name in names):
        raise TypeError(f"{names} are no texts")
    return Style(identity, style, kind, options)


class Styles:
    """The styles of a run in the order of its script."""

    def __init__(self, styles: Sequence[Style]) -> None:
        self._styles = tuple(styles)

    @classmethod
    def from_json(cls, text: str) -> "Styles":
        """@raises ValueError, KeyError, TypeError where the text is not such an array"""
        return cls([_style_of(entry) for entry in parse_json(text)])

    def of_kind(self, kind: str) -> Style | None:
        """The first of a kind, or None."""
        return next((style for style in self._styles if style.kind == kind), None)

    def of_style(self, name: str) -> Style | None:
        """The first of a style, or None."""
        return next((style for style in self._styles if style.style == name), None)
