# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post resistance: becomes the program furrow-resistance."""

import argparse
import os
from pathlib import Path

from ..programs import find_program
from ..read.results import require_different


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="of furrow-resistance")


def run(arguments: argparse.Namespace) -> None:
    """Does not return. @raises ResultsError without the program, or for a folder that is given twice"""
    given: list[str] = arguments.arguments
    words = given[1:] if given[:1] == ["--"] else given
    require_different([word for word in words if Path(word).is_dir()])
    program = str(find_program("furrow-resistance"))
    os.execv(program, [program, *words])
