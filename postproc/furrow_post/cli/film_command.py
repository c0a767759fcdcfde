# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post film: the frames of a run as a film."""

from pathlib import Path

from ..arguments import number, path, positive
from ..errors import ResultsError
from ..figures.film import draw_film
from ..figures.ground_quantities import KNOWN
from ..read.motion import read_motion
from .parameters import Given, argument, command, option

ENDINGS = (".mp4", ".mkv", ".webm")


@command(
    argument("results", "results folder of a run that wrote frames", path),
    argument("film", f"film to write, {', '.join(ENDINGS)} (default: film.mp4 in the results folder)", path, required=False),
    option("--colour", choices=[key for key, *_ in KNOWN], help="of the ground (default: the first)"),
    option("--seconds", parse=positive, default=8.0, show_default=True, help="how long it plays"),
    option("--cut", parse=number, default=float("-inf"), help="leave out ground of smaller y [m]"),
)
def film(given: Given) -> None:
    motion = read_motion(given.results)
    target: Path = given.film or motion.folder / "film.mp4"
    if target.suffix not in ENDINGS:
        raise ResultsError(f"{target}: its name ends in none of {', '.join(ENDINGS)}")
    if not target.parent.is_dir():
        raise ResultsError(f"{target}: there is no folder {target.parent}; make it first")
    count = draw_film(motion, target, given.colour, given.seconds, given.cut)
    print(f"{target} ({count} frames)")
