# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post laboratory: evaluates tests of inputs/laboratory."""


from ..arguments import path
from ..figures.laboratory_figure import draw_laboratory
from ..laboratory.report import report_tests
from .parameters import Given, argument, command, option, output_options, repeated, target


@command(
    argument("folders", "results folders of one test of inputs/laboratory", nargs=-1, required=True, metavar="RESULTS..."),
    option("--reference", parse=path, help="reference.csv of an oedometer, with columns rho_kgm3 and sigma1_Pa"),
    repeated("--point", help="results folder of furrow-point with the same path, for comparison"),
    *output_options("figure to write (default: in the first folder)"),
)
def laboratory(given: Given) -> None:
    found = report_tests(given.folders, given.reference, given.point)
    print(found.report)
    file = target(given, found.tests[0].folder, "laboratory")
    draw_laboratory(found, file)
    print(file)
