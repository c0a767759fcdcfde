# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post choose, for inputs/run --error: the choice's options on stdout, why on stderr.

A word a line; of two runs that are to be extrapolated an empty line stands between them.
"""

import argparse
import shlex
import sys

from ..analyse import choice, cost, cost_table, measured_choice
from ..analyse.extrapolation import Pair
from ..arguments import fraction, path
from ..csv_table import read_comments
from ..errors import ResultsError
from ..read.wheel_run import read_wheel_run


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("table", type=path)
    parser.add_argument("--error", type=fraction, required=True)
    parser.add_argument(
        "--held", type=path, nargs="+", help="results folders of what was chosen, the coarse first"
    )


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
    chosen, within, pair = choice.choose(assessed, arguments.error)
    if arguments.held:
        print("\n".join(_held(chosen, pair, arguments)))
        return
    if pair:
        reasons = choice.reasons_of_pair(pair, chosen, within, arguments.error)
    else:
        reasons = choice.reasons(chosen, within, assessed, arguments.error)
    print("\n".join(reasons), file=sys.stderr)
    runs = pair.runs if pair else (chosen,)
    print("\n\n".join("\n".join(shlex.split(run.row.options)) for run in runs))


def _held(chosen: cost.Assessed, pair: Pair | None, arguments: argparse.Namespace) -> list[str]:
    wanted = 2 if pair else 1
    if len(arguments.held) != wanted:
        raise ResultsError(
            f"--held has {len(arguments.held)} results folders; for this error the table's choice "
            f"is {wanted}"
        )
    runs = [read_wheel_run(folder) for folder in arguments.held]
    if pair:
        return choice.pair_held(pair, arguments.error, *runs)
    return choice.held(chosen, arguments.error, *runs)
