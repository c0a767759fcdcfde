# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post plot: histories of a run."""

import argparse

from ..figures.histories import draw_histories
from ..read.results import Results
from .output import add_output, add_results, target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_results(parser)
    parser.add_argument(
        "--against",
        choices=("time", "x"),
        default="time",
        help="the abscissa: time, or x of the axle along the travel",
    )
    add_output(parser)


def run(arguments: argparse.Namespace) -> None:
    results = Results(arguments.results)
    file = target(arguments, results.folder, "histories")
    draw_histories(results, file, arguments.against)
    print(file)
