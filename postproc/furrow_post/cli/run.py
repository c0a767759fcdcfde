# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post run: runs a scene and shows what came out."""

import argparse

from ..scene.command import main


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("arguments", nargs=argparse.REMAINDER, help="see 'furrow-post run -- --help'")


def run(arguments: argparse.Namespace) -> int:
    given: list[str] = arguments.arguments
    return main(given[1:] if given[:1] == ["--"] else given)
