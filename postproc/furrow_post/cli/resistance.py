# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post resistance: becomes the program furrow-resistance."""

import argparse
import os
import shutil
import sys
from pathlib import Path

from ..errors import ResultsError

PROGRAM = "furrow-resistance"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="of furrow-resistance")


def run(arguments: argparse.Namespace) -> None:
    """Does not return. @raises ResultsError where there is no such program"""
    program = find_program()
    given: list[str] = arguments.arguments
    os.execv(program, [program, *(given[1:] if given[:1] == ["--"] else given)])


def find_program() -> str:
    """Beside furrow-post, in the build folder of the source tree, or on the PATH."""
    command = Path(sys.argv[0])
    tree = command.resolve().parent.parent
    build = Path(os.environ.get("FURROW_BUILD", tree / "build"))
    for folder in (command.absolute().parent, command.resolve().parent, build / "bin"):
        if (folder / PROGRAM).is_file():
            return str(folder / PROGRAM)
    found = shutil.which(PROGRAM)
    if not found:
        raise ResultsError(
            f"{PROGRAM} is not built or not installed; run 'bash inputs/run' once, or put it on "
            "the PATH"
        )
    return found
