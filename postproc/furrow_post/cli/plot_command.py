# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post plot: histories of a run."""


from ..figures.histories import draw_histories
from ..read.results import Results
from .parameters import Given, command, option, output_options, results_argument, target


@command(
    results_argument(),
    option("--against", choices=("time", "x"), default="time", show_default=True, help="the abscissa: time, or x of the axle along the travel"),
    *output_options(),
)
def plot(given: Given) -> None:
    results = Results(given.results)
    file = target(given, results.folder, "histories")
    draw_histories(results, file, given.against)
    print(file)
