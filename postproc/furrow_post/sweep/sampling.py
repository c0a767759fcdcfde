# SPDX-License-Identifier: GPL-2.0-or-later
"""Points of a sweep that fill the box of its variables evenly."""

from collections.abc import Sequence

from scipy.stats import qmc

from ..errors import ResultsError
from .sweep_values import MOST_POINTS, number_of, require_once

HOW_SAMPLED = "with --samples write NAME=FIRST:LAST"


def sampled(texts: Sequence[str], count: int) -> list[dict[str, str]]:
    """Name -> value of points that fill the box of NAME=FIRST:LAST,... evenly (Halton's sequence).

    A larger count keeps the points of a smaller one. @raises ResultsError
    """
    if count > MOST_POINTS:
        raise ResultsError(f"--samples {count}: at most {MOST_POINTS}")
    names, boxes = [], []
    for text in texts:
        name, _, values = (part.strip() for part in text.partition("="))
        ends = [end for end in map(number_of, values.split(":")) if end is not None]
        if not name or len(ends) != 2 or values.count(":") != 1 or ends[0] == ends[1]:
            raise ResultsError(f"--sweep '{text}' is no range of two numbers; {HOW_SAMPLED}")
        names.append(name)
        boxes.append((min(ends), max(ends)))
    require_once(names)
    unit = qmc.Halton(len(names), seed=0).random(count)
    return [
        {name: f"{low + u * (high - low):.5g}" for name, (low, high), u in zip(names, boxes, row)}
        for row in unit
    ]
