# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post sidewall: the figure of a results folder of furrow-sidewall, which calls this."""

import argparse
from pathlib import Path

from ..figures.sidewall import draw_sidewall


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=Path, help="results folder of furrow-sidewall")


def run(arguments: argparse.Namespace) -> None:
    print(f"  figure        {draw_sidewall(arguments.results)}")
