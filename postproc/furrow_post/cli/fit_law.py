# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post fit-law: parameters of a law from measured curves; furrow-point fit becomes this."""

import argparse
import importlib
import sys
from pathlib import Path

from ..analyse.law_fit import fit_law
from ..analyse.law_fit_report import report, write_fit
from ..analyse.point_curves import PROGRAM, PointCurves
from ..arguments import path
from .output import add_target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    file = "a YAML file with a fit; furrow-point paths lists its keys"
    parser.add_argument("file", type=path, help=file)
    add_target(parser, "the results folder; results/<name of the file> unless given")
    parser.add_argument("--no-plot", action="store_true", help="no figure")


def run(arguments: argparse.Namespace) -> int:
    """1 where the fit did not converge; its results are written all the same."""
    folder: Path = arguments.output or Path("results") / arguments.file.stem
    with PointCurves(arguments.file) as point:
        for warning in point.warnings:
            print(f"{PROGRAM}: warning: {warning}", file=sys.stderr)
        fit = fit_law(point.parameters, point.curves, point)
        write_fit(point, fit, folder)
        print(f"{report(point, fit)}  results       {folder}")
    if not arguments.no_plot:  # without a figure nobody waits for matplotlib
        figures = importlib.import_module("..figures.point", __package__)
        print(f"  figure        {figures.draw_point(folder)}")
    return 0 if fit.fit.converged else 1
