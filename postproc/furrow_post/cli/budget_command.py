# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post budget: the whole error of each value of a run, with its parts and the nearest tests."""

import json
from pathlib import Path

from ..uncertainty.whole_error import as_json, report, write_budget
from .parameters import Given, command, flag, results_argument


@command(
    results_argument(),
    flag("--json", "as_json", help="all values with their parts and sources, in SI units; null: unknown"),
    flag("--write", help="writes budget.json into the folder too, as 'furrow-post run' does"),
)
def budget(given: Given) -> None:
    folder = Path(given.results)
    folder = folder if folder.is_dir() else folder.parent
    if given.write:
        write_budget(folder)
    print(json.dumps(as_json(folder), indent=1) if given.as_json else report(folder))
