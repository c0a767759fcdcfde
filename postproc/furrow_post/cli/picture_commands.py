# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands that draw one run: plot, picture, terrain, view, film."""

from collections.abc import Sequence
from pathlib import Path

from ..analyse.rut import displacements
from ..uncertainty.whole_error import headline
from ..arguments import number, path, positive
from ..errors import ResultsError
from ..figures.film import draw_film
from ..figures.ground_quantities import KNOWN
from ..figures.histories import draw_histories
from ..figures.terrain_figure import draw_stress, draw_terrain
from ..figures.view import LARGEST, view_page
from ..read.motion import read_motion
from ..read.results import Results, require_different
from ..read.terrain import Outline, Terrain, read_terrain_fields
from ..scene.pictures import draw_rut
from .parameters import (
    Given,
    argument,
    command,
    option,
    output_options,
    pixels_option,
    require_file,
    results_argument,
    target,
    target_option,
)

MEGABYTE = 1e6
FILMS = ("mp4", "mkv", "webm")
FILM = f"film to write, {', '.join(f'.{ending}' for ending in FILMS)} (default: film.mp4 in the results folder)"


@command(
    results_argument(),
    option("--against", choices=("time", "x"), default="time", show_default=True, help="the abscissa: time, or x of the axle along the travel"),
    *output_options(),
)
def plot(given: Given) -> None:
    results = Results(given.results)
    file = target(given, results.folder, "histories")
    draw_histories(results, file, given.against)
    print(file)


@command(results_argument(), *output_options(), pixels_option())
def picture(given: Given) -> None:
    results = Results(given.results)
    file = target(given, results.folder, "rut")
    draw_rut(results, file, given.pixels)
    print(file)


@command(results_argument(), *output_options(), pixels_option())
def terrain(given: Given) -> None:
    place = Path(given.results)
    if not place.exists():
        raise ResultsError(f"{place}: no such file; name the results folder of a run")
    folder = place if place.is_dir() else place.parent
    has_history = (folder / "history.h5").is_file()
    title = Results(folder).title if has_history else folder.resolve().name
    file = target(given, folder, "terrain")
    print(draw_terrain(folder, title, headline(folder), file, given.pixels).report())
    ground = Terrain.read(folder)
    body = Outline(folder, ground)
    if body.surface is not None:
        print(displacements(ground, body).report())
    print(file)
    if "principal_stress" not in read_terrain_fields(folder):
        print("No stress is drawn: the run is of an older Furrow, which kept no principal stresses")
        return
    stress_file = file.with_name(f"{file.stem}_stress{file.suffix}")
    arc = draw_stress(folder, title, stress_file)
    print(f"Deviatoric stress ahead of the wheel: greatest, {arc.text()}")
    print(stress_file)


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
    page: Path = given.output or motions[0].folder / "view.html"
    require_file(page, "html", make_folder=True)
    names = [motion.folder.resolve().name for motion in motions]
    labels = names if len(set(names)) == len(names) else [str(folder) for folder in folders]
    text = view_page(motions, labels, MEGABYTE * given.size)
    page.write_text(text, encoding="utf-8")
    print(f"{page} ({len(text.encode()) / MEGABYTE:.1f} MB)")


@command(
    argument("results", "results folder of a run that wrote frames", path),
    argument("film", FILM, path, required=False),
    option("--colour", choices=[key for key, *_ in KNOWN], help="of the ground (default: the first)"),
    option("--seconds", parse=positive, default=8.0, show_default=True, help="how long it plays"),
    option("--cut", parse=number, default=float("-inf"), help="leave out ground of smaller y [m]"),
)
def film(given: Given) -> None:
    motion = read_motion(given.results)
    file: Path = given.film or motion.folder / "film.mp4"
    require_file(file, *FILMS)
    count = draw_film(motion, file, given.colour, given.seconds, given.cut)
    print(f"{file} ({count} frames)")
