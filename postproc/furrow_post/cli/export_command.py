# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post export: histories of runs as CSV, for spreadsheets and MATLAB."""

import csv
from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path

from ..errors import ResultsError
from ..formatting import in_unit
from ..read.results import Results
from .comparing import folders, folders_argument
from .parameters import Given, command, option, target_option

TIME, RUN = "time", "run"  # the channel and the column that come first


@command(
    folders_argument("results folder or history.h5"),
    option("--channels", metavar="NAME,NAME,...", help="of the history, e.g. hub_drop,force_x (default: all); time always comes first"),
    target_option("file to write (default: history.csv in the first folder)"),
)
def export(given: Given) -> None:
    named = folders(given)
    runs = [Results(folder) for folder, _ in named]
    target: Path = given.output or runs[0].folder / "history.csv"
    if target.suffix != ".csv" or target.is_dir() or not target.parent.is_dir():
        raise ResultsError(f"-o {target}: name a file that ends in .csv, in a folder that is there")
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
    if asked is None:
        found = [name for one in runs for name in one.columns]
    else:
        found = [name.strip() for name in asked.split(",")]
        for name in found:
            if not any(name in one.columns for one in runs):
                known = list(dict.fromkeys(key for one in runs for key in one.columns))
                near = get_close_matches(name, known, 1)
                hint = f"did you mean '{near[0]}'?" if near else "leave out --channels to write all of them"
                raise ResultsError(f"--channels: no run has the channel '{name}'; allowed: {', '.join(known)}; {hint}")
    return list(dict.fromkeys([TIME, *found]))
