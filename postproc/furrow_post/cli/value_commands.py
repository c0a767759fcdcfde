# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands that give the values of a run: resistance, budget, export."""

import csv
import json
import os
from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path

from ..uncertainty.whole_error import as_json, report, write_budget
from ..errors import ResultsError
from ..formatting import in_unit
from ..programs import find_program
from ..read.results import Results, require_different
from .comparing import folders, folders_argument
from .parameters import Given, argument, command, flag, option, require_file, results_argument, target_option

TIME, RUN = "time", "run"  # the channel and the column that come first


@command(
    argument("words", "arguments of furrow-resistance", str, nargs=-1),
    add_help_option=False,
    context_settings={"ignore_unknown_options": True},
)
def resistance(given: Given) -> None:
    """Does not return. @raises ResultsError without the program, or for a folder that is given twice"""
    require_different([word for word in given.words if Path(word).is_dir()])
    program = str(find_program("furrow-resistance"))
    os.execv(program, [program, *given.words])


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


@command(
    folders_argument("results folder or history.h5"),
    option("--channels", metavar="NAME,NAME,...", help="of the history, e.g. hub_drop,force_x (default: all); time always comes first"),
    target_option("file to write (default: history.csv in the first folder)"),
)
def export(given: Given) -> None:
    named = folders(given)
    runs = [Results(folder) for folder, _ in named]
    target: Path = given.output or runs[0].folder / "history.csv"
    require_file(target, "csv")
    labels = [label or one.folder.resolve().name for (_, label), one in zip(named, runs)]
    twice = [label for label in labels if labels.count(label) > 1]
    if twice:
        raise ResultsError(f"two runs are called '{twice[0]}'; write LABEL=FOLDER")
    names = _names(runs, given.channels)
    units = {name: one.units[name] for one in reversed(runs) for name in one.units}
    with open(target, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        several = len(runs) > 1
        writer.writerow([*([RUN] if several else []), *(n + in_unit(units[n].strip()) for n in names)])
        for label, one in zip(labels, runs):
            absent = [""] * len(one.columns[TIME])
            columns = [one.columns[name].tolist() if name in one.columns else absent for name in names]
            writer.writerows(([label] if several else []) + list(row) for row in zip(*columns))
    rows = sum(len(one.columns[TIME]) for one in runs)
    print(f"{target} ({rows} rows, {len(names)} channels)")


def _names(runs: Sequence[Results], asked: str | None) -> list[str]:
    """Names of the channels to write. @raises ResultsError for one that no run has"""
    known = list(dict.fromkeys(name for one in runs for name in one.columns))
    found = known if asked is None else [name.strip() for name in asked.split(",")]
    for name in found:
        if name not in known:
            near = get_close_matches(name, known, 1)
            hint = f"did you mean '{near[0]}'?" if near else "leave out --channels to write all of them"
            raise ResultsError(f"--channels: no run has the channel '{name}'; allowed: {', '.join(known)}; {hint}")
    return list(dict.fromkeys([TIME, *found]))
