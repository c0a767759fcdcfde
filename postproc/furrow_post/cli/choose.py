# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post choose, for inputs/run --error: the choice's options on stdout, why on stderr."""

import argparse
import shlex
import sys

from ..analyse import choice, cost, cost_table, measured_choice
from ..arguments import fraction, path
from ..csv_table import read_comments
from ..errors import ResultsError
from ..read.wheel_run import read_wheel_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("table", type=path)
    parser.add_argument("--error", type=fraction, required=True)
    parser.add_argument("--held", type=path, help="results folder of the run that was chosen")


def run(arguments: argparse.Namespace) -> None:
    try:
        measured = measured_choice.measurement(read_comments(arguments.table))
    except OSError:
        measured = ""  # the reader of the table says what is wrong
    if measured:
        _run_measured(arguments, measured)
    else:
        _run_numerical(arguments)


def _run_measured(arguments: argparse.Namespace, measured: str) -> None:
    runs = measured_choice.read_compared(arguments.table)
    chosen = measured_choice.recommend(runs, arguments.error)
    if arguments.held:
        print(
            f"Estimate: {chosen.describe()}. Errors and time are of the states that were measured "
            f"({measured}); this run is another one and is not judged."
        )
        return
    print("\n".join(measured_choice.reasons(runs, arguments.error, measured)), file=sys.stderr)
    print("\n".join(shlex.split(chosen.options)))  # one word per line


def _run_numerical(arguments: argparse.Namespace) -> None:
    rows, comments = cost_table.read_table(arguments.table)
    runnable = {row.run for row in rows if row.options}
    all_assessed = cost.assess(rows, cost_table.wanted_wheel(comments))
    assessed = [a for a in all_assessed if a.row.run in runnable]
    if not assessed:
        raise ResultsError(f"{arguments.table}: no row says how to run it (column options)")
    chosen, within = cost.recommend(assessed, arguments.error)
    if arguments.held:
        print("\n".join(choice.held(chosen, arguments.error, read_wheel_run(arguments.held))))
        return
    reasons = choice.reasons(chosen, within, assessed, arguments.error)
    print("\n".join(reasons), file=sys.stderr)
    print("\n".join(shlex.split(chosen.row.options)))  # one word per line
