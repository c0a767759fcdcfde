# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post point, sidewall and modes: figures of the programs furrow-point, furrow-sidewall and
furrow-tyre --modes, which call this."""

import argparse
import importlib
from pathlib import Path

from ..arguments import path


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=path, help="results folder of the program")


def run(arguments: argparse.Namespace) -> None:
    name: str = arguments.command
    figures = importlib.import_module(f"..figures.{name}", __package__)
    drawn: Path | list[Path] = getattr(figures, f"draw_{name}")(arguments.results)
    for figure in [drawn] if isinstance(drawn, Path) else drawn:
        print(f"  figure        {figure}")
