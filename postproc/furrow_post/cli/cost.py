# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post cost: error against cost of the runs of a scene."""

import argparse
from pathlib import Path

from ..analyse import cost, cost_table
from ..arguments import fraction, path
from ..figures.cost import draw_cost
from ..read.results import require_different
from ..read.wheel_run import read_wheel_run
from .comparison import labelled
from .output import require_picture


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "results", nargs="+", help="results folders (LABEL=FOLDER), or a table of inputs/costs"
    )
    parser.add_argument(
        "--error", type=fraction, default=0.1, help="wanted relative error, e.g. 10%% (default)"
    )
    parser.add_argument(
        "--write", type=path, help="also write the table of runs, as inputs/costs has them"
    )
    parser.add_argument("-o", "--output", type=path, help="figure (default: cost.png)")


def run(arguments: argparse.Namespace) -> None:
    target: Path = arguments.output or Path("cost.png")
    require_picture(target)
    require_different(arguments.results)
    rows: list[cost_table.Row] = []
    comments: list[str] = []
    for text in arguments.results:
        if Path(text).suffix == ".csv":
            more, head = cost_table.read_table(Path(text))
            rows, comments = rows + more, comments + head
        else:
            rows.append(cost_table.row_of(read_wheel_run(*labelled(text))))
    if arguments.write:
        cost_table.write_table(arguments.write, rows, comments)
    assessed = cost.assess(rows, cost_table.wanted_wheel(comments))
    print(cost.cost_report(assessed, arguments.error))
    draw_cost(assessed, arguments.error, target)
    cost.write_csv(target.with_suffix(".csv"), assessed)
    print(f"\n{target}, {target.with_suffix('.csv')}")
