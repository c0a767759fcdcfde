# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post point: the figure of a results folder of furrow-point, which calls this."""

import argparse

from ..arguments import path
from ..figures.point import draw_point


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=path, help="results folder of furrow-point")


def run(arguments: argparse.Namespace) -> None:
    print(f"  figure        {draw_point(arguments.results)}")
