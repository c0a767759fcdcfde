# SPDX-License-Identifier: GPL-2.0-or-later
"""Paths of a law and the curves of a fit, by one furrow-point that stays open."""

import json
import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..arrays import Floats
from ..programs import find_program
from ..run.case import point_text
from ..run.tools import Conversation
from .fitter import NotComputed, Parameter

PROGRAM = "furrow-point"


@dataclass(frozen=True)
class Curve:
    """A measured curve; measured is NaN where there is none."""

    name: str
    path: str  # its type
    driven_by: str  # name with unit, as `compared`
    driven: Floats
    channel: str
    compared: str
    measured: Floats
    relative: bool  # compare logarithms
    deviation: float  # of a value, of its logarithm where relative; 0: unknown, the same for all


class _OpenPoint(Conversation):
    """furrow-point with a line of answer for each line of input."""

    def __init__(self, *words: str | Path, program: Path | None = None) -> None:
        super().__init__(program or find_program(PROGRAM), *words)

    def answer(self, question: str) -> str:
        """@raises NotComputed with the message of furrow-point; ResultsError where it ended"""
        answer = self.ask(question)
        if answer.startswith("error: "):
            raise NotComputed(answer.removeprefix("error: ").rstrip())
        return answer


class PointPaths(_OpenPoint):
    """Paths of materials; one program computes all of them."""

    def __init__(self, program: Path | None = None) -> None:
        super().__init__("channels", program=program)

    def __call__(self, material: Path, path: str) -> dict[str, Floats]:
        """Columns of point.csv; path: its YAML mapping, "{type: ..., ...}".

        @raises NotComputed with the message of furrow-point where the law finds no state on the path
        """
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "path.yaml"
            file.write_text(point_text("path", material.resolve(), path), encoding="utf-8")
            try:
                channels = json.loads(self.answer(str(file)))
            except NotComputed as error:
                raise NotComputed(f"{material}: {error}") from error
        return {name: np.array(values, dtype=np.float64) for name, values in channels.items()}


class PointCurves(_OpenPoint):
    """A fit's title, material, parameters and measured curves; call it with values for its curves."""

    def __init__(self, file: Path) -> None:
        """@raises ResultsError with what furrow-point refuses in the file"""
        super().__init__("curves", file)
        try:
            head = json.loads(self.line())
        except BaseException:
            self.close()
            raise
        self.title: str = head["title"]
        self.material: str = head["material"]
        self.law: str = head["law"]
        self.warnings: list[str] = head["warnings"]
        self.parameters = tuple(map(_parameter, head["parameters"]))
        self.curves = tuple(map(_curve, head["curves"]))

    def __call__(self, values: Floats) -> Sequence[Floats]:
        """Each curve at its points. @raises NotComputed, ResultsError"""
        whole = np.array(self.answer(_words(values)).split(), dtype=np.float64)
        return np.split(whole, np.cumsum([len(curve.driven) for curve in self.curves])[:-1])

    def material_file(self, values: Floats) -> str:
        """The text of a material file with these values. @raises NotComputed, ResultsError"""
        text: str = json.loads(self.answer(f"material {_words(values)}"))
        return text


def _words(values: Floats) -> str:
    return " ".join(repr(float(value)) for value in values)


def _parameter(head: dict[str, Any]) -> Parameter:
    ends = (sign * math.inf if head[end] is None else head[end] for sign, end in ((-1, "lower"), (1, "upper")))
    return Parameter(head["name"], head["unit"], head["start"], *ends)


def _curve(head: dict[str, Any]) -> Curve:
    columns = {name: np.array(head[name], dtype=np.float64) for name in ("driven", "measured")}  # null becomes NaN
    return Curve(**{**head, **columns})
