# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post flow: displacement, density and stress of two grounds under one wheel, and their
difference."""

import argparse
from pathlib import Path

from ..analyse.comparison import uniquely_labelled
from ..analyse.flow import compare_flows, flow_report, write_flow
from ..arguments import path, positive
from ..figures.flow import draw_flow
from ..read.results import require_different
from ..read.wheel_run import read_wheel_run
from .comparison import labelled


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", nargs=2, help="results folders (LABEL=FOLDER)")
    parser.add_argument(
        "--width",
        type=positive,
        help="standard deviation of the kernel [m] (default: the size of the coarser ground)",
    )
    parser.add_argument(
        "-o", "--output", type=path, help="folder to write (default: flow beside the first)"
    )


def run(arguments: argparse.Namespace) -> None:
    given = [labelled(text) for text in arguments.results]
    require_different([folder for folder, _ in given])
    target = arguments.output or Path(given[0][0]).resolve().parent / "flow"
    runs = uniquely_labelled([read_wheel_run(*item) for item in given])
    result = compare_flows(runs, arguments.width)
    write_flow(result, target)
    draw_flow(result, target / "flow.png")
    print(flow_report(result))
    print(f"\n{target}/flow.png, flow.csv, flow.h5")
