# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post choose: the options of the run for a wanted error on stdout, the reasons on stderr.

A word a line; of two runs that are to be extrapolated an empty line stands between them.
"""

import argparse
import sys

from ..arguments import fraction, path
from ..scene.choice import choose, outcome


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("table", type=path)
    parser.add_argument("--error", type=fraction, required=True)
    parser.add_argument(
        "--held", type=path, nargs="+", help="results folders of what was chosen, the coarse first"
    )


def run(arguments: argparse.Namespace) -> None:
    if arguments.held:
        print("\n".join(outcome(arguments.table, arguments.error, arguments.held)))
        return
    chosen = choose(arguments.table, arguments.error)
    print("\n".join(chosen.reasons), file=sys.stderr)
    print("\n\n".join("\n".join(words) for words in chosen.runs))
