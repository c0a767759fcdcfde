# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post view: runs in 3D, for any browser and without a network."""

from collections.abc import Sequence
from pathlib import Path

from ..arguments import path, positive
from ..errors import ResultsError
from ..figures.view import LARGEST, view_page
from ..read.motion import read_motion
from ..read.results import require_different
from .parameters import Given, argument, command, option, prepare_page, target_option

MEGABYTE = 1e6


@command(
    argument("results", "results folders, one or two: side by side", path, nargs=-1, required=True),
    target_option("page to write (default: view.html in the first folder)"),
    option("--size", parse=positive, metavar="MB", default=LARGEST / MEGABYTE, show_default=True, help="largest page; frames are left out until it fits"),
)
def view(given: Given) -> None:
    folders: Sequence[Path] = given.results
    if len(folders) > 2:
        raise ResultsError(f"{len(folders)} results folders are given; a view shows one or two")
    require_different(folders)
    motions = [read_motion(folder) for folder in folders]
    target: Path = given.output or motions[0].folder / "view.html"
    prepare_page(target, "a view")
    names = [motion.folder.resolve().name for motion in motions]
    labels = names if len(set(names)) == len(names) else [str(folder) for folder in folders]
    text = view_page(motions, labels, MEGABYTE * given.size)
    target.write_text(text, encoding="utf-8")
    print(f"{target} ({len(text.encode()) / MEGABYTE:.1f} MB)")
