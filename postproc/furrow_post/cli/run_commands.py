# SPDX-License-Identifier: GPL-2.0-or-later
"""Commands that make runs of a scene: run, converge."""

import importlib
from pathlib import Path
from typing import Any

import click

from ..arguments import at_least, between, fraction, path, seconds
from ..programs import results_folder
from ..scene.catalogue import listing, scene_names
from ..scene.command import run_scene
from ..scene.converging import converge, convergence_table, material_table, vary_material
from .parameters import Given, argument, command, flag, option

DESCRIPTION = """\
Runs a scene and shows its results. Without a scene: the tyre of Shoop (2001) on 20 cm of snow, with
measurements and NRMM, and its rigid wheel on fresh snow as continuum and as grains."""


def _complete_scene(_: click.Context, __: click.Parameter, incomplete: str) -> list[str]:
    return [name for name in scene_names() if name.startswith(incomplete)]


def _once(*names: str, help: str, **more: Any) -> Any:
    """Option that can be given once."""
    return option(*names, help=help, once=True, **more)


def _variables(help: str) -> Any:
    """-v NAME VALUE, any number of times."""
    return option("-v", "given", nargs=2, parse=str, multiple=True, metavar="NAME VALUE", help=help)


@command(
    argument(
        "scene",
        "one of the list below, or the path of a LIGGGHTS script",
        str,
        nargs=-1,
        metavar="[SCENE]",
        shell_complete=_complete_scene,
    ),
    flag("--quick", help="a small, coarse version, done within a minute"),
    _once("-n", "ranks", metavar="RANKS", parse=at_least(1), help="MPI ranks (default 1)"),
    _once("-o", "--output", "folder", metavar="FOLDER", parse=path, help="where results go (default: results/SCENE)"),
    _variables("sets a variable of the script, e.g. -v speed 0.2; 'furrow-post variables SCRIPT' lists them"),
    _once(
        "--error",
        metavar="PERCENT",
        parse=fraction,
        help="chooses size and travel for this whole error of hub drop and coefficient, e.g. 10%, by a pilot run in "
        "coarser cells; prints a forecast, and at the end whether it was reached and what limits it",
    ),
    _once("--time", metavar="TIME", parse=seconds, help="the least error within this time of one core, e.g. 10min"),
    flag("--dry-run", help="of --error and --time: makes the pilot run and prints the plan alone"),
    _once(
        "--until-steady",
        metavar="PERCENT",
        parse=fraction,
        help="continues until hub drop and resistance are steady within this standard error, e.g. 3%",
    ),
    _once("--time-limit", metavar="TIME", parse=seconds, help="of --until-steady or of each point of a sweep, e.g. 2h"),
    _once(
        "--checkpoint",
        metavar="TIME",
        parse=seconds,
        help="writes a checkpoint at this interval, e.g. 10min; a run that is stopped writes one too",
    ),
    flag(
        "--continue",
        "continues",
        help="continues a stopped run from its last checkpoint, with its variables and ranks",
    ),
    flag("--no-pictures", help="draws no pictures of the results"),
    flag("--no-build", help="for inputs/run: runs the programs that were built last"),
    option(
        "--sweep",
        parse=str,
        multiple=True,
        metavar="NAME=VALUES",
        help="[sweep] a run for each value: FIRST:LAST:COUNT or VALUE,VALUE,...; several --sweep give each "
        "combination. Finished points are kept, so the same command resumes a sweep (inputs/sweep/README.md)",
    ),
    _once(
        "--samples",
        metavar="N",
        parse=at_least(2),
        help="[sweep] N points that fill the box of several --sweep NAME=FIRST:LAST, for 'furrow-post surrogate'",
    ),
    _once("--packings", metavar="N", parse=at_least(1), help="[sweep] each point with N packings of its grains"),
    _once("--jobs", metavar="N", parse=at_least(1), help="[sweep] runs at a time (default 1; with --submit: no limit)"),
    _once("--submit", choices=("slurm",), help="[sweep] runs the points as an array job of Slurm"),
    flag("--again", help="[sweep] repeats points that failed"),
    flag("--check", help="[sweep] checks the sweep and runs nothing"),
    option(
        "--formula",
        parse=str,
        multiple=True,
        metavar="NAME",
        help="[sweep] adds nrmm:PRESSURE, bekker:TERRAIN or wong_reece:TERRAIN",
    ),
    option(
        "--measured",
        parse=path,
        multiple=True,
        metavar="FILE",
        help="[sweep] adds measured points: CSV with the columns of sweep.csv",
    ),
    option("--point", hidden=True, parse=str, help="a task of an array job makes this point"),
    description=DESCRIPTION,
    closing=lambda: f"Scenes:\n{listing()}",
)
def run(given: Given) -> int:
    return run_scene(given, post)


@command(
    argument("scene", "a scene, or the path of a LIGGGHTS script", str),
    _variables("sets a variable of the script; cell and diameter: the finest"),
    option("--ratio", parse=between(1.1, 2.0), default=1.26, help="of one size to the next finer (default 1.26)"),
    option("--sizes", parse=at_least(2), default=3, help="their number (default 3)"),
    flag("--material", help="varies the parameters of the card or material by their standard errors instead, in coarser cells"),
    option("--jobs", parse=at_least(1), default=1, help="runs at a time (default 1)"),
    option("-o", "--output", parse=path, help="folder of the runs (default: results/SCENE_convergence)"),
)
def converge_(given: Given) -> None:
    folder: Path = given.output or results_folder(f"{Path(given.scene).stem}_convergence")
    if given.material:
        made = vary_material(given.scene, list(given.given), folder, given.jobs)
        print(material_table(made))
        print(f"\n{made.path}: later runs of this script with {made.file} take the error of their soil from it")
        return
    found = converge(given.scene, list(given.given), given.ratio, given.sizes, folder, given.jobs)
    print(convergence_table(found))
    print(f"\n{found.path}: later runs of this script take the error of their size from it")


def post(*words: object) -> int:
    """Runs another command of furrow-post in this process. @raises ResultsError"""
    main = importlib.import_module(".main", __package__)
    status = main.root.main(list(map(str, words)), prog_name=main.NAME, standalone_mode=False)
    return status or 0
