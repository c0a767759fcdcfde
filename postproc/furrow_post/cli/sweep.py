# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post sweep: the curves of sweeps, or of folders with several runs, in one figure."""

import argparse
from pathlib import Path

from ..arguments import words
from ..sweep.output import Named, Wanted, evaluate, report_lines, write_sweep
from .comparison import add_folders, add_references, folders, labelled
from .output import add_target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_folders(parser, "folder of a sweep or of runs")
    parser.add_argument(
        "--against",
        type=words,
        help="what lies on the x axis (default: the first variable of the sweep, or the one "
        "condition that differs)",
    )
    add_references(parser)
    parser.add_argument(
        "--measured",
        action="append",
        default=[],
        type=labelled,
        help="CSV with columns named as in sweep.csv, or LABEL=FILE; may be repeated",
    )
    add_target(parser, "folder to write (default: the first one)")


def run(arguments: argparse.Namespace) -> None:
    given = folders(arguments)
    wanted = Wanted(
        arguments.against,
        arguments.errors,
        arguments.formula,
        [Named(Path(file), label) for file, label in arguments.measured],
        arguments.extrapolate,
    )
    result = evaluate([Named(Path(folder), label) for folder, label in given], wanted)
    target: Path = arguments.output or Path(given[0].folder)
    files = write_sweep(result, target)
    print("\n".join(report_lines(result)))
    print(f"\n{target}: {', '.join(files)}")
