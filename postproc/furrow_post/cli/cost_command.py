# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post cost: error against cost of the runs of a scene."""

from pathlib import Path

from ..analyse import cost, cost_table
from ..arguments import fraction, path
from ..figures.cost_figure import draw_cost
from ..read.results import require_different
from ..read.wheel_run import read_wheel_run
from .comparing import labelled
from .parameters import Given, argument, command, option, require_picture


@command(
    argument("results", "results folders (LABEL=FOLDER), or a table of inputs/costs", nargs=-1, required=True),
    option("--error", parse=fraction, default=0.1, help="wanted relative error, e.g. 10% (default)"),
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
    assessed = cost.assess(rows, cost_table.wanted_wheel(comments))
    print(cost.cost_report(assessed, given.error))
    draw_cost(assessed, given.error, target)
    cost.write_csv(target.with_suffix(".csv"), assessed)
    print(f"\n{target}, {target.with_suffix('.csv')}")
