# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post flow: displacement, density and stress of two grounds under one wheel, and their
difference."""

import argparse

from ..analyse.comparison import uniquely_labelled
from ..analyse.flow import compare_flows, flow_report, write_flow
from ..arguments import positive
from ..figures.flow import draw_flow
from ..read.wheel_run import read_wheel_run
from .comparison import add_folders, beside_first, folders
from .output import add_target


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_folders(parser, count=2)
    parser.add_argument(
        "--width",
        type=positive,
        help="standard deviation of the kernel [m] (default: the size of the coarser ground)",
    )
    add_target(parser, "folder to write (default: flow beside the first)")


def run(arguments: argparse.Namespace) -> None:
    runs = uniquely_labelled([read_wheel_run(*item) for item in folders(arguments)])
    target = beside_first(arguments, "flow")
    result = compare_flows(runs, arguments.width)
    write_flow(result, target)
    draw_flow(result, target / "flow.png")
    print(flow_report(result))
    print(f"\n{target}/flow.png, flow.csv, flow.h5")
