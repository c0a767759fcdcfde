# SPDX-License-Identifier: GPL-2.0-or-later
"""Arguments that several subcommands share: what to look at, what to write."""

import argparse
from pathlib import Path

from ..arguments import assignment, at_least, path, words
from ..errors import ResultsError

FORMATS = ("png", "svg", "pdf")


def add_results(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=words, help="results folder of a run, or its history.h5")


def add_output(
    parser: argparse.ArgumentParser, text: str = "file to write (default: in the results folder)"
) -> None:
    parser.add_argument("-o", "--output", type=path, help=text)
    parser.add_argument("--format", choices=FORMATS, help="default: that of --output, or png")


def add_target(parser: argparse.ArgumentParser, text: str, required: bool = False) -> None:
    """The option -o of commands that write other files than figures, or several."""
    parser.add_argument("-o", "--output", type=path, required=required, help=text)


def add_assignments(
    parser: argparse.ArgumentParser, option: str, text: str, default: list[object] | None = None
) -> None:
    parser.add_argument(
        option, nargs="+", type=assignment, metavar="NAME=NUMBER", default=default, help=text
    )


def add_pixels(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--pixels", type=at_least(100), default=1000, help="width of the view from behind (default: %(default)s)"
    )


def target(arguments: argparse.Namespace, folder: Path, name: str) -> Path:
    """The file to write: as asked for, or of this name in a folder. @raises ResultsError"""
    asked: Path | None = arguments.output
    wanted: str | None = arguments.format
    if asked is None:
        return folder / f"{name}.{wanted or FORMATS[0]}"
    require_picture(asked)
    if wanted and asked.suffix != f".{wanted}":
        raise ResultsError(f"-o {asked}: is no {wanted}; leave out --format, or change the name")
    return asked


def require_picture(file: Path) -> None:
    """@raises ResultsError for a name that no figure can have"""
    if file.is_dir():
        raise ResultsError(f"-o {file}: is a folder; name a file in it")
    if file.suffix[1:] not in FORMATS:
        raise ResultsError(f"-o {file}: its name ends in none of .{', .'.join(FORMATS)}")
    if not file.parent.is_dir():
        raise ResultsError(f"-o {file}: there is no folder {file.parent}; make it first")


def prepare_page(file: Path, what: str) -> None:
    """Makes the folder of an HTML page. what: whose name it is, e.g. "a report".

    @raises ResultsError for a name that no page can have; OSError
    """
    if file.suffix != ".html":
        raise ResultsError(f"{file}: {what}'s name ends in .html")
    if file.is_dir():
        raise ResultsError(f"-o {file}: is a folder; name a file in it")
    file.parent.mkdir(parents=True, exist_ok=True)
