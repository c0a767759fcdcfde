# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post sidewall: the figure of a results folder of furrow-sidewall, which calls this."""

import argparse

from ..arguments import path
from ..figures.sidewall import draw_sidewall


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=path, help="results folder of furrow-sidewall")


def run(arguments: argparse.Namespace) -> None:
    print(f"  figure        {draw_sidewall(arguments.results)}")
