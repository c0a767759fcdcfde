# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post terrain: density, displacement and stress of continuum terrain, in sections and as
numbers."""

from pathlib import Path

from ..analyse.rut import displacements
from ..uncertainty.whole_error import headline
from ..errors import ResultsError
from ..figures.terrain_figure import draw_terrain
from ..figures.terrain_stress_figure import draw_stress
from ..read.results import Results
from ..read.terrain import Outline, Terrain, read_terrain_fields
from .parameters import Given, command, output_options, pixels_option, results_argument, target


@command(
    results_argument(),
    *output_options(),
    pixels_option(),
)
def terrain_(given: Given) -> None:
    place = Path(given.results)
    if not place.exists():
        raise ResultsError(f"{place}: no such file; name the results folder of a run")
    folder = place if place.is_dir() else place.parent
    has_history = (folder / "history.h5").is_file()
    title = Results(folder).title if has_history else folder.resolve().name
    file = target(given, folder, "terrain")
    numbers = headline(folder)
    print(draw_terrain(folder, title, numbers, file, given.pixels).report())
    terrain = Terrain.read(folder)
    body = Outline(folder, terrain)
    if body.surface is not None:
        print(displacements(terrain, body).report())
    print(file)
    if "principal_stress" not in read_terrain_fields(folder):
        print("No stress is drawn: the run is of an older Furrow, which kept no principal stresses")
        return
    stress_file = file.with_name(f"{file.stem}_stress{file.suffix}")
    arc = draw_stress(folder, title, stress_file)
    print(f"Deviatoric stress ahead of the wheel: greatest, {arc.text()}")
    print(stress_file)
