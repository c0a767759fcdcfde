# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post terrain: density sections, tracers and densities of continuum terrain."""

import argparse
from pathlib import Path

from ..errors import ResultsError
from ..figures.terrain import draw_terrain
from ..read.results import Results
from ..read.summary import Summary
from .output import add_output, add_results, target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_results(parser)
    add_output(parser)


def run(arguments: argparse.Namespace) -> None:
    given = Path(arguments.results)
    if not given.exists():
        raise ResultsError(f"{given}: no such file; name the results folder of a run")
    folder = given if given.is_dir() else given.parent
    has_history = (folder / "history.h5").is_file()
    title = Results(folder).title if has_history else folder.resolve().name
    file = target(arguments, folder, "terrain")
    print(draw_terrain(folder, title, Summary(folder).line(), file).report())
    print(file)
