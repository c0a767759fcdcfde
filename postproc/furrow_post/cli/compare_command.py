# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post compare: the same scene on several grounds, or the same test of the laboratory."""


from ..analyse.comparison import comparison_report, write_comparison
from ..analyse.curves import compare_curves, curve_report, is_curve, read_curve, write_curves
from ..errors import ResultsError
from ..figures.comparison_figure import draw_comparison
from ..figures.curves_figure import draw_curves
from .comparing import beside_first, compared, comparison_parameters, folders
from .parameters import Given, command, target_option


@command(
    *comparison_parameters(),
    target_option("folder to write (default: compare next to the first)"),
)
def compare(given: Given) -> None:
    labelled = folders(given)
    target = beside_first(given, "compare")
    if len(labelled) < 2 and not (given.formula or given.measured):
        raise ResultsError("compare needs two results folders, or one and --formula or --measured")
    if is_curve(labelled[0].folder):
        curves = compare_curves([read_curve(*item) for item in labelled], given.anyway)
        write_curves(curves, target)
        draw_curves(curves, target / "compare.png")
        print(curve_report(curves))
    else:
        result = compared(given)
        write_comparison(result, target)
        draw_comparison(result, target / "compare.png")
        print(comparison_report(result))
    print(f"\n{target}/compare.png, compare.txt, compare.csv, compare.h5")
