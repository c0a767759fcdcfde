# SPDX-License-Identifier: GPL-2.0-or-later
"""Parameters of commands that compare runs, and the comparison that they ask for."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..uncertainty import cost_table
from ..analyse.comparison import Comparison, compare
from ..laws.empirical import predictions_for
from ..arguments import WrongText, path, words
from ..read.results import require_different
from ..read.wheel_run import read_wheel_run
from .parameters import Decorator, Given, argument, flag, option


class Labelled(NamedTuple):
    """A results folder, and its name in tables."""

    folder: str
    label: str | None


def labelled(text: str) -> Labelled:
    """Label and folder of FOLDER or LABEL=FOLDER; a folder that is there may have "=" in its name."""
    if "=" in text and Path(text).exists():
        return Labelled(text, None)
    head, equals, tail = text.partition("=")
    if equals and not (head.strip() and tail.strip()):
        missing = "folder" if head.strip() else "label"
        raise WrongText(f"'{text}' has no {missing}; write LABEL=FOLDER, or FOLDER")
    return Labelled(tail, head) if equals else Labelled(words(head), None)


def folders_argument(text: str = "results folder", count: int = -1) -> Decorator[Any]:
    return argument(
        "results", f"{text}, or LABEL=FOLDER", labelled, nargs=count, required=True
    )


def folders(given: Given) -> Sequence[Labelled]:
    """@raises ResultsError where one is given twice"""
    named: Sequence[Labelled] = given.results
    require_different([folder for folder, _ in named])
    return named


def beside_first(given: Given, name: str) -> Path:
    """The folder to write: as asked for, or of this name next to the first one that is given."""
    asked: Path | None = given.output
    return asked or Path(given.results[0].folder).resolve().parent / name


def comparison_parameters() -> list[Decorator[Any]]:
    columns = "depth_m, sinkage_m, resistance, density_kgm3"
    return [
        folders_argument(),
        *reference_options(),
        option("--measured", parse=path, help=f"reference.csv with {columns}"),
        flag("--anyway", help="compare runs whose conditions differ"),
    ]


def reference_options() -> list[Decorator[Any]]:
    """Options for what runs are compared with: errors of other sizes, formulas."""
    table = "table of runs of the scene (inputs/costs): errors of size, domain, packing"
    formula = "nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN; may be repeated"
    return [
        option("--errors", parse=path, help=table),
        option("--formula", parse=str, multiple=True, help=formula),
        flag("--extrapolate", help="formulas outside of their range too"),
    ]


def compared(given: Given) -> Comparison:
    """@raises ResultsError with every reason why the runs are not comparable"""
    runs = [read_wheel_run(folder, label) for folder, label in folders(given)]
    table = cost_table.read_table(given.errors)[0] if given.errors else None
    formulas = predictions_for(runs[0], given.formula, given.extrapolate)
    return compare(runs, table, formulas, given.measured, given.anyway)
