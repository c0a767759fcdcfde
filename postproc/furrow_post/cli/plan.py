# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post plan: the runs that bring the error of a scene down to a goal most cheaply."""

import argparse

from ..analyse.cost_table import families, read_table
from ..analyse.plan import family_of, plan, plan_report
from ..arguments import fraction, path, positive
from ..errors import ResultsError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("table", type=path, help="table of the scene's runs (inputs/costs/*.csv)")
    parser.add_argument(
        "--sinkage",
        type=fraction,
        default=0.03,
        help="goal: uncertainty over the value at zero size (default 3%%)",
    )
    parser.add_argument(
        "--coefficient",
        type=positive,
        default=0.01,
        help="goal: uncertainty of the resistance coefficient (default 0.01)",
    )
    parser.add_argument(
        "--ground", choices=("continuum", "grains"), default="", help="of this ground alone"
    )


def run(arguments: argparse.Namespace) -> None:
    rows, _ = read_table(arguments.table)
    chosen = family_of(list(families(rows).values()), arguments.ground)
    relative, absolute = {"sinkage": arguments.sinkage}, {"coefficient": arguments.coefficient}
    reports, refused = [], []
    for family in chosen:
        try:
            reports.append(plan_report(plan(family, relative, absolute)))
        except ResultsError as error:
            refused.append(str(error))
    if not reports:
        raise ResultsError("\n".join(refused))
    print("\n\n".join([*reports, *refused]))
    print(
        "\nUncertainties are numerical, one standard deviation. A packing's scatter and the order "
        "of the size are taken from the table:\nmake the first runs, write them into the table "
        "(furrow-post cost --write) and plan again."
    )
