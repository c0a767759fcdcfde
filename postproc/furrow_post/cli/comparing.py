# SPDX-License-Identifier: GPL-2.0-or-later
"""Results folders with labels, as commands on several runs take them."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..arguments import WrongText, words
from ..read.results import require_different
from .parameters import Decorator, Given, argument


class Labelled(NamedTuple):
    """A results folder, and its name in tables."""

    folder: str
    label: str | None


def labelled(text: str) -> Labelled:
    """Label and folder of FOLDER or LABEL=FOLDER; a folder that is there may have "=" in its name."""
    if "=" in text and Path(text).exists():
        return Labelled(text, None)
    head, equals, tail = text.partition("=")
    if equals and not (head.strip() and tail.strip()):
        missing = "folder" if head.strip() else "label"
        raise WrongText(f"'{text}' has no {missing}; write LABEL=FOLDER, or FOLDER")
    return Labelled(tail, head) if equals else Labelled(words(head), None)


def folders_argument(text: str = "results folder", count: int = -1) -> Decorator[Any]:
    return argument("results", f"{text}, or LABEL=FOLDER", labelled, nargs=count, required=True)


def folders(given: Given) -> Sequence[Labelled]:
    """@raises ResultsError where one is given twice"""
    named: Sequence[Labelled] = given.results
    require_different([folder for folder, _ in named])
    return named


def beside_first(given: Given, name: str) -> Path:
    """The folder to write: as asked for, or of this name next to the first one that is given."""
    asked: Path | None = given.output
    return asked or Path(given.results[0].folder).resolve().parent / name
