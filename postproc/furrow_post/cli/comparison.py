# SPDX-License-Identifier: GPL-2.0-or-later
"""Arguments of the subcommands that compare runs, and the comparison that they ask for."""

import argparse
from pathlib import Path
from typing import NamedTuple

from ..analyse import cost_table
from ..analyse.comparison import Comparison, compare
from ..analyse.formulas import predictions_for
from ..arguments import path, words
from ..read.results import require_different
from ..read.wheel_run import read_wheel_run


class Labelled(NamedTuple):
    """A results folder, and its name in tables."""

    folder: str
    label: str | None


def labelled(text: str) -> Labelled:
    """Of FOLDER or LABEL=FOLDER; a folder that is there may have "=" in its name."""
    if "=" in text and Path(text).exists():
        return Labelled(text, None)
    head, equals, tail = text.partition("=")
    if equals and not (head.strip() and tail.strip()):
        missing = "folder" if head.strip() else "label"
        raise argparse.ArgumentTypeError(f"'{text}' has no {missing}; write LABEL=FOLDER, or FOLDER")
    return Labelled(tail, head) if equals else Labelled(words(head), None)


def add_folders(
    parser: argparse.ArgumentParser, text: str = "results folder", count: str | int = "+"
) -> None:
    parser.add_argument("results", nargs=count, type=labelled, help=f"{text}, or LABEL=FOLDER")


def folders(arguments: argparse.Namespace) -> list[Labelled]:
    """@raises ResultsError where one is given twice"""
    given: list[Labelled] = arguments.results
    require_different([folder for folder, _ in given])
    return given


def beside_first(arguments: argparse.Namespace, name: str) -> Path:
    """The folder to write: as asked for, or of this name next to the first one that is given."""
    asked: Path | None = arguments.output
    return asked or Path(arguments.results[0].folder).resolve().parent / name


def add_comparison_arguments(parser: argparse.ArgumentParser) -> None:
    add_folders(parser)
    add_references(parser)
    columns = "depth_m, sinkage_m, resistance, density_kgm3"
    parser.add_argument("--measured", type=path, help=f"reference.csv with {columns}")
    parser.add_argument(
        "--anyway", action="store_true", help="compare runs whose conditions differ"
    )


def add_references(parser: argparse.ArgumentParser) -> None:
    """What runs are laid beside: errors of other sizes, formulas."""
    table = "table of runs of the scene (inputs/costs): errors of size, domain, packing"
    formula = "nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN; may be repeated"
    outside = "formulas outside of their range too"
    parser.add_argument("--errors", type=path, help=table)
    parser.add_argument("--formula", action="append", default=[], help=formula)
    parser.add_argument("--extrapolate", action="store_true", help=outside)


def compared(arguments: argparse.Namespace) -> Comparison:
    """@raises ResultsError with every reason why the runs are not comparable"""
    runs = [read_wheel_run(folder, label) for folder, label in folders(arguments)]
    table = cost_table.read_table(arguments.errors)[0] if arguments.errors else None
    formulas = predictions_for(runs[0], arguments.formula, arguments.extrapolate)
    return compare(runs, table, formulas, arguments.measured, arguments.anyway)
