# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post fit law: parameters of a law from measured curves; furrow-point fit becomes this."""

import importlib
import sys
from pathlib import Path

from ..laws.law_fit import fit_law, report, write_fit
from ..laws.point_curves import PROGRAM, PointCurves
from ..arguments import path
from .parameters import Given, argument, command, flag, target_option


@command(
    argument("file", "a YAML file with a fit; furrow-point paths lists its keys", path),
    target_option("the results folder; results/<name of the file> unless given"),
    flag("--no-plot", help="no figure"),
)
def fit_law_(given: Given) -> int:
    """1 where the fit did not converge; its results are written all the same."""
    folder: Path = given.output or Path("results") / given.file.stem
    with PointCurves(given.file) as point:
        for warning in point.warnings:
            print(f"{PROGRAM}: warning: {warning}", file=sys.stderr)
        fit = fit_law(point.parameters, point.curves, point)
        write_fit(point, fit, folder)
        print(f"{report(point, fit)}  results       {folder}")
    if not given.no_plot:  # without a figure nobody waits for matplotlib
        figures = importlib.import_module("..figures.point_figure", __package__)
        print(f"  figure        {figures.draw_point(folder)}")
    return 0 if fit.converged else 1
