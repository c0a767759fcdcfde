# SPDX-License-Identifier: GPL-2.0-or-later
"""Arguments that several subcommands share: what to look at, what to write."""

import argparse
from pathlib import Path

from ..arguments import path, words

FORMATS = ("png", "svg", "pdf")


def add_results(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=words, help="results folder of a run, or its history.h5")


def add_output(
    parser: argparse.ArgumentParser, text: str = "file to write (default: in the results folder)"
) -> None:
    parser.add_argument("-o", "--output", type=path, help=text)
    parser.add_argument("--format", choices=FORMATS, default=FORMATS[0], help="default: png")


def target(arguments: argparse.Namespace, folder: Path, name: str) -> Path:
    """The file to write: as asked for, or of this name in a folder."""
    asked: Path | None = arguments.output
    return asked or folder / f"{name}.{arguments.format}"
