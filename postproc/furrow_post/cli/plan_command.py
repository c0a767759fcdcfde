# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post plan: the runs that bring the error of a scene down to a goal most cheaply."""


from ..analyse.cost_table import families, read_table
from ..analyse.plan import family_of, plan, plan_report
from ..arguments import fraction, path, positive
from ..errors import ResultsError
from .parameters import Given, argument, command, option


@command(
    argument("table", "table of the scene's runs (inputs/costs/*.csv)", path),
    option("--sinkage", parse=fraction, default=0.03, help="goal: uncertainty over the value at zero size (default 3%)"),
    option("--coefficient", parse=positive, default=0.01, help="goal: uncertainty of the resistance coefficient (default 0.01)"),
    option("--ground", choices=("continuum", "grains"), help="of this ground alone"),
)
def plan_(given: Given) -> None:
    rows, _ = read_table(given.table)
    chosen = family_of(list(families(rows).values()), given.ground or "")
    relative, absolute = {"sinkage": given.sinkage}, {"coefficient": given.coefficient}
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
        "\nUncertainties are numerical, one standard error. A packing's scatter and the order "
        "of the size are taken from the table:\nmake the first runs, write them into the table "
        "(furrow-post cost --write) and plan again."
    )
