# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post cost: values, numerical errors and cost of the runs of a scene."""

from pathlib import Path

from ..uncertainty import cost_table
from ..arguments import path
from ..figures.cost_figure import draw_cost
from ..read.results import require_different
from ..read.wheel_run import read_wheel_run
from .comparing import labelled
from .parameters import Given, argument, command, option, require_picture


@command(
    argument("results", "results folders (LABEL=FOLDER), or a table of inputs/costs", nargs=-1, required=True),
    option("--write", parse=path, help="also write the table of runs, as inputs/costs has them"),
    option("-o", "--output", parse=path, help="figure (default: cost.png)"),
)
def cost_(given: Given) -> None:
    target: Path = given.output or Path("cost.png")
    require_picture(target)
    require_different(given.results)
    rows: list[cost_table.Row] = []
    comments: list[str] = []
    for text in given.results:
        if Path(text).suffix == ".csv":
            more, head = cost_table.read_table(Path(text))
            rows, comments = rows + more, comments + head
        else:
            rows.append(cost_table.row_of(read_wheel_run(*labelled(text))))
    if given.write:
        cost_table.write_table(given.write, rows, comments)
    print(cost_table.cost_report(rows))
    draw_cost(rows, target)
    cost_table.write_errors(target.with_suffix(".csv"), rows)
    print(f"\n{target}, {target.with_suffix('.csv')}")
