# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post figure: figures of the programs furrow-point, furrow-sidewall and
furrow-tyre --modes, which call this."""

import importlib
from pathlib import Path

from ..arguments import path
from .parameters import Given, argument, command


@command(
    argument("name", "point, sidewall or modes", choices=("point", "sidewall", "modes")),
    argument("results", "results folder of the program", path),
)
def figure(given: Given) -> None:
    name: str = given.name
    figures = importlib.import_module(f"..figures.{name}_figure", __package__)
    drawn: Path | list[Path] = getattr(figures, f"draw_{name}")(given.results)
    for file in [drawn] if isinstance(drawn, Path) else drawn:
        print(f"  figure        {file}")
