# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post flow: displacement, density and stress of two grounds under one wheel, and their
difference."""


from ..analyse.comparison import uniquely_labelled
from ..analyse.flow import compare_flows, flow_report, write_flow
from ..arguments import positive
from ..figures.flow_figure import draw_flow
from ..read.wheel_run import read_wheel_run
from .comparing import beside_first, folders, folders_argument
from .parameters import Given, command, option, target_option


@command(
    folders_argument(count=2),
    option("--width", parse=positive, help="standard deviation of the kernel [m] (default: the size of the coarser ground)"),
    target_option("folder to write (default: flow next to the first)"),
)
def flow(given: Given) -> None:
    runs = uniquely_labelled([read_wheel_run(*item) for item in folders(given)])
    target = beside_first(given, "flow")
    result = compare_flows(runs, given.width)
    write_flow(result, target)
    draw_flow(result, target / "flow.png")
    print(flow_report(result))
    print(f"\n{target}/flow.png, flow.csv, flow.h5")
