# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post film: the frames of a run as a film."""

import argparse
from pathlib import Path

from ..arguments import number, path, positive
from ..errors import ResultsError
from ..figures.film import draw_film
from ..figures.quantities import KNOWN
from ..read.motion import read_motion

ENDINGS = (".mp4", ".mkv", ".webm")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("results", type=path, help="results folder of a run that wrote frames")
    parser.add_argument(
        "film",
        type=path,
        nargs="?",
        help=f"film to write, {', '.join(ENDINGS)} (default: film.mp4 in the results folder)",
    )
    parser.add_argument(
        "--colour", choices=[key for key, *_ in KNOWN], help="of the ground (default: the first)"
    )
    parser.add_argument(
        "--seconds", type=positive, default=8.0, help="how long it plays (default: %(default)g)"
    )
    parser.add_argument(
        "--cut", type=number, default=float("-inf"), help="leave out ground of smaller y [m]"
    )


def run(arguments: argparse.Namespace) -> None:
    motion = read_motion(arguments.results)
    target: Path = arguments.film or motion.folder / "film.mp4"
    if target.suffix not in ENDINGS:
        raise ResultsError(f"{target}: its name ends in none of {', '.join(ENDINGS)}")
    if not target.parent.is_dir():
        raise ResultsError(f"{target}: there is no folder {target.parent}; make it first")
    count = draw_film(motion, target, arguments.colour, arguments.seconds, arguments.cut)
    print(f"{target} ({count} frames)")
