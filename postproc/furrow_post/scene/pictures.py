# SPDX-License-Identifier: GPL-2.0-or-later
"""Pictures of a run: its histories, and the ground after it."""

from pathlib import Path

from ..uncertainty.whole_error import headline
from ..figures.histories import draw_histories
from ..figures.picture import draw_picture
from ..figures.terrain_figure import draw_terrain
from ..read.results import Results
from ..read.terrain import terrain_file

PIXELS, QUICK_PIXELS = 1000, 500  # width of the view from behind


def draw_run(folder: Path, quick: bool) -> list[Path]:
    """Pictures of a run with a history; those of a quick run are small."""
    results = Results(folder)
    histories = folder / "histories.png"
    draw_histories(results, histories, "time")
    # Neither a rigid plane nor a height field has grains or particles to draw
    if not results.has_grains and not terrain_file(folder).is_file():
        return [histories]
    rut = folder / "rut.png"
    draw_rut(results, rut, QUICK_PIXELS if quick else PIXELS)
    return [histories, rut]


def draw_rut(results: Results, file: Path, pixels: int) -> None:
    """The rut in grains, or in a continuum without grains."""
    folder = results.folder
    numbers = headline(folder)
    if results.has_grains or not terrain_file(folder).is_file():
        draw_picture(results, numbers, file, pixels)
    else:
        draw_terrain(folder, results.title, numbers, file, pixels)
