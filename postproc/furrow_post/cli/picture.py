# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post picture: the rut in grains or continuum."""

import argparse

from ..figures.picture import draw_picture
from ..figures.terrain import draw_terrain
from ..read.results import Results
from ..run.summary import Summary
from ..read.terrain import terrain_file
from .output import add_output, add_pixels, add_results, target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_results(parser)
    add_output(parser)
    add_pixels(parser)


def run(arguments: argparse.Namespace) -> None:
    results = Results(arguments.results)
    folder = results.folder
    file = target(arguments, folder, "rut")
    numbers = Summary(folder).line()
    if results.has_grains or not terrain_file(folder).is_file():
        draw_picture(results, numbers, file, arguments.pixels)
    else:
        draw_terrain(folder, results.title, numbers, file, arguments.pixels)
    print(file)
