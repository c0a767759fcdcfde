# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compare: the same scene on several grounds, or the same test of the laboratory."""

import argparse
from collections.abc import Sequence
from pathlib import Path

from ..analyse.comparison_report import comparison_report, write_comparison
from ..analyse.curves import compare_curves, curve_report, is_curve, read_curve, write_curves
from ..arguments import path
from ..errors import ResultsError
from ..figures.comparison import draw_comparison
from ..figures.curves import draw_curves
from ..read.results import require_different
from .comparison import Labelled, add_comparison_arguments, compared


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_comparison_arguments(parser)
    parser.add_argument(
        "-o", "--output", type=path, help="folder to write (default: compare beside the first)"
    )


def run(arguments: argparse.Namespace) -> None:
    given: Sequence[Labelled] = arguments.results
    target = arguments.output or Path(given[0].folder).resolve().parent / "compare"
    if len(given) < 2 and not (arguments.formula or arguments.measured):
        raise ResultsError("compare needs two results folders, or one and --formula or --measured")
    if is_curve(given[0].folder):
        require_different([folder for folder, _ in given])
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
