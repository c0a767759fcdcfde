# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post laboratory: evaluates tests of inputs/laboratory."""

import argparse

from ..arguments import path, words
from ..figures.laboratory import draw_laboratory
from ..laboratory.report import report_tests
from .output import add_output, target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "folders",
        nargs="+",
        type=words,
        metavar="results",
        help="results folders of one test of inputs/laboratory",
    )
    parser.add_argument(
        "--reference",
        type=path,
        help="reference.csv of an oedometer, with columns rho_kgm3 and sigma1_Pa",
    )
    parser.add_argument(
        "--point",
        type=words,
        action="append",
        default=[],
        help="results folder of furrow-point with the same path, to lay beside",
    )
    add_output(parser, "figure to write (default: in the first folder)")


def run(arguments: argparse.Namespace) -> None:
    found = report_tests(arguments.folders, arguments.reference, arguments.point)
    print(found.report)
    file = target(arguments, found.tests[0].folder, "laboratory")
    draw_laboratory(found, file)
    print(file)
