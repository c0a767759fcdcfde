# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post resistance: becomes the program furrow-resistance."""

import argparse
import os

from ..programs import find_program


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="of furrow-resistance")


def run(arguments: argparse.Namespace) -> None:
    """Does not return. @raises ResultsError where there is no such program"""
    program = str(find_program("furrow-resistance"))
    given: list[str] = arguments.arguments
    os.execv(program, [program, *(given[1:] if given[:1] == ["--"] else given)])
