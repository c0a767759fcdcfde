# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post view: runs in 3D, for any browser and without a network."""

import argparse
from pathlib import Path

from ..arguments import path, positive
from ..errors import ResultsError
from ..figures.view import LARGEST, view_page
from ..read.motion import read_motion
from ..read.results import require_different
from .output import add_target, prepare_page

MEGABYTE = 1e6


def add_arguments(parser: argparse.ArgumentParser) -> None:
    both = "results folders, one or two: side by side"
    parser.add_argument("results", type=path, nargs="+", help=both)
    add_target(parser, "page to write (default: view.html in the first folder)")
    parser.add_argument(
        "--size",
        type=positive,
        metavar="MB",
        default=LARGEST / MEGABYTE,
        help="largest page; frames are left out until it fits (default: %(default)g)",
    )


def run(arguments: argparse.Namespace) -> None:
    folders: list[Path] = arguments.results
    if len(folders) > 2:
        raise ResultsError(f"{len(folders)} results folders are given; a view shows one or two")
    require_different(folders)
    motions = [read_motion(folder) for folder in folders]
    target: Path = arguments.output or motions[0].folder / "view.html"
    prepare_page(target, "a view")
    names = [motion.folder.resolve().name for motion in motions]
    labels = names if len(set(names)) == len(names) else [str(folder) for folder in folders]
    text = view_page(motions, labels, MEGABYTE * arguments.size)
    target.write_text(text, encoding="utf-8")
    print(f"{target} ({len(text.encode()) / MEGABYTE:.1f} MB)")
