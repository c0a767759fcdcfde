# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compare: the same scene on several grounds, or the same test of the laboratory."""

import argparse

from ..analyse.comparison_report import comparison_report, write_comparison
from ..analyse.curves import compare_curves, curve_report, is_curve, read_curve, write_curves
from ..errors import ResultsError
from ..figures.comparison import draw_comparison
from ..figures.curves import draw_curves
from .comparison import add_comparison_arguments, beside_first, compared, folders
from .output import add_target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_comparison_arguments(parser)
    add_target(parser, "folder to write (default: compare beside the first)")


def run(arguments: argparse.Namespace) -> None:
    given = folders(arguments)
    target = beside_first(arguments, "compare")
    if len(given) < 2 and not (arguments.formula or arguments.measured):
        raise ResultsError("compare needs two results folders, or one and --formula or --measured")
    if is_curve(given[0].folder):
        curves = compare_curves([read_curve(*item) for item in given], arguments.anyway)
        write_curves(curves, target)
        draw_curves(curves, target / "compare.png")
        print(curve_report(curves))
    else:
        result = compared(arguments)
        write_comparison(result, target)
        draw_comparison(result, target / "compare.png")
        print(comparison_report(result))
    print(f"\n{target}/compare.png, compare.txt, compare.csv, compare.h5")
