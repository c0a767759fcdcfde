# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post modes: the figures of a results folder of furrow-tyre --modes, which calls this."""

import argparse

from ..arguments import path
from ..figures.modes import draw_modes


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=path, help="folder of furrow-tyre --modes")


def run(arguments: argparse.Namespace) -> None:
    for figure in draw_modes(arguments.results):
        print(f"  figure        {figure}")
