# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post choose: the options of the run for a wanted error on stdout, the reasons on stderr.

A word a line; of two runs that are to be extrapolated an empty line stands between them.
"""

import sys

from ..arguments import fraction, path
from ..scene.scene_choice import choose, outcome
from .parameters import Given, argument, command, option, repeated


@command(
    argument("table", "table of runs (inputs/costs/*.csv)", path),
    option("--error", parse=fraction, required=True, help="wanted relative error, e.g. 10%"),
    repeated("--held", parse=path, help="results folders of what was chosen, the coarse first"),
)
def choose_(given: Given) -> None:
    if given.held:
        print("\n".join(outcome(given.table, given.error, given.held)))
        return
    chosen = choose(given.table, given.error)
    print("\n".join(chosen.reasons), file=sys.stderr)
    print("\n\n".join("\n".join(words) for words in chosen.runs))
